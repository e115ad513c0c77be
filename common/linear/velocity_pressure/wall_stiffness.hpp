#pragma once

#include <vector>

#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/momentum_diagonals.hpp"

namespace fsi {

/// How far the stiffness of a wall exceeds its inertia in a Jacobian: large in long steps and in statics. Processes that
/// share a scene find one number together.
template <int n>
class WallStiffness {
 public:
  /// \param blocks  of a system with a wall
  explicit WallStiffness(const JacobianBlocks<n>& blocks)
      : processes_(*blocks.numbering.processes), layout_(blocks), blocks_(blocks, layout_) {
    double counts[2] = {static_cast<double>(layout_.pressures), static_cast<double>(layout_.velocities)};
    processes_.sum(counts, 2);
    few_pressures_ = BlockPreconditionerChoices::has_few_pressures(counts[0], counts[1]);
    if (processes_.is_alone()) return;
    own_.assign(layout_.velocities, 0);
    for (int v = 0; v < layout_.velocities; ++v)
      layout_.for_nodes_of(
          v, [&](const auto& of) { own_[v] = (of.wall ? blocks.wall_nodes : blocks.fluid_nodes)->owns(of.node); });
  }

  /// MomentumDiagonals::stiffness() of the present values, without unit.
  double over_inertia() {
    layout_.update();
    diagonals_.fill(
        blocks_, few_pressures_, [](int, const auto&) {}, own_, processes_);
    return diagonals_.stiffness();
  }

 private:
  const Communicator& processes_;
  std::vector<char> own_;  ///< per velocity: it has rows here; empty: all have
  bool few_pressures_ = false;
  VelocityPressureLayout<n> layout_;
  VelocityPressureBlocks<n> blocks_;
  MomentumDiagonals<n> diagonals_;
};

}  // namespace fsi
