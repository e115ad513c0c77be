#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "diagnostics/energy_record.hpp"
#include "mesh/group_names.hpp"
#include "scene/level_energy.hpp"
#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// Follows the energy of a scene from step to step (docs/energy.md). Reads states and balances only: it can change no
/// solution. What it keeps of the last step it can make again from a restored state, bit for bit.
///
/// Processes that share a scene call it together. Each sums over its own elements, facets and nodes, and the parts of a
/// record are added up here, once a step; sums that are global already go into the first process's part.
template <int n>
class EnergyBalance {
 public:
  /// \param state  the one that the next step starts from
  EnergyBalance(const Scene<n>& scene, const State& state) : scene_(scene), quadratic_(parts_of(scene).quadratic) {
    for (const auto& inflow : scene.inflows) given_.insert(given_.end(), inflow.nodes().begin(), inflow.nodes().end());
    keep(state);
    EnergyRecord record = energies(state, level_energy(scene, state));
    isochoric_ = record.wall_isochoric;
    sum_over(scene_.processes(), record);
    energy_ = record.energy();
  }

  /// Which parts of the balance a scene has.
  static EnergyParts parts_of(const Scene<n>& scene) {
    EnergyParts parts{scene.fluid != nullptr, scene.wall != nullptr, !scene.is_static(),
                      scene.processes().any(quadratic(scene)), scene.fluid && scene.fluid->stabilises_backflow()};
    if (const auto* supports = scene.wall ? scene.wall->supports() : nullptr) {
      parts.springs = supports->has_springs();
      parts.dampers = supports->has_dampers();
      parts.support_loads = supports->load_count() > 0;
    }
    parts.viscous_wall = scene.wall && scene.wall->is_viscous() && !scene.is_static();
    parts.branches = scene.wall && scene.wall->branch_places().entries > 0;
    return parts;
  }

  /// The balance of energy of the step that led to `state`, the successor of the last one seen.
  /// \param report  of the step, with its balances
  EnergyRecord step_to(const State& state, const StepReport& report) {
    const std::vector<Balance>& balances = report.balances;
    EnergyRecord record = energies(state, report.level);
    const StepRates& first = balances.front().data.rates;
    if (first.previous_weight != 0) add(state, again_.value(), first.previous_weight, first.step, nullptr, record);
    const std::vector<double>* wall_before = &wall_before_;
    for (const Balance& balance : balances) {
      const StepRates& rates = balance.data.rates;
      add(state, balance, rates.weight, rates.step, wall_before, record);
      wall_before = &balance.at.wall;
    }
    // Work of the stress beyond the change of energy: weights of balances add up to one.
    if (scene_.wall) record.wall_stress -= record.wall_isochoric - std::exchange(isochoric_, record.wall_isochoric);
    sum_over(scene_.processes(), record);
    if (quadratic_) record.fluid_quadrature -= record.outlet_kinetic - record.inlet_kinetic;
    record.remainder =
        record.supply() - (record.energy() - energy_) - record.viscous - record.damping - record.numerical();
    record.remainder -= record.backflow;
    if (scene_.wall && scene_.wall->is_viscous()) record.remainder -= record.wall_viscous;
    energy_ = record.energy();
    keep(state);
    return record;
  }

 private:
  /// Whether there are nodes without pressure here: linear elements integrate convection exactly, also where they move.
  static bool quadratic(const Scene<n>& scene) {
    for (int a = 0; scene.fluid && a < scene.fluid->node_count(); ++a)
      if (!scene.fluid->space().carries_scalar(a)) return true;
    return false;
  }

  /// What the next step will need of the state that it starts from.
  void keep(const State& state) {
    wall_before_ = state.last_balance().wall;
    wall_velocity_ = state.wall_velocity;
    again_ = scene_.integrator->balance_again(state);
  }

  /// Energies of the last level: this process's part.
  EnergyRecord energies(const State& state, const LevelEnergy& level) const {
    EnergyRecord record;
    record.fluid_kinetic = level.fluid_kinetic;
    record.wall_kinetic = level.wall_kinetic;
    record.wall_isochoric = level.wall_isochoric;
    record.wall_volumetric = level.wall_volumetric;
    record.wall_branches = level.wall_branches;
    if (const auto* supports = scene_.wall ? scene_.wall->supports() : nullptr)
      record.springs = supports->stored(state.before[0].wall);
    return record;
  }

  /// Adds what a balance of the step to `state` does.
  /// \param step         ms, of the step; 0 in statics
  /// \param wall_before  the wall at the balance before; null for a balance that counts a second time
  void add(const State& state, const Balance& balance, double weight, double step,
           const std::vector<double>* wall_before, EnergyRecord& record) const {
    if (scene_.fluid) add_fluid(state, balance, weight, step, record);
    if (scene_.wall) add_wall(state, balance, weight, step, wall_before, record);
  }

  void add_fluid(const State& state, const Balance& balance, double weight, double step, EnergyRecord& record) const {
    const StepRates& rates = balance.data.rates;
    const Solution &start = state.before[1], &end = state.before[0];
    FluidStep in;
    in.balance = scene_.fluid->projected(scene_.fluid_input(balance.at, rates));
    in.weight = weight;
    in.duration = weight * step;
    in.fluid_start = start.fluid.data();
    in.fluid_end = end.fluid.data();
    if (scene_.coupled()) {
      in.mesh_start = start.mesh.data();
      in.mesh_end = end.mesh.data();
    }
    const FluidWork work = scene_.fluid->work(in);
    record.fluid_kinetic = work.kinetic_end;
    record.viscous += work.viscous;
    record.backflow += work.backflow;
    record.fluid_inertia += work.inertia;
    record.fluid_mesh_motion += work.mesh_motion;
    record.fluid_divergence += work.divergence;
    record.fluid_stabilisation += work.stabilisation;
    if (quadratic_) record.fluid_quadrature += work.convection;
    // Integrals over openings are those of all processes.
    const double share = scene_.processes().is_first() ? in.duration : 0;
    const auto& open = scene_.fluid->open_boundaries();
    const std::vector<double> pressures = scene_.opening_pressures(balance.at, balance.data);
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double kinetic = share * scene_.fluid->kinetic_outflow(open[i], in.balance, balance.at.fluid);
      if (open[i].name() == group::inlet)
        record.inlet_kinetic -= kinetic;
      else
        record.outlet_kinetic += kinetic;
      const double pressure = i < pressures.size() ? pressures[i] : 0;
      if (pressure != 0) record.inlet_work -= share * pressure * open[i].outflow(balance.at.mesh, balance.at.fluid);
    }
    if (!scene_.inflows.empty())
      record.inlet_work += in.duration * scene_.fluid->power_at(given_, in.balance, pressures);
  }

  void add_wall(const State& state, const Balance& balance, double weight, double step,
                const std::vector<double>* wall_before, EnergyRecord& record) const {
    const StepRates& rates = balance.data.rates;
    const Solution &start = state.before[1], &end = state.before[0];
    // In statics the displacement of the step stands for a velocity.
    const std::vector<double>& reference = rates.is_static() ? start.wall : rates.wall_reference;
    WallStep in;
    in.balance = scene_.wall_input(balance.at, balance.data);
    in.reference = reference.data();
    in.weight = weight;
    in.start = start.wall.data();
    in.end = end.wall.data();
    if (!rates.is_static()) {
      in.rate = rates.interface.rate();
      in.duration = weight * step;
      in.velocity_start = wall_velocity_.data();
      in.velocity_end = state.wall_velocity.data();
    }
    if (wall_before) in.wall_before = wall_before->data();
    if (!balance.at.branches.empty()) {
      in.branches = balance.at.branches.data();
      in.branches_start = start.branches.data();
      in.branches_end = end.branches.data();
    }
    const WallWork work = scene_.wall->work(in);
    record.wall_inertia += work.inertia;
    record.wall_stress += work.stress;
    record.wall_stabilisation += work.stabilisation;
    record.wall_viscous += work.viscous;
    if (const auto* supports = scene_.wall->supports()) {
      const SupportWork of_supports = supports->work(in);
      record.support_work += of_supports.loads;
      record.damping += of_supports.damping;
      record.support_springs += of_supports.springs;
    }
    record.load_work +=
        in.duration * in.rate * scene_.wall->pressure_work(balance.data.wall_pressure, reference, balance.at.wall);
  }

  const Scene<n>& scene_;
  bool quadratic_;
  std::vector<int> given_;             ///< nodes of the openings whose flow is given
  double energy_ = 0;                  ///< at the last step's end
  double isochoric_ = 0;               ///< of this process's part of the wall, likewise
  std::vector<double> wall_before_;    ///< at the last balance
  std::vector<double> wall_velocity_;  ///< at the last step's end
  std::optional<Balance> again_;       ///< the last balance, if the next step counts it again
};

}  // namespace fsi
