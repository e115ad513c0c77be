#pragma once

#include "case/fast_options.hpp"
#include "condensed_solver/block_preconditioner_choices.hpp"
#include "condensed_solver/momentum_diagonals.hpp"

namespace fsi {

/// Whether a coupled plane system is iterated, for its wall is light to solve in short steps: by the present values of a
/// Jacobian alone, so that a restart decides the same.
template <int n>
class PlaneJudge {
 public:
  explicit PlaneJudge(const JacobianBlocks<n>& blocks) : layout_(blocks), blocks_(blocks, layout_) {}

  bool iterates() {
    layout_.update();
    diagonals_.fill(blocks_, BlockPreconditionerChoices::has_few_pressures(layout_.pressures, layout_.velocities),
                    [](int, const auto&) {});
    return diagonals_.stiffness() < FastOptions::judged_below;
  }

 private:
  VelocityPressureLayout<n> layout_;
  VelocityPressureBlocks<n> blocks_;
  MomentumDiagonals<n> diagonals_;
};

}  // namespace fsi
