#pragma once

#include "condensed_solver/block_preconditioner_choices.hpp"
#include "condensed_solver/momentum_diagonals.hpp"

namespace fsi {

/// Whether the wall's inertia exceeds its stiffness, as in short steps: by the present values of a coupled Jacobian alone, so
/// that a restart decides the same.
template <int n>
class InertiaJudge {
 public:
  explicit InertiaJudge(const JacobianBlocks<n>& blocks) : layout_(blocks), blocks_(blocks, layout_) {}

  bool inertia_prevails() {
    layout_.update();
    const BlockPreconditionerChoices choices;
    diagonals_.fill(blocks_, BlockPreconditionerChoices::has_few_pressures(layout_.pressures, layout_.velocities),
                    [](int, const auto&) {});
    return choices.inertia_prevails(diagonals_.stiffness());
  }

 private:
  VelocityPressureLayout<n> layout_;
  VelocityPressureBlocks<n> blocks_;
  MomentumDiagonals<n> diagonals_;
};

}  // namespace fsi
