#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "base/profile.hpp"
#include "case/choices.hpp"
#include "fem/nodal_frames.hpp"
#include "fluid/fluid.hpp"
#include "mesh_motion/mesh_motion.hpp"
#include "mesh_motion/nonlinear_mesh_motion.hpp"
#include "openings/openings.hpp"
#include "parallel/whole_order.hpp"
#include "scene/dirichlet_conditions.hpp"
#include "scene/prescribed_inflow.hpp"
#include "scene/varying_constant.hpp"
#include "time/time_integrator.hpp"
#include "wall/wall.hpp"

namespace fsi {

/// A node of the fluid-wall interface in the numbers of both sides; of the wall's copies of a node, the original.
struct InterfaceNode {
  int fluid, wall;
  bool clamped;  ///< on the wall's clamped ends: nothing moves there
};

/// The sub-problems of one scene with their boundary conditions: what both drivers march in time. Parts that the case
/// does not have are not built.
template <int n>
class Scene {
 public:
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  using Conditions = DirichletConditions<n>;

  std::unique_ptr<Fluid<n>> fluid;
  std::unique_ptr<Wall<n>> wall;
  Openings<n> openings;                                           ///< behind the fluid's open boundaries
  std::unique_ptr<MeshMotion<n>> mesh_motion_problem;             ///< null unless fluid and wall meet; see below
  MeshMotionMatrix<n> mesh_motion;                                ///< its operator; empty where that is null
  std::unique_ptr<NonlinearMeshMotion<n>> nonlinear_mesh_motion;  ///< where the case asks for one: both above are empty
  int mesh_motion_assemblies = 0;        ///< what is made of the matrix is as old as the count it was made at
  bool keep_constant_operators = true;   ///< false: assembled at each use, to see what keeping them saves
  std::vector<InterfaceNode> interface;  ///< this process's first, then ghosts; each ascending in the fluid's numbers
  std::size_t interface_ghosts = 0;      ///< how many at the end are other processes'
  std::vector<double> interface_areas;   ///< that belongs to each of them, mm^2
  double closed_area = 0;                ///< mm^2, of all processes: where the fluid sticks to a rigid wall
  std::array<int, n> axes{};             ///< of space, 0 to 2, that the components of vectors lie along
  Conditions velocity_conditions;        ///< of the fluid's velocity
  Conditions mesh_conditions;            ///< of the mesh displacement
  Conditions wall_conditions;            ///< of the wall's displacement
  std::vector<PrescribedInflow<n>> inflows;  ///< velocities at openings whose flow is given
  NodalFrames<n> fluid_frames;               ///< of nodes held along no axis of space: for velocity and mesh conditions
  NodalFrames<n> wall_frames;                ///< on the interface those of the fluid
  std::unique_ptr<const TimeIntegrator> integrator = std::make_unique<QuasiStatic>();
  /// The load under which the scene is at rest; none: no load.
  struct InitialLoad {
    double pressure = 0;                ///< kPa, of the fluid, at all openings and on the inner face of a wall alone
    std::vector<double> support_loads;  ///< kPa
    std::vector<double> wall;           ///< (0, p) in the wall, mixed layout
  };
  std::optional<InitialLoad> initial_load;
  std::optional<FibreFrame> fibre_frame;  ///< that fibres lie in; empty: there are none
  /// Of the constants that are not the same in the whole wall, by name: their means in the wall's cells here.
  std::map<std::string, std::vector<double>> wall_constants;
  std::optional<WholeOrder> wall_cell_order;       ///< of those cells, where processes share them
  std::vector<VaryingConstant> varying_constants;  ///< those that vary within a layer
  std::vector<std::string> layer_names;            ///< of the wall, in the order of Wall::layer_data()
  /// Bound of det F in nearly incompressible layers.
  double volume_factor = std::numeric_limits<double>::infinity();
  std::vector<std::string> notices;  ///< what was taken in place of what the case asks for, sentences for the user
  std::vector<std::string> remarks;  ///< what else a user may want to know of it, for the log
  int predictor = 1;                 ///< order of the extrapolated start of each step
  mutable Profile profile;           ///< also of callers that only read the scene

  bool coupled() const { return fluid && wall; }
  /// Of its nodes, the first so many are this process's: what sums over the interface count.
  std::size_t owned_interface() const { return interface.size() - interface_ghosts; }
  /// Of the whole interface, mm^2. To be called by all processes.
  double interface_area() const {
    const auto own = interface_areas.begin() + static_cast<std::ptrdiff_t>(owned_interface());
    return processes().sum(std::accumulate(interface_areas.begin(), own, 0.0));
  }
  /// That solve the scene together.
  const Communicator& processes() const {
    return fluid ? fluid->nodes().processes() : wall ? wall->nodes().processes() : Communicator::alone();
  }
  bool is_static() const { return integrator->is_static(); }

  /// Assembles the mesh motion's operator; its storage stays in place.
  void assemble_mesh_motion() {
    const auto phase = profile.phase("assembly: mesh motion");
    if (mesh_motion.values.empty()) mesh_motion = MeshMotionMatrix<n>(mesh_motion_problem->graph());
    mesh_motion_problem->assemble(mesh_motion);
    ++mesh_motion_assemblies;
  }
  /// The smallest J of a mesh displacement at a quadrature point, and the fluid's cell that it is in, of those here.
  AssemblyResult smallest_volume_ratio(const std::vector<double>& mesh) const {
    return mesh_motion_problem ? mesh_motion_problem->smallest_volume_ratio(mesh)
                               : nonlinear_mesh_motion->smallest_volume_ratio(mesh);
  }
  /// To be called before each use of operators that never change.
  void renew_constant_operators() {
    if (!keep_constant_operators && mesh_motion_problem) assemble_mesh_motion();
  }

  /// The state at rest, but for prescribed values.
  State at_rest() const {
    State state;
    Solution zero;
    if (fluid) zero.fluid.assign(fluid->space().mixed_size(), 0.0);
    if (coupled()) zero.mesh.assign(fluid->space().vector_size(), 0.0);
    if (wall) {
      zero.wall.assign(wall->space().mixed_size(), 0.0);
      state.wall_velocity.assign(wall->space().vector_size(), 0.0);
      state.wall_acceleration = state.wall_velocity;
    }
    state.now = zero;
    if (wall && wall->supports()) state.support_loads = wall->supports()->load_count();
    if (initial_load) {
      for (int a = 0; fluid && a < fluid->node_count(); ++a)
        if (fluid->space().carries_scalar(a)) state.now.fluid[Mixed::scalar(a)] = initial_load->pressure;
      if (wall) state.now.wall = initial_load->wall;
    }
    impose_conditions(state.now);
    state.now.openings = openings.start(initial_load ? initial_load->pressure : 0.0);
    if (wall) {
      state.has_branches = wall->branch_places().entries > 0;
      if (state.has_branches) state.now.branches = wall->relaxed_branches(state.now.wall);
    }
    state.before = {state.now, state.now, state.now};
    integrator->prepare(state);
    if (!state.rate.openings.empty())
      state.rate.openings = openings.start_rates(state.now.openings, state.now.mesh, state.now.fluid);
    if (!state.velocity_rate.empty() || !state.rate.fluid.empty())
      state.load_rates.assign((fluid ? fluid->open_boundaries().size() : 0) + state.support_loads + 1, 0.0);
    if (initial_load && !state.load_rates.empty()) {
      const auto& loads = initial_load->support_loads;
      std::fill(state.load_rates.begin(), state.load_rates.end(), initial_load->pressure);
      std::copy(loads.begin(), loads.end(), state.load_rates.end() - 1 - static_cast<std::ptrdiff_t>(loads.size()));
    }
    return state;
  }

  /// What the element loops read of a state, or solution, in a step with these rates.
  FluidInput fluid_input(const State& state, const StepRates& rates) const { return fluid_input(state.now, rates); }
  WallInput wall_input(const State& state, const StepRates& rates) const { return wall_input(state.now, rates); }
  /// With the loads of the wall's supports, too, which `data` must outlive.
  WallInput wall_input(const Solution& now, const StepData& data) const {
    WallInput in = wall_input(now, data.rates);
    if (!data.support_loads.empty()) in.support_loads = data.support_loads.data();
    return in;
  }
  FluidInput fluid_input(const Solution& now, const StepRates& rates) const {
    FluidInput in;
    if (coupled()) {
      in.mesh = now.mesh.data();
      in.mesh_reference = rates.mesh_reference.data();
      in.mesh_factor = rates.interface.rate();
    }
    in.fluid = now.fluid.data();
    in.fluid_reference = rates.fluid_reference.data();
    in.fluid_factor = rates.fluid_factor;
    in.step = rates.interface.period;
    return in;
  }
  /// The fluid's residual at a solution, as Fluid::assemble(), with what lies behind its openings.
  AssemblyResult assemble_fluid(const Solution& at, const StepData& data, std::vector<double>& residual,
                                FluidJacobian<n>* jacobian = nullptr) const {
    const FluidInput in = fluid_input(at, data.rates);
    return fluid->assemble(in, opening_pressures(at, data), residual, jacobian);
  }
  /// From outside at a balance, kPa, of the fluid's open boundaries in their order; missing ones are zero.
  std::vector<double> opening_pressures(const Solution& at, const StepData& data) const {
    return openings.pressures(data.opening_pressures, fluid_input(at, data.rates), data.rates.time,
                              data.rates.openings_reference, at.openings);
  }
  WallInput wall_input(const Solution& now, const StepRates& rates) const {
    WallInput in;
    in.wall = now.wall.data();
    if (!rates.is_static()) {
      in.acceleration_history = rates.acceleration_history.data();
      in.acceleration_factor = rates.acceleration_factor;
      in.velocity_rate = rates.interface.rate();
      in.strain_lag = rates.strain_lag;
      if (!rates.wall_reference.empty()) in.velocity_reference = rates.wall_reference.data();
      if (!rates.branches_reference.empty()) in.branch_reference = rates.branches_reference.data();
    }
    return in;
  }

  /// Writes the prescribed values.
  void impose_conditions(Solution& solution) const {
    if (fluid) velocity_conditions.template impose<Mixed>(solution.fluid);
    if (coupled()) mesh_conditions.template impose<Vector>(solution.mesh);
    if (wall) wall_conditions.template impose<Mixed>(solution.wall);
  }

  /// Whether no opening leaves the flow free: it is given at each of them, or there is none. Then the level of the
  /// pressure is determined by a moving wall alone. False without fluid.
  bool has_flow_only() const {
    if (!fluid) return false;
    std::size_t open = 0;
    for (const auto& boundary : fluid->open_boundaries()) open += !boundary.empty();
    return open == inflows.size() + openings.driven().size();
  }

  /// Writes the velocities of the openings whose flow is given to state.now: so that the stage ends with that flow.
  void impose_inflows(State& state, const StepData& data) const {
    for (const auto& inflow : inflows) inflow.impose(state.before[0].fluid, data, state.now.fluid);
  }

  /// Sets what openings keep at a balance from the flow there.
  void settle_openings(Solution& balance, const StepRates& rates) const {
    if (fluid) openings.settle(fluid_input(balance, rates), rates.time, rates.openings_reference, balance.openings);
  }
  /// Sets what Maxwell branches of the wall keep at a balance from the displacement there.
  void settle_branches(Solution& balance, const StepRates& rates) const {
    if (!balance.branches.empty()) wall->settle_branches(wall_input(balance, rates), balance.branches);
  }

  /// Imposes d_m = d_s and the velocity that belongs to it on the interface of state.now.
  void impose_interface(State& state, const StepRates& rates) const {
    for (const auto& node : interface)
      for (int k = 0; k < n; ++k) {
        const std::size_t w = Mixed::vector(node.wall, k);
        state.now.mesh[Vector::vector(node.fluid, k)] = state.now.wall[w];
        state.now.fluid[Mixed::vector(node.fluid, k)] =
            rates.interface.velocity(state.now.wall[w], rates.wall_reference[w]);
      }
  }
};

}  // namespace fsi
