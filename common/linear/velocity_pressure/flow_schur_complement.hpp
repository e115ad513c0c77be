#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "linear/policy/solver_policy.hpp"
#include "linear/velocity_pressure/momentum_inverse.hpp"
#include "linear/velocity_pressure/schur_complement_inverse.hpp"

namespace fsi {

/// S = C - B D^-1 G of a VelocityPressureMatrix and its approximate inverse, by one multigrid cycle or its factor
/// (SchurComplementInverse). One scalar problem holds the pressures of fluid and wall: they meet through the interface
/// velocity, which carries the added mass. Several processes have rows of S for their own pressures.
///
/// Taylor-Hood elements have far fewer pressures than velocities. There a cycle on S costs little beside a momentum
/// sweep, and smooths after its coarse correction too. Nor have they a stabilisation in C: where the wall is stiff, its S
/// is that of a pressure mass matrix over the shear modulus for smooth pressures too, while B D^-1 G falls off like a
/// Laplacian. A multiple of the diagonal of B D^-1 G makes up for it (the two parts of S in [Cahouet1988], added).
template <int n>
class FlowSchurComplement {
 public:
  using Matrix = VelocityPressureMatrix<n>;

  /// \param matrix  must outlive this
  explicit FlowSchurComplement(const Matrix& matrix) : matrix_(matrix), layout_(matrix.layout()) {
    make_pattern();
    residual_.resize(layout_.own_pressures);
    solution_.resize(layout_.own_pressures);
  }

  /// Takes the present values of the matrix. \param momentum  with the same, for D
  void set_up(const BlockPreconditionerChoices& choices, const MomentumInverse<n>& momentum) {
    fill(momentum.inverse_diagonal());
    if (const double factor = choices.wall_diagonal_factor(momentum.wall_stiffness(), momentum.has_few_pressures());
        factor != 1)
      scale_wall_diagonal(factor);
    ScalarMultigrid::Options options;
    options.post_smoothing = options.post_smoothing || momentum.has_few_pressures();
    const Communicator& processes = matrix_.processes();
    const SolverPolicy policy(
        processes.is_alone() ? SolvedSystem::schur_complement : SolvedSystem::shared_schur_complement, n);
    inverse_.set_up(values_, share_, options,
                    !policy.decide(processes.sum(std::int64_t{layout_.own_pressures})).iterates);
  }

  /// p = approximate S^-1 (r - B v). The rows of S and of r - B v are scaled alike (row_scale()), p is not. Ghosts in p
  /// get the owners' values.
  /// \param r  of own pressures \param v  of the matrix's velocity_size(), with its ghosts
  void apply(const float* r, const std::vector<float>& v, std::vector<float>& p) {
    parallel_for(layout_.own_pressures, layout_.own_pressures > 500, [&](int row) {
      residual_[row] =
          static_cast<float>(layout_.row_scale(row)) * (r[row] - matrix_.divergence_product(row, v.data()));
    });
    if (matrix_.processes().is_alone()) return inverse_.apply(residual_, p);
    inverse_.apply(residual_, solution_);
    std::copy(solution_.begin(), solution_.end(), p.begin());
    matrix_.update_pressures(p.data());
  }

  const SchurComplementInverse& inverse() const { return inverse_; }
  std::size_t bytes() const { return values_.bytes() + inverse_.bytes() + sizeof(float) * 2 * residual_.size(); }

 private:
  /// Calls visit(column of S, G's numbers) for the pressures of a velocity node, ghosts' too.
  template <class Visit>
  void for_gradient(int v, Visit visit) const {
    if (v < layout_.own_velocities) {
      for (int at = matrix_.gradient_offsets()[v]; at < matrix_.gradient_offsets()[v + 1]; ++at)
        visit(column_[matrix_.gradient_columns()[at]], matrix_.gradient(at));
    } else {
      const std::size_t ghost = v - layout_.own_velocities;
      for (int at = ghost_offsets_[ghost]; at < ghost_offsets_[ghost + 1]; ++at)
        visit(ghost_columns_[at], ghost_gradient_.data() + static_cast<std::size_t>(at) * n);
    }
  }

  /// Rows of G of all velocities here, as their owners have them. \param of_entry  writes the numbers of an entry
  template <class Work>
  std::vector<std::vector<double>> gradient_rows(Work of_entry) const {
    const auto& exchange = matrix_.ghosts().velocities.exchange;
    std::vector<std::vector<double>> rows(layout_.velocities);
    for (const auto& neighbour : exchange.neighbours())
      for (const int v : neighbour.sent) {
        rows[v].clear();
        for (int at = matrix_.gradient_offsets()[v]; at < matrix_.gradient_offsets()[v + 1]; ++at)
          of_entry(at, rows[v]);
      }
    exchange.update_rows(rows);
    return rows;
  }

  /// Columns of S: own pressures, then those of others that meet own ones in a velocity node, by their numbers. Those that
  /// meet in a ghost may have no element here, and be no ghosts of the layout.
  void number_columns() {
    column_.resize(layout_.pressures);
    std::iota(column_.begin(), column_.end(), 0);
    ghost_offsets_ = {0};
    const auto& pressures = matrix_.ghosts().pressures;
    std::vector<std::int64_t> others = pressures.copies;
    std::vector<std::vector<double>> rows(layout_.velocities);
    if (!matrix_.processes().is_alone())
      rows = gradient_rows([&](int at, std::vector<double>& row) {
        row.push_back(static_cast<double>(pressures.number(matrix_.gradient_columns()[at])));
      });
    const auto is_own = [&](std::int64_t number) {
      return number >= pressures.first && number < pressures.first + pressures.own;
    };
    for (int v = layout_.own_velocities; v < layout_.velocities; ++v)
      for (const double number : rows[v])
        if (!is_own(static_cast<std::int64_t>(number))) others.push_back(static_cast<std::int64_t>(number));
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    const auto column_of = [&](std::int64_t number) {
      if (is_own(number)) return static_cast<int>(number - pressures.first);
      return pressures.own + static_cast<int>(std::lower_bound(others.begin(), others.end(), number) - others.begin());
    };
    for (int p = pressures.own; p < layout_.pressures; ++p) column_[p] = column_of(pressures.number(p));
    for (int v = layout_.own_velocities; v < layout_.velocities; ++v) {
      for (const double number : rows[v]) ghost_columns_.push_back(column_of(static_cast<std::int64_t>(number)));
      ghost_offsets_.push_back(static_cast<int>(ghost_columns_.size()));
    }
    ghost_gradient_.resize(ghost_columns_.size() * n);
    share_ = ShareOfNumbers(matrix_.processes(), pressures.own, std::move(others));
  }

  void make_pattern() {
    number_columns();
    const int own = layout_.own_pressures;
    values_.columns = share_.items();
    values_.offsets.assign(static_cast<std::size_t>(own) + 1, 0);
    std::vector<std::vector<int>> rows(own);
#pragma omp parallel
    {
      std::vector<int> seen(share_.items(), -1);
#pragma omp for schedule(static)
      for (int p = 0; p < own; ++p) {
        auto& row = rows[p];
        const auto add = [&](int q) {
          if (seen[q] == p) return;
          seen[q] = p;
          row.push_back(q);
        };
        matrix_.for_blocks_of_node(layout_.wall_pressure[p], layout_.node_of_pressure[p],
                                   [&](const double*, int v, int q, double) {
                                     if (q >= 0) add(column_[q]);
                                     if (v >= 0) for_gradient(v, [&](int column, const float*) { add(column); });
                                   });
        std::sort(row.begin(), row.end());
      }
    }
    for (int p = 0; p < own; ++p) values_.offsets[p + 1] = values_.offsets[p] + static_cast<int>(rows[p].size());
    values_.indices.reserve(values_.offsets.back());
    for (const auto& row : rows) values_.indices.insert(values_.indices.end(), row.begin(), row.end());
    values_.values.resize(values_.indices.size());
  }

  void fetch_gradients_of_ghosts() {
    if (matrix_.processes().is_alone()) return;
    const auto rows = gradient_rows([&](int at, std::vector<double>& row) {
      row.insert(row.end(), matrix_.gradient(at), matrix_.gradient(at) + n);
    });
    auto to = ghost_gradient_.begin();
    for (int v = layout_.own_velocities; v < layout_.velocities; ++v)
      for (const double number : rows[v]) *to++ = static_cast<float>(number);
  }

  void fill(const std::vector<double>& inverse_diagonal) {
    fetch_gradients_of_ghosts();
#pragma omp parallel
    {
      std::vector<int> position(share_.items(), -1);
#pragma omp for schedule(static)
      for (int p = 0; p < layout_.own_pressures; ++p) {
        for (int at = values_.offsets[p]; at < values_.offsets[p + 1]; ++at) {
          position[values_.indices[at]] = at;
          values_.values[at] = 0;
        }
        const double scale = layout_.row_scale(p);
        matrix_.for_blocks_of_node(layout_.wall_pressure[p], layout_.node_of_pressure[p],
                                   [&](const double* block, int v, int q, double factor) {
                                     if (q >= 0)
                                       values_.values[position[column_[q]]] +=
                                           scale * block[MixedLayout<n>::in_block(n, n)];
                                     if (v < 0) return;
                                     double divergence[n];  // a row of B D^-1
                                     for (int k = 0; k < n; ++k)
                                       divergence[k] = scale * factor * block[MixedLayout<n>::in_block(n, k)] *
                                                       inverse_diagonal[VectorLayout<n>::vector(v, k)];
                                     for_gradient(v, [&](int column, const float* g) {
                                       double sum = 0;
                                       for (int k = 0; k < n; ++k) sum += divergence[k] * g[k];
                                       values_.values[position[column]] -= sum;
                                     });
                                   });
      }
    }
  }

  /// C is so small in a nearly incompressible wall that the diagonal is that of -B D^-1 G.
  void scale_wall_diagonal(double factor) {
    for (int p = 0; p < layout_.own_pressures; ++p) {
      if (!layout_.wall_pressure[p]) continue;
      const auto begin = values_.indices.begin() + values_.offsets[p],
                 end = values_.indices.begin() + values_.offsets[p + 1];
      values_.values[std::lower_bound(begin, end, p) - values_.indices.begin()] *= factor;
    }
  }

  const Matrix& matrix_;
  const VelocityPressureLayout<n>& layout_;
  ShareOfNumbers share_;                            ///< of S's rows and columns
  std::vector<int> column_;                         ///< of S, per pressure of the layout
  std::vector<int> ghost_offsets_, ghost_columns_;  ///< G's rows of ghosts
  std::vector<float> ghost_gradient_;               ///< n numbers an entry
  CsrMatrix<double> values_;
  SchurComplementInverse inverse_;
  std::vector<float> residual_, solution_;
};

}  // namespace fsi
