#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "linear/amg/rigid_motion_multigrid.hpp"
#include "linear/velocity_pressure/velocity_pressure_matrix.hpp"

namespace fsi {

/// Coarse levels of the wall's momentum equations. They take up what Gauss-Seidel sweeps leave where the wall's
/// stiffness exceeds its inertia: large time steps, statics. The fluid's velocities, which the mass matrix dominates,
/// stay on the finest level.
template <int n>
class WallCoarseCorrection {
 public:
  using Matrix = VelocityPressureMatrix<n>;
  static constexpr int lanes = Matrix::lanes;

  explicit WallCoarseCorrection(const Matrix& matrix) : matrix_(matrix) {
    const auto& layout = matrix.layout();
    const auto& velocities = matrix.ghosts().velocities;
    const auto is_of_wall = [&](int v) { return layout.wall_of_velocity[v] >= 0; };
    for (int v = 0; v < layout.own_velocities; ++v) {
      if (!is_of_wall(v)) continue;
      nodes_.push_back(v);
      points_.push_back(matrix.wall_points()[layout.wall_of_velocity[v]]);
      for (int k = 0; k < n && layout.partly_fixed(); ++k) fixed_.push_back(!layout.is_free(v, k));
    }
    const int own = static_cast<int>(nodes_.size());
    const std::int64_t first = matrix.processes().sum_before(std::int64_t{own});
    std::vector<double> numbers(layout.velocities, -1.0);  // among the wall's velocities of all processes
    for (int i = 0; i < own; ++i) numbers[nodes_[i]] = static_cast<double>(first + i);
    velocities.exchange.update(numbers);
    number_.assign(layout.velocities, -1);
    std::vector<std::int64_t> copies;
    for (int i = 0; i < own; ++i) number_[nodes_[i]] = i;
    for (int v = layout.own_velocities; v < layout.velocities; ++v) {
      if (numbers[v] < 0) continue;
      number_[v] = own + static_cast<int>(copies.size());
      copies.push_back(static_cast<std::int64_t>(numbers[v]));
    }
    share_ = ShareOfNumbers(matrix.processes(), own, std::move(copies));
    auto graph = std::make_shared<NodeGraph>();
    graph->offsets.push_back(0);
    for (int v : nodes_) {
      matrix.momentum().for_row(v, [&](int u, const float*) {
        if (number_[u] >= 0) graph->columns.push_back(number_[u]);
      });
      graph->offsets.push_back(static_cast<int>(graph->columns.size()));
    }
    stiffness_ = BlockMatrix<n, n>(graph);
    residual_.resize(nodes_.size() * lanes);
    correction_.resize(nodes_.size() * lanes);
  }

  /// Takes the present values of the matrix.
  void set_up(const typename RigidMotionMultigrid<n>::Options& options) {
    int at = 0;
    for (const int v : nodes_)
      matrix_.momentum().for_row(v, [&](int u, const float* from) {
        if (number_[u] < 0) return;
        double* to = stiffness_.block(at++);
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < n; ++k) to[i * n + k] = from[k * lanes + i];
      });
    multigrid_.set_up(stiffness_, share_, points_, options, fixed_);
  }

  /// velocity += correction for `residual`, at own velocity nodes of the wall; ghosts stay as they are. Both have
  /// `lanes` floats a velocity node. By all processes together.
  void add(const std::vector<float>& residual, std::vector<float>& velocity) {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      store<n>(load<n>(residual.data() + static_cast<std::size_t>(nodes_[i]) * lanes), residual_.data() + i * lanes);
    std::fill(correction_.begin(), correction_.end(), 0.0f);
    multigrid_.correct(residual_, correction_);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      float* to = velocity.data() + static_cast<std::size_t>(nodes_[i]) * lanes;
      store<n>(load<n>(to) + load<n>(correction_.data() + i * lanes), to);
    }
  }

  const RigidMotionMultigrid<n>& multigrid() const { return multigrid_; }
  std::size_t bytes() const {
    return multigrid_.bytes() + 8 * stiffness_.values.size() + sizeof(float) * 2 * residual_.size();
  }

 private:
  const Matrix& matrix_;
  std::vector<int> nodes_;   ///< own velocity nodes of the wall
  std::vector<int> number_;  ///< per velocity node, among these and then ghosts; -1: not the wall's
  ShareOfNumbers share_;
  std::vector<std::array<double, 3>> points_;  ///< their places at rest
  std::vector<char> fixed_;                    ///< per node and component: no unknown; empty: none
  BlockMatrix<n, n> stiffness_;
  RigidMotionMultigrid<n> multigrid_;
  std::vector<float> residual_, correction_;
};

}  // namespace fsi
