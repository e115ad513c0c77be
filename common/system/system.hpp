#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "linear/interface/direct_linear_solver.hpp"
#include "linear/interface/linear_solver.hpp"
#include "nonlinear/newton.hpp"
#include "system/field_norms.hpp"
#include "system/numbering.hpp"
#include "system/opening_terms.hpp"

namespace fsi {

/// The data that a Jacobian was made from: enough to make the same one again after a restart.
struct LinearisationPoint {
  Solution now;
  /// But for the wall's history, and its references where it is not viscous: no derivative depends on them.
  StepRates rates;
  bool viscous_wall = false, branches = false;  ///< the rates have references of a viscous wall, of Maxwell branches
  double wall_pressure = 0;                     ///< kPa
  std::vector<double> support_loads = {};       ///< kPa
  /// kPa, where openings move or a network joins them; else empty: no derivative depends on them.
  std::vector<double> opening_pressures = {};
};

/// The discrete equations of a scene, or of one of its sub-problems, under a numbering: residual, Jacobian and linear
/// solve, as Newton's method asks for them. Owns the matrices of its Jacobian: several systems on one scene each have
/// their own, but for the constant operator of the mesh motion. Works on a State that it does not own. Where the scene
/// is shared out, each process has the equations of its nodes, all call it together, and all get the same norms.
/// linearise(), solve() and distance() throw Stopped where the program was asked to end.
template <int n>
class System : public NewtonProblem {
 public:
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  /// \param name         for the profile: "coupled", "fluid", "wall"
  /// \param make_solver  of the linearised equations; none: the direct one
  System(std::string name, Scene<n>& scene, Numbering numbering, const LinearSolverFactory<n>& make_solver = {},
         SystemNorm norm = SystemNorm::volumes);
  System(const System&) = delete;  // the solver refers to the numbering
  System& operator=(const System&) = delete;

  const Numbering& numbering() const { return numbering_; }
  const std::vector<double>& residual() const { return residual_; }
  const LinearSolver& solver() const { return *solver_; }
  /// The Jacobian, for as long as the system lives; its values are those of the last linearise().
  JacobianBlocks<n> blocks() const;
  /// Values of its matrices of the media; null where a medium has no unknowns.
  const std::vector<double>* fluid_values() const {
    return numbering_.has_fluid() ? &fluid_jacobian_.fluid.values : nullptr;
  }
  const std::vector<double>* wall_values() const { return numbering_.has_wall() ? &wall_jacobian_.values : nullptr; }
  const LinearisationPoint& linearisation_point() const { return point_; }
  /// Rows of the fluid's last residual before boundary conditions: on the interface the force of the fluid on the wall.
  const std::vector<double>& fluid_residual() const { return fluid_residual_; }

  /// Outward flows less the given ones, at openings that move, at the last evaluation, mm^3/ms.
  std::vector<double> flow_gaps() const { return openings_.gaps(); }

  /// The state and step that evaluate(), linearise() and move() refer to from now on.
  /// A Jacobian made for other factors than this step's is no longer kept.
  void work_on(State& state, const StepData& data);

  double evaluate() override;
  void linearise() override;
  bool linearised() const override { return usable_ && solver_->ready(); }
  bool outdated() const override { return numbering_.has_fluid() && scene_.openings.joined().outdated(); }

  /// The Jacobian at hand is not used any more, as after a failed step.
  void forget_jacobian() { usable_ = false; }

  /// Makes the Jacobian of an earlier step again, bit for bit (restart).
  void linearise_at(const LinearisationPoint& point);

  double solve(double tolerance) override;
  double distance(double tolerance) override;
  /// Norm of the increment, as solve() returns it.
  double increment_norm() const { return norms_.of_increment(increment_); }

  double keep_contraction() const override { return solver_->keep_contraction(); }
  int linear_iterations() const override { return linear_report_.iterations; }
  std::string linear_failure() const override { return linear_report_.failure; }

  void move(double step) override;

  double size() const override { return norms_.of_solution(state_->now); }
  bool negligible(double, double share) const override { return norms_.negligible(increment_, state_->now, share); }
  double relative_increment() const override { return norms_.relative_to_change(increment_, *state_, *data_); }

  /// eps times the norm of |J| |x|: the size of the terms that cancel in the residual. Stresses are sums of terms as
  /// small as the strain (materials/strain.hpp), so that none of them is of order one.
  double rounding() override;

 protected:
  const Communicator& processes() const { return *numbering_.processes; }
  Profile::Scope solve_phase() const { return scene_.profile.phase("solve: " + name_); }

  /// Further terms of a subclass: added to the residual, and to the matrices of the Jacobian, whenever they are made.
  virtual void add_further_rows(std::vector<double>& /*residual*/) const {}
  virtual void add_further_derivatives(FluidJacobian<n>& /*fluid*/, WallMatrix<n>& /*wall*/) const {}

  /// Whether the media's rows belong to the present state.
  bool has_rows() const { return has_rows_; }
  /// Sets the residual from the media's rows, the interface's load and further rows.
  void gather_residual();
  /// \param valid  at this process; the norm is NaN where it is false at any of them
  double norm_of_residual(bool valid);

  /// Equations += the rows of a part, which are along the axes of space.
  template <class Layout>
  void add_rows(const UnknownMap& map, const NodalFrames<n>& frames, const std::vector<double>& rows,
                std::vector<double>& equations);

  /// Increment = -J^-1 b. \returns its norm
  double solve_for(const std::vector<double>& b, double tolerance);

 private:
  static std::vector<InterfacePair> interface_pairs(const Scene<n>& scene);
  static FluidJacobian<n> make_fluid_jacobian(const Scene<n>& scene, const Numbering& numbering);

  AssemblyResult assemble(bool derivatives);

  /// field += step * (the increment of its unknowns)
  template <class Layout>
  void add_increment(const UnknownMap& map, const NodalFrames<n>& frames, double step,
                     std::vector<double>& field) const;

  /// Whether derivatives depend on pressures at openings or on what openings keep: one moves, or a network joins some.
  bool openings_differ() const { return !numbering_.fluid_rows.empty() && (openings_.move() || openings_.vary()); }

  /// Whether these rates would give another Jacobian than the one at hand.
  bool rates_differ(const StepRates& rates) const;

  std::string name_;

 protected:
  Scene<n>& scene_;
  Numbering numbering_;

 private:
  FluidJacobian<n> fluid_jacobian_;
  WallMatrix<n> wall_jacobian_;
  std::vector<InterfacePair> interface_;
  MeshMotionTangent<n> mesh_tangent_;  ///< of a nonlinear mesh motion; empty otherwise

 protected:
  OpeningTerms<n> openings_;
  std::unique_ptr<LinearSolver> solver_;  ///< refers to what stands above
  LinearReport linear_report_;
  State* state_ = nullptr;
  const StepData* data_ = nullptr;
  std::vector<double> residual_, increment_;
  std::vector<double> answer_;  ///< of a further solve

 private:
  FieldNorms<n> norms_;
  LinearisationPoint point_;
  bool usable_ = false;  ///< the solver's Jacobian belongs to the step's rates
  bool has_rows_ = false;
  std::vector<double> mesh_residual_, fluid_residual_, wall_residual_;
  std::vector<double> rows_;         ///< of a part in its frames
  std::vector<double> loaded_rows_;  ///< the wall's, with the interface's load
};

}  // namespace fsi
