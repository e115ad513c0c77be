#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "linear/interface/low_rank_solver.hpp"
#include "system/given_flows.hpp"
#include "system/numbering.hpp"

namespace fsi {

/// What openings add to the equations of the fluid beside its block matrices: how pressures depend on the flow, and
/// where the flow is given the pressure as an unknown, with an equation of its own.
template <int n>
class OpeningTerms {
 public:
  /// \param scene  must outlive this
  explicit OpeningTerms(const Scene<n>& scene) : scene_(scene) {}
  OpeningTerms(const OpeningTerms&) = delete;  // solvers refer to the terms
  OpeningTerms& operator=(const OpeningTerms&) = delete;

  /// Makes the terms of a system with the fluid's equations. \returns a solver with these terms, or `solver` itself
  /// where there are none
  std::unique_ptr<LinearSolver> join(const JacobianBlocks<n>& blocks, std::unique_ptr<LinearSolver> solver);

  /// Whether an opening moves: derivatives then depend on its pressure.
  bool move() const;
  /// Whether slopes of pressures depend on more than the step: where a network joins openings.
  bool vary() const { return !scene_.openings.joined().empty(); }
  /// GivenFlows::gap() of each, mm^3/ms.
  std::vector<double> gaps() const;

  /// GivenFlows::compare(): finds the gaps of state.now. \returns their part of the residual's squared norm
  double compare(const State& state, const StepData& data) { return given_flows_.compare(state, data); }
  /// The terms as they are at a solution. \param of_mesh  the mesh has unknowns
  void linearise(const Solution& now, const StepRates& rates, bool of_mesh);
  /// Before a linear solve: sets the right-hand sides of given flows to the gaps,
  void set_gaps();
  /// or, before a further solve with other forces, to zero.
  void close_gaps();
  /// After a linear solve: takes the increments of the pressures from the solver,
  void take_increments();
  /// or, after a further solve, adds to them.
  void add_answers();
  /// Pressures that are unknowns += step times their increments.
  void add_increments(double step, Solution& now) const;

  /// terms += |J| |x|, J being the terms last made. \returns the part of given flows in the squared norm of |J| |x|
  double add_absolute_products(const Numbering& numbering, const std::vector<double>& x, const Solution& now,
                               double fluid_factor, std::vector<double>& terms) const;

 private:
  /// The slopes of openings that a network joins.
  void linearise_network(const FluidInput& in, const StepRates& rates);
  /// The term of the i-th flow that is given: they are the last ones, behind those of laws and of the network.
  std::size_t term_of(std::size_t given_flow) const { return terms_.size() - given_flows_.count() + given_flow; }

  /// Of an opening that moves, at the last linearisation.
  struct Moving {
    std::vector<double> normals, by_mesh;
  };

  const Scene<n>& scene_;
  std::vector<OpeningTerm> terms_;
  std::vector<Moving> moving_;               ///< in their order, empty for openings that stay
  std::vector<std::vector<double>> slopes_;  ///< of openings that a network joins, by the flows of all terms
  GivenFlows<n> given_flows_;
  std::vector<double> increments_;                  ///< of the pressures where the flow is given
  const LowRankLinearSolver<n>* solver_ = nullptr;  ///< where there are terms
};

}  // namespace fsi
