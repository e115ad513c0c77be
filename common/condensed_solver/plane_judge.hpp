#pragma once

#include "case/fast_options.hpp"
#include "condensed_solver/block_preconditioner_choices.hpp"
#include "condensed_solver/momentum_diagonals.hpp"

namespace fsi {

/// Whether a system whose size does not tell is iterated or factorised: by the present values of a Jacobian alone, so that a
/// restart decides the same.
class IterationJudge {
 public:
  virtual ~IterationJudge() = default;
  virtual bool iterates() = 0;
};

/// A plane system is iterated where its wall is light to solve, in short steps.
template <int n>
class PlaneJudge : public IterationJudge {
 public:
  /// \param blocks  of a system with a wall
  explicit PlaneJudge(const JacobianBlocks<n>& blocks) : layout_(blocks), blocks_(blocks, layout_) {}

  bool iterates() override {
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
