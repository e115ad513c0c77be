#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "nonlinear/newton.hpp"
#include "partitioned/accelerators/affine_map.hpp"
#include "partitioned/block_newton/joint_iteration.hpp"
#include "partitioned/interface/membrane.hpp"
#include "partitioned/interface_space.hpp"
#include "partitioned/medium_solvers.hpp"
#include "scene/scene.hpp"
#include "system/medium_system.hpp"

namespace fsi {

/// What the passes of block Newton took so far.
struct BlockNewtonCost {
  int newton_iterations = 0;              ///< of both media together
  int passes = 0;                         ///< each one cycle, or linear solve, of either medium
  int fluid_linear = 0, wall_linear = 0;  ///< Krylov iterations; 0 with direct solvers
  double fluid_seconds = 0, wall_seconds = 0, algebra_seconds = 0;
};

/// Fluid and wall as one problem for Newton's method whose linear systems are solved by passes between the two: the
/// block Newton method of [Fernandez2005], with a Robin condition on the fluid (docs/theory.md, section 10.4). Each
/// medium has a Jacobian and a linear solver of its own; they exchange velocities and loads of the interface, nothing
/// else.
///
/// Unknowns are the fluid with its domain, which follows its velocity u on the interface, the wall with its
/// displacement d, and the datum v of the Robin condition. F and W being the momentum rows of fluid and wall on the
/// interface, and C nodal areas times an impedance, the residual is
///   F + W              the balance: rows of the wall, whose load is F,
///   C_1 (v(d) - u)     the kinematics as a force, v(d) being the wall's velocity and C_1 the membrane's C,
/// and the rows of both media away from the interface. The datum enters linearly, and alone F + C (u - v) = 0: at each
/// residual it is taken so that this holds. A pass answers to a change dv of it,
///   J_f du + C (du - dv) = -R_f,   J_w dd = -R_w + C (du - dv),
/// and assembles nothing. The gap that it leaves is an affine function of dv, whose slope is the same for as long as
/// both Jacobians are kept, over time steps too: what passes have told of it stays exact (affine_map.hpp).
template <int n>
class BlockNewtonProblem : public NewtonProblem {
 public:
  /// \param stiffness  factor of C over the membrane's impedance (robin_stiffness())
  BlockNewtonProblem(Scene<n>& scene, const PartitionedData& options, double stiffness);

  /// The step, or stage of it, that evaluate() and the others refer to from now on. Both must outlive that.
  void work_on(State& state, StepData& data);

  double evaluate() override;
  void linearise() override;
  bool linearised() const override { return fluid_.linearised() && wall_.linearised(); }
  bool outdated() const override { return fluid_.outdated(); }
  double solve(double tolerance) override;
  double keep_contraction() const override { return wall_.keep_contraction(); }
  int linear_iterations() const override { return linear_iterations_; }
  std::string linear_failure() const override { return failure_; }
  void move(double step) override;
  double size() const override;
  bool negligible(double increment, double share) const override;
  double relative_increment() const override;
  double rounding() override;

  /// At the last residual, between the wall's displacement and the one that the fluid's velocity gives, mm.
  double gap() const { return space_.norm(gap_); }
  /// gap() over the wall's displacement on the interface; 0 where that is zero, whatever the gap.
  double relative_gap() const;
  /// The pressure that would close the gap, relative to the force between fluid and wall (relative_gap_pressure()).
  double relative_pressure() const;
  /// The same in kPa, root mean square over the interface.
  double gap_pressure() const;
  /// Norm of the last residual over the force between fluid and wall; 0 without a force.
  double relative_residual() const;
  const System<n>& fluid() const { return fluid_; }
  const System<n>& wall() const { return wall_; }
  /// LinearSolver::decides() of the wall; the fluid's is the same.
  std::string linear_decision() const { return wall_.solver().decides(); }
  /// Pairs and rank that corrections of the datum are made of.
  int columns() const { return map_.columns(); }
  void keep(RestartArchive& archive);

  BlockNewtonCost cost;  ///< of the step; its owner sets it back

 private:
  /// Where the linear iteration fails C is multiplied by this factor, at most so many times. A pressure load that turns
  /// with the interface makes the fluid's own matrix indefinite where C is small beside it.
  static constexpr double stiffening = 10;
  static constexpr int most_stiffenings = 4, most_joint_stiffenings = 2;

  /// Residuals of the linear systems of both media, and the gap that their increments leave, mm.
  struct LinearResidual {
    std::vector<double> fluid, wall, gap;
  };
  struct Media {
    MediumPreconditioner *fluid, *wall;
  };

  BlockNewtonProblem(Scene<n>& scene, const PartitionedData& options, double stiffness,
                     const MediumSolvers<n>& solvers);
  std::vector<double> impedance_of(const StepRates& rates) const;
  std::vector<double> interface_gap() const;
  /// Euclidean norm of C_1 times displacements / period: the force that a gap stands for in the error of the solution.
  /// A stiffer C would overrate it.
  double as_force(const std::vector<double>& displacements) const;
  /// Euclidean norm of the fluid's force on the wall over the interface, kPa mm^2.
  double load() const;
  /// Euclidean norm of the wall's displacement on the interface, mm.
  double displacement() const;
  /// The same of its last increment.
  double displacement_increment() const;
  /// Finds both increments by passes, until the gap is small beside the increments of displacement and load on the
  /// interface. It is not compared with the residual, whose rows have different units.
  /// \returns whether it converges
  bool solve_by_passes(double tolerance);
  /// The same where both media iterate, by one iteration over both (joint_iteration.hpp), in which a pass takes one
  /// cycle of each. \returns whether it converges; false also where a medium has no preconditioner
  bool solve_jointly(double tolerance);
  /// Sets the factor of C, and makes the fluid's Jacobian again.
  void stiffen(double stiffness);
  /// linear_residual_ of the increments and of the datum as they are.
  void find_linear_residual();
  /// Corrects them by an iteration over both media. \returns its passes
  int correct_jointly(const Media& media, double accuracy, int most_iterations);
  /// The first pass of a linear system: the datum as it is.
  bool first_pass(double tolerance);
  /// A pass with the datum changed by dx / period.
  bool next_pass(const std::vector<double>& dx, double tolerance);
  /// wall_forces_ becomes the change of -C (du - dv) since it was made last.
  void load_wall();
  /// Counts what the last solve of a medium took. \returns `solved`
  bool note(const System<n>& medium, bool solved, int& iterations);
  /// The gap that the increments so far leave.
  std::vector<double> gap_left() const;

  Scene<n>& scene_;
  Membrane membrane_;
  double stiffness_;
  int most_passes_;
  InterfaceImpedance robin_;
  MediumSystem<n> fluid_, wall_;
  InterfaceSpace space_;
  AffineMap map_;  ///< from x_ to the gap
  JointIteration<n> joint_;
  bool joint_is_current_ = false;  ///< joint_ knows these Jacobians
  double period_ = 0;              ///< ms, of the interface kinematics that map_ belongs to
  State* state_ = nullptr;
  StepData* data_ = nullptr;
  std::vector<double> gap_;                         ///< at the last residual, n numbers per interface node, mm
  std::vector<double> x_;                           ///< period dv, likewise
  std::vector<double> loads_;                       ///< -C (du - dv), likewise, kPa mm^2
  std::vector<double> fluid_forces_, wall_forces_;  ///< nodal values of the media, zero away from the interface
  double residual_ = 0;                             ///< norm of the last one
  LinearResidual linear_residual_;
  std::vector<double> correction_;             ///< of a medium
  std::vector<float> right_, joint_solution_;  ///< block vectors of joint_
  int linear_iterations_ = 0;
  std::string failure_;
};

}  // namespace fsi
