#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "linear/policy/solver_policy.hpp"
#include "linear/velocity_pressure/momentum_inverse.hpp"
#include "linear/velocity_pressure/schur_complement_inverse.hpp"

namespace fsi {

/// S = C - B D^-1 G of a VelocityPressureMatrix and its approximate inverse, by one multigrid cycle or its factor
/// (SchurComplementInverse). One scalar problem holds the pressures of fluid and wall: they meet through the interface
/// velocity, which carries the added mass.
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
    residual_.resize(layout_.pressures);
  }

  /// Takes the present values of the matrix. \param momentum  with the same, for D
  void set_up(const BlockPreconditionerChoices& choices, const MomentumInverse<n>& momentum) {
    fill(momentum.inverse_diagonal());
    if (const double factor = choices.wall_diagonal_factor(momentum.wall_stiffness(), momentum.has_few_pressures());
        factor != 1)
      scale_wall_diagonal(factor);
    ScalarMultigrid::Options options;
    options.post_smoothing = options.post_smoothing || momentum.has_few_pressures();
    inverse_.set_up(values_, options,
                    !SolverPolicy(SolvedSystem::schur_complement, n).decide(layout_.pressures).iterates);
  }

  /// p = S^-1 (r - B v), up to the rows' scale.
  /// \param r  of the pressures \param v  of the matrix's velocity_size()
  void apply(const float* r, const std::vector<float>& v, std::vector<float>& p) {
    parallel_for(layout_.pressures, layout_.pressures > 500, [&](int row) {
      residual_[row] =
          static_cast<float>(layout_.row_scale(row)) * (r[row] - matrix_.divergence_product(row, v.data()));
    });
    inverse_.apply(residual_, p);
  }

  const SchurComplementInverse& inverse() const { return inverse_; }
  std::size_t bytes() const { return values_.bytes() + inverse_.bytes() + sizeof(float) * residual_.size(); }

 private:
  /// Pressures that meet in one velocity node, or in a block of C.
  void make_pattern() {
    values_.columns = layout_.pressures;
    values_.offsets.assign(static_cast<std::size_t>(layout_.pressures) + 1, 0);
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
      values_.offsets[p + 1] = values_.offsets[p] + static_cast<int>(rows[p].size());
    values_.indices.reserve(values_.offsets.back());
    for (const auto& row : rows) values_.indices.insert(values_.indices.end(), row.begin(), row.end());
    values_.values.resize(values_.indices.size());
  }

  void fill(const std::vector<double>& inverse_diagonal) {
#pragma omp parallel
    {
      std::vector<int> position(layout_.pressures, -1);
#pragma omp for schedule(static)
      for (int p = 0; p < layout_.pressures; ++p) {
        for (int at = values_.offsets[p]; at < values_.offsets[p + 1]; ++at) {
          position[values_.indices[at]] = at;
          values_.values[at] = 0;
        }
        const double scale = layout_.row_scale(p);
        matrix_.for_blocks_of_node(layout_.wall_pressure[p], layout_.node_of_pressure[p],
                                   [&](const double* block, int v, int q, double factor) {
                                     if (q >= 0)
                                       values_.values[position[q]] += scale * block[MixedLayout<n>::in_block(n, n)];
                                     if (v < 0) return;
                                     double divergence[n];  // a row of B D^-1
                                     for (int k = 0; k < n; ++k)
                                       divergence[k] = scale * factor * block[MixedLayout<n>::in_block(n, k)] *
                                                       inverse_diagonal[VectorLayout<n>::vector(v, k)];
                                     for (int at = matrix_.gradient_offsets()[v];
                                          at < matrix_.gradient_offsets()[v + 1]; ++at) {
                                       const float* g = matrix_.gradient(at);
                                       double sum = 0;
                                       for (int k = 0; k < n; ++k) sum += divergence[k] * g[k];
                                       values_.values[position[matrix_.gradient_columns()[at]]] -= sum;
                                     }
                                   });
      }
    }
  }

  /// C is so small in a nearly incompressible wall that the diagonal is that of -B D^-1 G.
  void scale_wall_diagonal(double factor) {
    for (int p = 0; p < layout_.pressures; ++p) {
      if (!layout_.wall_pressure[p]) continue;
      const auto begin = values_.indices.begin() + values_.offsets[p],
                 end = values_.indices.begin() + values_.offsets[p + 1];
      values_.values[std::lower_bound(begin, end, p) - values_.indices.begin()] *= factor;
    }
  }

  const Matrix& matrix_;
  const VelocityPressureLayout<n>& layout_;
  CsrMatrix<double> values_;
  SchurComplementInverse inverse_;
  std::vector<float> residual_;
};

}  // namespace fsi
