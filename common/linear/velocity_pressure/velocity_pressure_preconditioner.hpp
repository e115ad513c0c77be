#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "host/parallel_for.hpp"
#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/momentum_diagonals.hpp"
#include "linear/velocity_pressure/momentum_sweep.hpp"
#include "linear/velocity_pressure/schur_complement_inverse.hpp"
#include "linear/velocity_pressure/velocity_pressure_matrix.hpp"
#include "linear/velocity_pressure/wall_coarse_correction.hpp"

namespace fsi {

/// Block preconditioner of F = [A G; B C] over both media, mesh motion left out, in single precision:
///   p = S^-1 (r_p - B D^-1 r_v),  v = A^-1 (r_v - G p),
/// F's block factors with the diagonal D (MomentumDiagonals) in place of A where pressures are sought, A^-1 by a symmetric
/// Gauss-Seidel sweep over n x n node blocks, around coarse levels where the wall is stiff (WallCoarseCorrection), S^-1 by
/// one multigrid cycle on S = C - B D^-1 G, or its factor (SchurComplementInverse). One scalar problem holds the pressures
/// of fluid and wall: they meet through the interface velocity, which carries the added mass.
///
/// Taylor-Hood elements have far fewer pressures than velocities. There a cycle on S costs little beside a momentum
/// sweep, and smooths after its coarse correction too. Nor have they a stabilisation in C: where the wall is stiff, its S
/// is that of a pressure mass matrix over the shear modulus for smooth pressures too, while B D^-1 G falls off like a
/// Laplacian. A multiple of the diagonal of B D^-1 G makes up for it (the two parts of S in [Cahouet1988], added).
template <int n>
class VelocityPressurePreconditioner {
 public:
  using Matrix = VelocityPressureMatrix<n>;
  using Nodal = typename Matrix::Nodal;
  static constexpr int lanes = Matrix::lanes;

  struct Options : BlockPreconditionerChoices {
    ScalarMultigrid::Options pressure;
    typename RigidMotionMultigrid<n>::Options wall;
  };

  explicit VelocityPressurePreconditioner(const Matrix& matrix, const Options& options = {})
      : matrix_(matrix), layout_(matrix.layout()), options_(options), gauss_seidel_(matrix.momentum()) {
    make_pressure_pattern();
    for (auto* x : {&velocity_residual_, &velocity_, &sweep_, &sweep_residual_, &inverse_lumped_})
      x->resize(matrix.velocity_size());
    pressure_residual_.resize(layout_.pressures);
    pressure_.resize(layout_.pressures);
  }

  Options& options() { return options_; }
  /// The wall's momentum equations have coarse levels.
  bool has_wall_levels() const { return coarse_ != nullptr; }
  /// Diagonal over lumped diagonal of the wall's momentum at the last set_up(): how far stiffness exceeds inertia.
  double wall_stiffness() const { return diagonals_.stiffness(); }

  /// Takes the present values of the matrix, which must have been filled.
  void set_up() {
    fill_diagonals();
    // Gauss-Seidel solves mass-dominated rows at once, but leaves much of a stiff wall's smooth motions. Decided by the
    // matrix alone, so that a restart decides the same.
    const bool stiff = options_.has_coarse_levels(wall_stiffness()) && !layout_.velocity_of_wall.empty();
    if (!stiff) {
      coarse_.reset();
    } else {
      if (!coarse_) coarse_ = std::make_unique<WallCoarseCorrection<n>>(matrix_);
      coarse_->set_up(options_.wall);
    }
    gauss_seidel_.set_relaxation(options_.relaxation(wall_stiffness()));
    fill_schur_complement();
    if (const double factor = options_.wall_diagonal_factor(wall_stiffness(), has_few_pressures()); factor != 1)
      scale_wall_diagonal(factor);
    ScalarMultigrid::Options pressure = options_.pressure;
    pressure.post_smoothing = pressure.post_smoothing || has_few_pressures();
    inverse_schur_.set_up(schur_, pressure, BlockPreconditionerChoices::factorises_schur_complement(n));
  }

  /// z = P^-1 r, both of the matrix's size
  void apply(VectorView<const float> r, VectorView<float> z) {
    const float* pressure_rows = r.data() + matrix_.velocity_size();
    for (std::size_t i = 0; i < sweep_.size(); ++i) sweep_[i] = inverse_lumped_[i] * r[i];
    parallel_for(layout_.pressures, layout_.pressures > 500, [&](int p) {
      pressure_residual_[p] =
          static_cast<float>(layout_.row_scale(p)) * (pressure_rows[p] - matrix_.divergence_product(p, sweep_.data()));
    });
    inverse_schur_.apply(pressure_residual_, pressure_);
    parallel_for(layout_.velocities, layout_.velocities > 2000, [&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      Matrix::store(Matrix::load(r.data() + at) - matrix_.gradient_product(v, pressure_.data()),
                    velocity_residual_.data() + at);
    });
    solve_momentum();
    std::copy(velocity_.begin(), velocity_.end(), z.begin());
    std::copy(pressure_.begin(), pressure_.end(), z.begin() + static_cast<std::ptrdiff_t>(matrix_.velocity_size()));
  }

  /// Besides, product = F z. It costs half of a product with A: the backward part of the last sweep has computed U x, and
  /// A times what was there before that sweep is known from the residual which it answers to ([Eisenstat1981]).
  void apply(VectorView<const float> r, VectorView<float> z, VectorView<float> product) {
    apply(r, z);
    const bool once = options_.momentum_sweeps == 1 && !coarse_;
    const std::vector<float>&x = once ? velocity_ : sweep_, &left = once ? velocity_residual_ : sweep_residual_;
    parallel_for(layout_.velocities, layout_.velocities > 500, [&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      Matrix::store(Matrix::load(r.data() + at) - Matrix::load(left.data() + at) + gauss_seidel_.product(v, x.data()),
                    product.data() + at);
    });
    matrix_.multiply_continuity(z, product);
  }

  const SchurComplementInverse& inverse_schur() const { return inverse_schur_; }
  std::size_t bytes() const {
    return gauss_seidel_.bytes() + sizeof(float) * 6 * velocity_.size() + 8 * diagonals_.inverse().size() +
           schur_.bytes() + inverse_schur_.bytes() + (coarse_ ? coarse_->bytes() : 0);
  }

 private:
  bool has_few_pressures() const {
    return BlockPreconditionerChoices::has_few_pressures(layout_.pressures, layout_.velocities);
  }

  /// Pressures that meet in one velocity node, or in a block of C.
  void make_pressure_pattern() {
    schur_.columns = layout_.pressures;
    schur_.offsets.assign(static_cast<std::size_t>(layout_.pressures) + 1, 0);
    std::vector<std::vector<int>> rows(layout_.pressures);
#pragma omp parallel
    {
      std::vector<int> seen(layout_.pressures, -1);
#pragma omp for schedule(static)
      for (int p = 0; p < layout_.pressures; ++p) {
        auto& row = rows[p];
        const auto add = [&](int q) {
          if (seen[q] == p) return;
          seen[q] = p;
          row.push_back(q);
        };
        matrix_.for_blocks_of_node(
            layout_.wall_pressure[p], layout_.node_of_pressure[p], [&](const double*, int v, int q, double) {
              if (q >= 0) add(q);
              if (v < 0) return;
              for (int at = matrix_.gradient_offsets()[v]; at < matrix_.gradient_offsets()[v + 1]; ++at)
                add(matrix_.gradient_columns()[at]);
            });
        std::sort(row.begin(), row.end());
      }
    }
    for (int p = 0; p < layout_.pressures; ++p)
      schur_.offsets[p + 1] = schur_.offsets[p] + static_cast<int>(rows[p].size());
    schur_.indices.reserve(schur_.offsets.back());
    for (const auto& row : rows) schur_.indices.insert(schur_.indices.end(), row.begin(), row.end());
    schur_.values.resize(schur_.indices.size());
  }

  /// A's block diagonal, inverted, and what is made of its diagonals.
  void fill_diagonals() {
    diagonals_.fill(matrix_, has_few_pressures(),
                    [&](int v, const auto& diagonal) { gauss_seidel_.set_diagonal(v, diagonal); });
    for (int v = 0; v < layout_.velocities; ++v)
      for (int k = 0; k < n; ++k)
        inverse_lumped_[static_cast<std::size_t>(v) * lanes + k] =
            static_cast<float>(diagonals_.inverse()[VectorLayout<n>::vector(v, k)]);
  }

  /// S = C - B D^-1 G
  void fill_schur_complement() {
#pragma omp parallel
    {
      std::vector<int> position(layout_.pressures, -1);
#pragma omp for schedule(static)
      for (int p = 0; p < layout_.pressures; ++p) {
        for (int at = schur_.offsets[p]; at < schur_.offsets[p + 1]; ++at) {
          position[schur_.indices[at]] = at;
          schur_.values[at] = 0;
        }
        const double scale = layout_.row_scale(p);
        matrix_.for_blocks_of_node(layout_.wall_pressure[p], layout_.node_of_pressure[p],
                                   [&](const double* block, int v, int q, double factor) {
                                     if (q >= 0)
                                       schur_.values[position[q]] += scale * block[MixedLayout<n>::in_block(n, n)];
                                     if (v < 0) return;
                                     double divergence[n];  // a row of B D^-1
                                     for (int k = 0; k < n; ++k)
                                       divergence[k] = scale * factor * block[MixedLayout<n>::in_block(n, k)] *
                                                       diagonals_.inverse()[VectorLayout<n>::vector(v, k)];
                                     for (int at = matrix_.gradient_offsets()[v];
                                          at < matrix_.gradient_offsets()[v + 1]; ++at) {
                                       const float* g = matrix_.gradient(at);
                                       double sum = 0;
                                       for (int k = 0; k < n; ++k) sum += divergence[k] * g[k];
                                       schur_.values[position[matrix_.gradient_columns()[at]]] -= sum;
                                     }
                                   });
      }
    }
  }

  /// C is so small in a nearly incompressible wall that the diagonal is that of -B D^-1 G.
  void scale_wall_diagonal(double factor) {
    for (int p = 0; p < layout_.pressures; ++p) {
      if (!layout_.wall_pressure[p]) continue;
      const auto begin = schur_.indices.begin() + schur_.offsets[p],
                 end = schur_.indices.begin() + schur_.offsets[p + 1];
      schur_.values[std::lower_bound(begin, end, p) - schur_.indices.begin()] *= factor;
    }
  }

  /// velocity_ = approximate A^-1 velocity_residual_: symmetric sweeps, and where the wall is stiff its coarse correction
  /// and sweeps again.
  void solve_momentum() {
    gauss_seidel_.apply(velocity_residual_, velocity_);
    if (options_.momentum_sweeps == 1 && !coarse_) return;
    leave(velocity_residual_, velocity_);
    sweep_again(options_.momentum_sweeps - 1);
    if (!coarse_) return;
    if (options_.momentum_sweeps > 1) leave(sweep_residual_, sweep_);
    coarse_->add(sweep_residual_, velocity_);
    for_velocities([&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      Matrix::store(Matrix::load(velocity_residual_.data() + at) - matrix_.momentum().row_product(v, velocity_.data()),
                    sweep_residual_.data() + at);
    });
    sweep_again(options_.momentum_sweeps);
  }

  /// Sweeps on sweep_residual_, which the last one answers to.
  void sweep_again(int count) {
    for (int sweep = 0; sweep < count; ++sweep) {
      if (sweep > 0) leave(sweep_residual_, sweep_);
      gauss_seidel_.apply(sweep_residual_, sweep_);
      for (std::size_t i = 0; i < velocity_.size(); ++i) velocity_[i] += sweep_[i];
    }
  }

  /// sweep_residual_ = r - A x of the last sweep, which made x of r.
  void leave(const std::vector<float>& r, const std::vector<float>& x) {
    for_velocities([&](int v) {
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      Matrix::store(Matrix::load(r.data() + at) - gauss_seidel_.product(v, x.data()), sweep_residual_.data() + at);
    });
  }

  template <class Work>
  void for_velocities(Work work) const {
    parallel_for(layout_.velocities, layout_.velocities > 500, work);
  }

  const Matrix& matrix_;
  const VelocityPressureLayout<n>& layout_;
  Options options_;
  std::unique_ptr<WallCoarseCorrection<n>> coarse_;  ///< null where sweeps do
  MomentumSweep<n> gauss_seidel_;
  MomentumDiagonals<n> diagonals_;     ///< D^-1
  std::vector<float> inverse_lumped_;  ///< the same in this layout
  CsrMatrix<double> schur_;
  SchurComplementInverse inverse_schur_;
  std::vector<float> velocity_residual_, velocity_, sweep_, sweep_residual_, pressure_residual_, pressure_;
};

}  // namespace fsi
