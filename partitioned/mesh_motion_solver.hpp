#pragma once

#include <vector>

#include "scene/system.hpp"

namespace fsi {

/// Extends the interface displacement harmonically into the fluid. The operator is constant: factorised once per run.
template <class Element>
class MeshMotionSolver {
 public:
  explicit MeshMotionSolver(Scene<Element>& scene) : scene_(scene), numbering_(number_mesh_motion(scene)) {
    GatheredMatrix::Builder builder(numbering_.size);
    gather_diagonal_blocks(builder, scene.mesh_motion, numbering_.mesh_rows, numbering_.mesh);
    matrix_ = GatheredMatrix(std::move(builder));
    matrix_.update();
    const auto phase = scene.profile.phase("factorisation: mesh motion");
    solver_.factorise(matrix_.matrix());
  }

  /// Overwrites the inner values of d_m, n numbers per fluid node, from those on the boundary.
  void solve(std::vector<double>& mesh) {
    const auto phase = scene_.profile.phase("solve: mesh motion");
    residual_.resize(mesh.size());
    multiply_mesh_motion<Element>(scene_.mesh_motion, mesh, residual_);
    right_hand_side_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
    add_to_system(numbering_.mesh_rows, residual_, right_hand_side_);
    solver_.solve(matrix_.matrix(), right_hand_side_, increment_);
    add_to_field(numbering_.mesh, increment_, -1.0, mesh);
  }

 private:
  Scene<Element>& scene_;
  Numbering numbering_;
  GatheredMatrix matrix_;
  DirectSolver solver_;
  std::vector<double> residual_, right_hand_side_, increment_;
};

}  // namespace fsi
