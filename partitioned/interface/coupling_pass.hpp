#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "case/case.hpp"
#include "linear/choice/general_solvers.hpp"
#include "partitioned/interface/gap_pressure.hpp"
#include "partitioned/interface/membrane.hpp"
#include "partitioned/interface/mesh_motion_solver.hpp"
#include "partitioned/interface/sub_problem.hpp"
#include "scene/scene.hpp"
#include "system/medium_system.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// The result of a pass. Interface vectors (interface_space.hpp) hold n numbers per interface node, ghosts behind the
/// nodes of this process; zero where the wall is clamped.
struct Pass {
  std::vector<double> residual;      ///< r(x) = x~ - x, mm
  std::vector<double> displacement;  ///< d~, the wall's displacement, mm
  double gap_part = 1;               ///< gap / r(x)

  /// The wall's displacement less the fluid's, mm.
  std::vector<double> gap() const {
    std::vector<double> gap = residual;
    scale(gap_part, gap);
    return gap;
  }
};

/// How well the sub-problems are solved in a pass.
struct PassAccuracy {
  double tolerance;           ///< of their Newton iterations, relative to their iterates
  bool linearised_wall;       ///< the wall takes one linearised step from the first guess of the stage
  int newton_iterations = 0;  ///< of each medium at most, the tolerance not read; 0: until the tolerance
  double enough = 0;          ///< part of its residual that ends them sooner
};

/// One time step, or one stage of it, as an equation r(x) = 0 for an interface vector x, evaluated by one pass through
/// the sub-problems. At its root fluid and wall have one displacement and their forces balance: the monolithic
/// solution. All processes call each function together.
template <int n>
class CouplingPass {
 public:
  /// \param wall_impedance  joins the wall's equations (MediumSystem) and must outlive this; derived classes set it
  ///                        before the first pass; null: nothing
  CouplingPass(Scene<n>& scene, const PartitionedData& options, const InterfaceImpedance* wall_impedance = nullptr)
      : CouplingPass(scene, solver_factory(options), wall_impedance) {}
  /// \param wall_solver  of the wall's linearised equations
  CouplingPass(Scene<n>& scene, const LinearSolverFactory<n>& wall_solver,
               const InterfaceImpedance* wall_impedance = nullptr)
      : scene_(scene),
        membrane_(membrane_of(scene)),
        wall_("wall", scene, number_wall(scene), wall_solver, SystemNorm::volumes, wall_impedance) {}
  virtual ~CouplingPass() = default;

  /// Starts a step, or a stage of it: state.now holds the first guess of all fields. Both must outlive the passes.
  virtual void start(State& state, StepData& data) {
    state_ = &state;
    data_ = &data;
    first_wall_ = state.now.wall;
    last_was_linearised_ = false;
    wall_.work_on(state, data);
    if (mesh_motion_) mesh_motion_->start();
  }
  /// Sets state.now to all fields extrapolated in time by `order` (0 to 2), with the boundary conditions, and starts.
  void start_from_prediction(State& state, StepData& data, int order) {
    scene_.integrator->predict(state, order, data);
    scene_.impose_conditions(state.now);
    scene_.impose_inflows(state, data);
    scene_.impose_interface(state, data.rates);
    start(state, data);
  }
  /// For loosely coupled schemes: whether the steps from now on are iterated. Only then is x the unknown of r(x) = 0.
  virtual void iterate(bool /*on*/) {}
  /// The equations of either medium by itself.
  virtual const System<n>& fluid() const = 0;
  const System<n>& wall() const { return wall_; }
  /// x of the first guess, extrapolated by `order`.
  virtual std::vector<double> first_guess(int order) = 0;
  /// r(x), the sub-problems solved as `accuracy` says; leaves their fields in the state. \throws PassFailure
  virtual Pass pass(const std::vector<double>& x, const PassAccuracy& accuracy) = 0;
  /// Solves the pass for the last x again, from the fields that pass() left. \throws PassFailure
  virtual Pass refine(const PassAccuracy& accuracy) = 0;
  /// After a first pass without a solution: makes the fluid's interface stiffer for the rest of the run.
  /// \returns false where the scheme has no such coefficient, or it is at its bound
  virtual bool stiffen() { return false; }
  /// After passes that stagnate: changes the Robin coefficient for the rest of the run. The stage must begin anew then.
  /// \returns false where there is no other coefficient
  virtual bool change_coefficient() { return false; }
  /// The stage was accepted with the last pass.
  virtual void accept() {}
  /// All stages of a step have been accepted. What they left is forgotten unless this is called before the next start()
  /// of a first stage.
  virtual void finish_step() {}
  /// Moves the mesh to the wall, where a step ends with a gap: the next velocities of the interface, differences of its
  /// positions, are then the wall's.
  /// \throws ConvergenceError when a nonlinear mesh motion finds no way there
  virtual void follow_wall() { move_mesh_to_wall(); }

  /// Pressure per gap between fluid and wall, kPa/mm: the load that moves the wall by the gap within the stage. With a
  /// large added mass the error of the fluid's pressure is that large, whatever the scheme (docs/coupling.md).
  virtual double pressure_per_gap() const { return push_stiffness(); }
  /// The pressure, kPa, that moves the wall by its own thickness within the stage.
  double pressure_of_thickness() const { return push_stiffness() * membrane_.thickness; }
  /// The pressure that would close a gap (Pass::gap()), relative to the force between fluid and wall
  /// (relative_gap_pressure()).
  virtual double pressure_residual(const std::vector<double>& gap) const {
    return relative_gap_pressure(scene_, membrane_, wall_.numbering(), *data_, gap);
  }
  /// The same in kPa, root mean square over the interface.
  double gap_pressure(const std::vector<double>& gap) const {
    return mean_gap_pressure(scene_, membrane_, wall_.numbering(), pressure_per_gap(), gap);
  }
  /// Difference between the fluid's traction and the wall's load in the last pass, kPa, root mean square over the
  /// interface. 0 where the wall is loaded with the fluid's own momentum rows.
  virtual double traction_gap() const { return 0; }

  /// Whether the fluid's domain goes with the interface in each pass.
  virtual bool domain_follows() const { return true; }
  /// Distance between the wall and the boundary of the fluid's domain, mm, root mean square over the interface.
  double domain_gap() const {
    std::vector<double> gap = wall_displacement(state_->now);
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) gap[i * n + k] -= state_->now.mesh[mesh_entry(scene_.interface[i], k)];
    return mean_gap_pressure(scene_, membrane_, wall_.numbering(), 1.0, gap);
  }
  /// Radius of the vessel (Membrane::radius), mm.
  double radius() const { return membrane_.radius; }

  /// |d~ - d^(n-1)| of the last pass, mm: the wall's movement since the last time level, Euclidean norm over the
  /// interface.
  double movement() const {
    const std::vector<double> now = wall_displacement(state_->now), last = wall_displacement(state_->before[0]);
    double sum = 0;
    for (std::size_t i = 0; i < scene_.owned_interface() * n; ++i) sum += (now[i] - last[i]) * (now[i] - last[i]);
    return std::sqrt(scene_.processes().sum(sum));
  }

  /// The residual of the momentum balance on the interface where the fluid has the wall's displacement, relative to the
  /// force between them: the interface rows of the monolithic residual of this iterate, ratio of Euclidean norms. 0
  /// without a force. Costs an assembly of the fluid's residual.
  double force_residual() {
    const Stopwatch watch(cost.fluid_seconds);
    const auto phase = scene_.profile.phase("assembly: interface balance");
    Solution moved{state_->now.mesh, state_->now.fluid, {}, state_->now.openings};
    for (const auto& node : scene_.interface)
      for (int k = 0; k < n; ++k) {
        const double gap = state_->now.wall[wall_entry(node, k)] - displacement_of_fluid(node, k);
        if (domain_follows()) moved.mesh[mesh_entry(node, k)] += gap;
        moved.fluid[fluid_entry(node, k)] += data_->rates.interface.velocity_change(gap);
      }
    std::vector<double> rows;
    scene_.assemble_fluid(moved, *data_, rows);
    std::vector<double> loads = data_->interface_load;
    scene_.fluid_frames.template to_frames<MixedLayout<n>>(rows);  // where some components are free, and others held
    scene_.wall_frames.template to_frames<MixedLayout<n>>(loads);
    double gap = 0, force = 0;
    for (std::size_t i = 0; i < scene_.owned_interface(); ++i)
      for (int k = 0; k < n; ++k) {
        const auto& node = scene_.interface[i];
        if (wall_.numbering().wall_rows[wall_entry(node, k)].index < 0) continue;
        const double load = loads[wall_entry(node, k)];
        const double lack = rows[fluid_entry(node, k)] - load;
        gap += lack * lack;
        force += load * load;
      }
    sum_over_processes(gap, force);
    return force > 0 ? std::sqrt(gap / force) : 0.0;
  }

  virtual void keep(RestartArchive& archive) { keep_linearisation("wall", wall_, archive); }

  CouplingCost cost;  ///< of the step; the stepper sets it back

 protected:
  static std::size_t mesh_entry(const InterfaceNode& node, int k) { return VectorLayout<n>::vector(node.fluid, k); }
  static std::size_t fluid_entry(const InterfaceNode& node, int k) { return MixedLayout<n>::vector(node.fluid, k); }
  static std::size_t wall_entry(const InterfaceNode& node, int k) { return MixedLayout<n>::vector(node.wall, k); }
  std::size_t interface_size() const { return scene_.interface.size() * n; }

  /// Displacement of the fluid's domain on the interface, mm; where the domain does not follow, the one that the
  /// fluid's velocity gives.
  double displacement_of_fluid(const InterfaceNode& node, int k) const {
    if (domain_follows()) return state_->now.mesh[mesh_entry(node, k)];
    return data_->rates.interface.displacement(state_->now.fluid[fluid_entry(node, k)],
                                               data_->rates.wall_reference[wall_entry(node, k)]);
  }

  double root_mean_traction(const std::vector<double>& forces) const {
    return fsi::root_mean_traction(scene_, membrane_, wall_.numbering(), forces);
  }

  void sum_over_processes(double& a, double& b) const {
    std::array<double, 2> sums{a, b};
    scene_.processes().sum(sums.data(), sums.size());
    a = sums[0];
    b = sums[1];
  }

  static LinearSolverFactory<n> solver_factory(const PartitionedData& options) {
    return general_solver_factory<n>(options.linear_solver, options.fast);
  }

  /// The wall's displacement on the interface in a solution.
  std::vector<double> wall_displacement(const Solution& solution) const {
    std::vector<double> d(interface_size());
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) d[i * n + k] = solution.wall[wall_entry(scene_.interface[i], k)];
    return d;
  }

  void move_mesh_to_wall() { extend(wall_displacement(state_->now)); }
  /// The mesh follows d on the interface. \throws PassFailure when a nonlinear motion finds no way there
  void move_mesh(const std::vector<double>& d) {
    try {
      extend(d);
    } catch (const ConvergenceError& error) {
      if (!scene_.nonlinear_mesh_motion) throw;
      throw PassFailure(error.what(), {});
    }
  }

  /// Loads the wall with the fluid's momentum rows and solves it. Rows at ghosts, other processes' nodes, which are
  /// not whole, load no row of this process.
  void solve_wall(const std::vector<double>& fluid_rows, const PassAccuracy& accuracy) {
    data_->interface_load.assign(state_->now.wall.size(), 0.0);
    for (const auto& node : scene_.interface)
      for (int k = 0; k < n; ++k) data_->interface_load[wall_entry(node, k)] = fluid_rows[fluid_entry(node, k)];
    solve_loaded_wall(accuracy);
  }

  /// A medium, as far as `accuracy` asks.
  static void solve_medium(const std::string& name, System<n>& medium, const PassAccuracy& accuracy,
                           const NewtonOptions& options, int& newton_iterations, int& linear_iterations) {
    if (accuracy.newton_iterations > 0)
      improve_sub_problem(name, medium, accuracy.newton_iterations, accuracy.enough, options, newton_iterations,
                          linear_iterations);
    else
      solve_sub_problem(name, medium, accuracy.tolerance, options, newton_iterations, linear_iterations);
  }

  /// Solves the wall under the interface load of the step's data.
  void solve_loaded_wall(const PassAccuracy& accuracy) {
    const Stopwatch watch(cost.wall_seconds);
    if (accuracy.linearised_wall) {
      state_->now.wall = first_wall_;
      solve_linearised("wall", wall_, linearised_tolerance, cost.wall_newton, cost.wall_linear);
      last_was_linearised_ = true;
      return;
    }
    if (last_was_linearised_) state_->now.wall = first_wall_;
    last_was_linearised_ = false;
    NewtonOptions options;
    options.keep_contraction = wall_contraction;
    solve_medium("wall", wall_, accuracy, options, cost.wall_newton, cost.wall_linear);
  }

  Scene<n>& scene_;
  Membrane membrane_;                                 ///< the wall on the interface
  std::unique_ptr<MeshMotionSolver<n>> mesh_motion_;  ///< made when first asked for
  MediumSystem<n> wall_;
  State* state_ = nullptr;
  StepData* data_ = nullptr;

 private:
  double push_stiffness() const { return membrane_.push_stiffness(data_->rates.acceleration_factor); }

  static constexpr double linearised_tolerance = 1e-4;
  /// Of Newton's method on the wall, before its Jacobian is renewed. Fibres that switch on and off make the tangent
  /// jump to and fro while the iterates of a step lie close together: an old Jacobian serves longer than
  /// elsewhere (artery: a quarter of the factorisations that 0.4 takes).
  static constexpr double wall_contraction = 0.6;

  void extend(const std::vector<double>& d) {
    const Stopwatch watch(cost.mesh_seconds);
    const std::vector<double> from = scene_.nonlinear_mesh_motion ? state_->now.mesh : std::vector<double>();
    for (std::size_t i = 0; i < scene_.interface.size(); ++i)
      for (int k = 0; k < n; ++k) state_->now.mesh[mesh_entry(scene_.interface[i], k)] = d[i * n + k];
    if (!mesh_motion_) mesh_motion_ = std::make_unique<MeshMotionSolver<n>>(scene_);
    mesh_motion_->solve(state_->now.mesh, from, state_->before[0].mesh);
  }

  std::vector<double> first_wall_;    ///< the wall's fields in the first guess of the stage
  bool last_was_linearised_ = false;  ///< the wall's fields are no good start for Newton's method
};

}  // namespace fsi
