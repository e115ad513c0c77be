#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "host/parallel_for.hpp"
#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/momentum_diagonals.hpp"
#include "linear/velocity_pressure/momentum_sweep.hpp"
#include "linear/velocity_pressure/velocity_pressure_matrix.hpp"
#include "linear/velocity_pressure/wall_coarse_correction.hpp"

namespace fsi {

/// A^-1 of a VelocityPressureMatrix, approximately: symmetric Gauss-Seidel sweeps over n x n node blocks, around coarse levels
/// where the wall is stiff (WallCoarseCorrection). Beside it the diagonal D that stands for A in a Schur complement.
template <int n>
class MomentumInverse {
 public:
  using Matrix = VelocityPressureMatrix<n>;
  using Nodal = typename Matrix::Nodal;
  static constexpr int lanes = Matrix::lanes;

  /// \param matrix  must outlive this
  explicit MomentumInverse(const Matrix& matrix)
      : matrix_(matrix),
        layout_(matrix.layout()),
        gauss_seidel_(matrix.momentum(), layout_.own_velocities, matrix.processes().size()) {
    double counts[2] = {static_cast<double>(layout_.own_pressures), static_cast<double>(layout_.own_velocities)};
    matrix.processes().sum(counts, 2);
    few_pressures_ = BlockPreconditionerChoices::has_few_pressures(counts[0], counts[1]);
    has_wall_ = matrix.processes().any(!layout_.velocity_of_wall.empty());
    for (auto* x : {&sweep_, &sweep_residual_, &inverse_lumped_}) x->resize(matrix.velocity_size());
  }

  /// Takes the present values of the matrix.
  void set_up(const BlockPreconditionerChoices& choices) {
    sweeps_ = choices.momentum_sweeps;
    fill_diagonals();
    // Gauss-Seidel solves mass-dominated rows at once, but leaves much of a stiff wall's smooth motions. Decided by the
    // matrix alone, so that a restart decides the same.
    const bool stiff = choices.has_coarse_levels(wall_stiffness()) && has_wall_;
    if (!stiff) {
      coarse_.reset();
    } else {
      if (!coarse_) coarse_ = std::make_unique<WallCoarseCorrection<n>>(matrix_);
      coarse_->set_up({});
    }
    gauss_seidel_.set_relaxation(choices.relaxation(wall_stiffness()));
  }

  /// The wall's momentum equations have coarse levels.
  bool has_wall_levels() const { return coarse_ != nullptr; }
  /// Diagonal over lumped diagonal of the wall's momentum at the last set_up(): how far stiffness exceeds inertia.
  double wall_stiffness() const { return diagonals_.stiffness(); }
  bool has_few_pressures() const { return few_pressures_; }
  /// D^-1, n numbers a velocity node.
  const std::vector<double>& inverse_diagonal() const { return diagonals_.inverse(); }
  /// The same in the order of the matrix, `lanes` numbers a node; zero at ghosts.
  const std::vector<float>& single_inverse_diagonal() const { return inverse_lumped_; }

  /// x = approximate A^-1 b: symmetric sweeps within each process, and where the wall is stiff its coarse correction and
  /// sweeps again. Ghosts in x get their values.
  /// \param b, x  of the matrix's velocity_size(); both must stay as they are until the last row()
  void apply(const std::vector<float>& b, std::vector<float>& x) {
    sweep(b, x);
    swept_ = &x;
    left_ = &b;
    if (sweeps_ == 1 && !coarse_) return;
    swept_ = &sweep_;
    left_ = &sweep_residual_;
    leave(b, x);
    sweep_again(sweeps_ - 1, x);
    if (!coarse_) return;
    if (sweeps_ > 1) leave(sweep_residual_, sweep_);
    coarse_->add(sweep_residual_, x);
    matrix_.update_velocities(x.data());
    for_velocities([&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      Matrix::store(Matrix::load(b.data() + at) - matrix_.momentum().row_product(v, x.data()),
                    sweep_residual_.data() + at);
    });
    sweep_again(sweeps_, x);
  }

  /// r - b + A x of a node, for b and x of the last apply(b, x). It costs half of a product with A: the backward part of the
  /// last sweep has computed U x, and A times what was there before that sweep is known from the residual which it answers
  /// to ([Eisenstat1981]).
  Nodal row(Nodal r, int v) const {
    return r - Matrix::load(left_->data() + static_cast<std::size_t>(v) * lanes) +
           gauss_seidel_.product(v, swept_->data());
  }

  template <class Work>
  void for_velocities(Work work) const {
    parallel_for(layout_.own_velocities, layout_.own_velocities > 500, work);
  }

  std::size_t bytes() const {
    return gauss_seidel_.bytes() + sizeof(float) * 3 * sweep_.size() + 8 * diagonals_.inverse().size() +
           (coarse_ ? coarse_->bytes() : 0);
  }

 private:
  /// A's block diagonal, inverted, and what is made of its diagonals.
  void fill_diagonals() {
    diagonals_.fill(
        matrix_, has_few_pressures(), [&](int v, const auto& diagonal) { gauss_seidel_.set_diagonal(v, diagonal); },
        matrix_.processes());
    matrix_.ghosts().velocities.exchange.update(diagonals_.inverse(), n);
    for (int v = 0; v < layout_.own_velocities; ++v)
      for (int k = 0; k < n; ++k)
        inverse_lumped_[static_cast<std::size_t>(v) * lanes + k] =
            static_cast<float>(diagonals_.inverse()[VectorLayout<n>::vector(v, k)]);
  }

  void sweep(const std::vector<float>& r, std::vector<float>& x) {
    gauss_seidel_.apply(r, x);
    matrix_.update_velocities(x.data());
  }

  /// Sweeps on sweep_residual_, which the last one answers to.
  void sweep_again(int count, std::vector<float>& x) {
    for (int done = 0; done < count; ++done) {
      if (done > 0) leave(sweep_residual_, sweep_);
      sweep(sweep_residual_, sweep_);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += sweep_[i];
    }
  }

  /// sweep_residual_ = r - A x of the last sweep, which made x of r.
  void leave(const std::vector<float>& r, const std::vector<float>& x) {
    for_velocities([&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      Matrix::store(Matrix::load(r.data() + at) - gauss_seidel_.product(v, x.data()), sweep_residual_.data() + at);
    });
  }

  const Matrix& matrix_;
  const VelocityPressureLayout<n>& layout_;
  int sweeps_ = 1;
  bool few_pressures_ = false;  ///< most velocity nodes carry none
  bool has_wall_ = false;       ///< some process
  MomentumSweep<n> gauss_seidel_;
  MomentumDiagonals<n> diagonals_;                   ///< D^-1
  std::unique_ptr<WallCoarseCorrection<n>> coarse_;  ///< null where sweeps do
  std::vector<float> inverse_lumped_;                ///< D^-1 in this layout
  std::vector<float> sweep_, sweep_residual_;
  const std::vector<float>*swept_ = nullptr, *left_ = nullptr;  ///< of the last sweep: what it made, of what
};

}  // namespace fsi
