#pragma once

#include <vector>

#include "system/system.hpp"

namespace fsi {

/// Extends the interface displacement harmonically into the fluid. The operator is constant: factorised once per run,
/// or as often as the scene assembles it.
template <class Element>
class MeshMotionSolver {
 public:
  explicit MeshMotionSolver(Scene<Element>& scene) : scene_(scene), numbering_(number_mesh_motion(scene)) {
    factorise();
  }

  /// Overwrites the inner values of d_m, n numbers per fluid node, from those on the boundary.
  void solve(std::vector<double>& mesh) {
    scene_.renew_constant_operators();
    if (factorised_ != scene_.mesh_motion_assemblies) factorise();
    const auto phase = scene_.profile.phase("solve: mesh motion");
    residual_.resize(mesh.size());
    multiply_mesh_motion<Element>(scene_.mesh_motion, mesh, residual_);
    right_hand_side_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
    add_to_system(numbering_.mesh_rows, residual_, right_hand_side_);
    solver_.solve(matrix_.matrix(), right_hand_side_, increment_);
    add_to_field(numbering_.mesh, increment_, -1.0, mesh);
  }

 private:
  void factorise() {
    GatheredMatrix::Builder builder(numbering_.size);
    gather_diagonal_blocks(builder, scene_.mesh_motion, numbering_.mesh_rows, numbering_.mesh);
    matrix_ = GatheredMatrix(std::move(builder));
    matrix_.update();
    const auto phase = scene_.profile.phase("factorisation: mesh motion");
    solver_ = DirectSolver();
    solver_.factorise(matrix_.matrix());
    factorised_ = scene_.mesh_motion_assemblies;
  }

  Scene<Element>& scene_;
  Numbering numbering_;
  GatheredMatrix matrix_;
  DirectSolver solver_;
  int factorised_ = 0;  ///< the assembly whose operator it is
  std::vector<double> residual_, right_hand_side_, increment_;
};

}  // namespace fsi
