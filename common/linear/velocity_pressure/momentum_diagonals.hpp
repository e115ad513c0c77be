#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/velocity_pressure_blocks.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// What a block preconditioner knows of the momentum's matrix A without its other entries: the diagonal D that stands for
/// it in the Schur complement, and how stiff the wall is. Of a mass matrix, a smooth velocity feels the lumped diagonal and a
/// rough one less than the diagonal, of a stiffness the smooth one feels nothing: D lies between, a fifth of the lumped
/// diagonal above the diagonal, by measurement (docs/archive.md).
template <int n>
class MomentumDiagonals {
 public:
  using Block = Eigen::Matrix<double, n, n>;

  /// Takes the present values of the blocks.
  /// \param visit      called as visit(v, diagonal block of A) for each own velocity node, in any order
  /// \param processes  that hold the others
  template <class Visit>
  void fill(const VelocityPressureBlocks<n>& blocks, bool few_pressures, Visit visit, const Communicator& processes) {
    const auto& layout = blocks.layout();
    inverse_.resize(layout.velocity_size());
    std::vector<double> diagonals(layout.velocities, 0.0), lumped_diagonals(layout.velocities, 0.0);
#pragma omp parallel for schedule(static) if (layout.own_velocities > 500)
    for (int v = 0; v < layout.own_velocities; ++v) {
      Block diagonal = Block::Zero();
      double lumped[n] = {};
      blocks.for_blocks_of(v, [&](const double* block, int u, int, double factor) {
        for (int i = 0; i < n; ++i) {
          lumped[i] += factor * block[MixedLayout<n>::in_block(i, i)];
          if (u == v)
            for (int k = 0; k < n; ++k) diagonal(i, k) += factor * block[MixedLayout<n>::in_block(i, k)];
        }
      });
      visit(v, diagonal);
      for (int k = 0; k < n; ++k)
        inverse_[VectorLayout<n>::vector(v, k)] =
            1 / (diagonal(k, k) + BlockPreconditionerChoices::lumped_share * std::max(lumped[k], 0.0));
      if (layout.fluid_of_velocity[v] < 0) {
        int k = 0;  // a component that can move
        while (k < n - 1 && !layout.is_free(v, k)) ++k;
        diagonals[v] = diagonal(k, k);
        lumped_diagonals[v] = lumped[k];
      }
    }
    stiffness_ = few_pressures ? ratio_of_sums(diagonals, lumped_diagonals, processes)
                               : mean_of_ratios(diagonals, lumped_diagonals, processes);
  }

  /// D^-1, n numbers a velocity node; of ghosts anything, until they are given the owners'.
  const std::vector<double>& inverse() const {
    return inverse_;
  }
  std::vector<double>& inverse() {
    return inverse_;
  }
  /// Diagonal over lumped diagonal of the wall's momentum: how far stiffness exceeds inertia. Without unit; 1 without a
  /// wall.
  double stiffness() const {
    return stiffness_;
  }

 private:
  static constexpr double largest_stiffness = 1e4;

  /// d / l, between 0 and largest_stiffness
  static double bounded_ratio(double d, double l) {
    return std::min(largest_stiffness, d / std::max(l, d / largest_stiffness));
  }
  /// Over the nodes that are the wall's alone; the others have zero.
  static double mean_of_ratios(const std::vector<double>& diagonals, const std::vector<double>& lumped,
                               const Communicator& processes) {
    double sums[2] = {0, 0};  // of ratios, and their number
    for (std::size_t v = 0; v < diagonals.size(); ++v) {
      const double ratio = diagonals[v] != 0 ? bounded_ratio(diagonals[v], lumped[v]) : 0;
      sums[0] += ratio;
      sums[1] += ratio > 0;
    }
    processes.sum(sums, 2);
    return sums[1] > 0 ? sums[0] / sums[1] : 1;
  }
  /// The same for quadratic velocities, whose mass matrix has negative row sums at vertices: a node's own ratio means
  /// nothing. On linear elements the two differ by 1 or 2 %.
  static double ratio_of_sums(const std::vector<double>& diagonals, const std::vector<double>& lumped,
                              const Communicator& processes) {
    double sums[2] = {0, 0};
    for (double value : diagonals) sums[0] += value;
    for (double value : lumped) sums[1] += value;
    processes.sum(sums, 2);
    return sums[0] > 0 ? bounded_ratio(sums[0], sums[1]) : 1;
  }

  std::vector<double> inverse_;
  double stiffness_ = 1;
};

}  // namespace fsi
