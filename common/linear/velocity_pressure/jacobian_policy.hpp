#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "case/fast_options.hpp"
#include "linear/policy/solver_policy.hpp"
#include "linear/velocity_pressure/wall_stiffness.hpp"

namespace fsi {

/// Whether a Jacobian is iterated or factorised: SolverPolicy with what it needs to know of one. What the wall decides, it
/// decides by the present values alone, so that a restart decides the same. Of several processes all decide alike.
/// \tparam n  components of a velocity
template <int n>
class JacobianPolicy {
 public:
  /// Of a system by itself.
  /// \param options_of_iteration  the case has some, which are for an iteration on several processes
  JacobianPolicy(const JacobianBlocks<n>& blocks, const FastOptions& options, bool options_of_iteration = false)
      : JacobianPolicy(blocks,
                       SolverPolicy(SolvedSystem::jacobian, n,
                                    {options.direct_below, options_of_iteration, blocks.numbering.processes->size()}),
                       blocks.numbering.whole_size(), blocks.coupled(), nullptr) {}

  /// Of one medium of a coupled scene, decided as for the system of both. A medium that iterates beside a factorised
  /// one would be solved for each interface datum by itself, which takes longer than to iterate or to factorise both.
  /// \param size_of_both  unknowns, the mesh's included
  /// \param of_wall       where the wall's policy leaves its decision for the fluid's; the wall's Jacobian is made first
  JacobianPolicy(const JacobianBlocks<n>& blocks, const FastOptions& options, std::int64_t size_of_both,
                 std::shared_ptr<SolverDecision> of_wall)
      : JacobianPolicy(blocks, SolverPolicy(SolvedSystem::jacobian, n, {options.direct_below, false, 1}), size_of_both,
                       true, std::move(of_wall)) {}

  /// The decision depends on the Jacobian's values.
  bool wall_decides() const { return wall_decides_; }
  /// For the log: a clause on what is decided anew for each Jacobian; empty: nothing is.
  std::string rule() const { return wall_decides_ ? SolverPolicy::rule_of_wall() : ""; }
  /// On the values that the blocks hold. By all processes together.
  const SolverDecision& decision() {
    if (!decision_) decision_ = decide();
    return *decision_;
  }
  bool iterates() { return decision().iterates; }
  /// The blocks will get new values.
  void forget() { decision_.reset(); }

  const SolverPolicy& policy() const { return policy_; }

 private:
  JacobianPolicy(const JacobianBlocks<n>& blocks, SolverPolicy policy, std::int64_t size, bool coupled,
                 std::shared_ptr<SolverDecision> of_wall)
      : policy_(policy),
        size_(size),
        wall_decides_(coupled && policy_.wall_decides(size)),
        of_wall_(std::move(of_wall)) {
    if (wall_decides_ && blocks.wall) stiffness_ = std::make_unique<WallStiffness<n>>(blocks);
  }

  SolverDecision decide() {
    if (!wall_decides_) return policy_.decide(size_);
    if (!stiffness_) return *of_wall_;
    SolverDecision decision = policy_.decide_by_wall(stiffness_->over_inertia());
    if (of_wall_) *of_wall_ = decision;
    return decision;
  }

  SolverPolicy policy_;
  std::int64_t size_;
  bool wall_decides_;
  std::shared_ptr<SolverDecision> of_wall_;      ///< shared by the media of one scene
  std::unique_ptr<WallStiffness<n>> stiffness_;  ///< null where it is not asked for, or the wall is the other medium
  std::optional<SolverDecision> decision_;       ///< on the present values
};

}  // namespace fsi
