#pragma once

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
    double counts[2] = {static_cast<double>(layout_.own_pressures), static_cast<double>(layout_.own_velocities)};
    processes_.sum(counts, 2);
    few_pressures_ = BlockPreconditionerChoices::has_few_pressures(counts[0], counts[1]);
  }

  /// MomentumDiagonals::stiffness() of the present values, without unit.
  double over_inertia() {
    layout_.update();
    diagonals_.fill(
        blocks_, few_pressures_, [](int, const auto&) {}, processes_);
    return diagonals_.stiffness();
  }

 private:
  const Communicator& processes_;
  bool few_pressures_ = false;
  VelocityPressureLayout<n> layout_;
  VelocityPressureBlocks<n> blocks_;
  MomentumDiagonals<n> diagonals_;
};

}  // namespace fsi
