#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "case/fast_options.hpp"
#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/momentum_diagonals.hpp"

namespace fsi {

/// Whether a system whose size does not tell is iterated or factorised: by the present values of a Jacobian alone, so that a
/// restart decides the same.
class IterationJudge {
 public:
  virtual ~IterationJudge() = default;
  virtual bool iterates() = 0;
};

/// A plane system is iterated where its wall is light to solve, in short steps. Of several processes all judge alike.
template <int n>
class PlaneJudge : public IterationJudge {
 public:
  /// \param blocks  of a system with a wall
  explicit PlaneJudge(const JacobianBlocks<n>& blocks)
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

  bool iterates() override {
    layout_.update();
    diagonals_.fill(
        blocks_, few_pressures_, [](int, const auto&) {}, own_, processes_);
    return diagonals_.stiffness() < FastOptions::judged_below;
  }

  /// For whoever runs it, a clause.
  static std::string says() {
    return fmt::format(
        "each Jacobian is iterated on where its wall's stiffness is below {:g} times its inertia, else factorised",
        FastOptions::judged_below);
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
