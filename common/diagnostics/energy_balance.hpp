#pragma once

#include <vector>

#include "diagnostics/energy_record.hpp"
#include "mesh/group_names.hpp"
#include "scene/scene.hpp"
#include "time/loads.hpp"

namespace fsi {

/// Follows the energy of a scene from step to step (docs/energy.md). Reads states only: it can change no solution. What
/// it keeps of the last step it can make again of a restored state, bit for bit.
template <int n>
class EnergyBalance {
 public:
  /// \param state  the one that the next step starts from
  EnergyBalance(const Scene<n>& scene, const Loads& loads, const State& state)
      : scene_(scene), loads_(loads), acceleration_(state.wall_acceleration) {
    energy_ = terms(state).energy();
    parts_ = {scene.fluid != nullptr, scene.wall != nullptr, !scene.is_static(), quadratic()};
  }

  const EnergyParts& parts() const { return parts_; }

  /// The balance of the step that led to `state`, the successor of the last one seen.
  EnergyRecord step_to(const State& state) {
    EnergyRecord record = terms(state);
    record.remainder = record.supply() - (record.energy() - energy_) - record.viscous - record.numerical();
    energy_ = record.energy();
    acceleration_ = state.wall_acceleration;
    return record;
  }

 private:
  /// Whether there are nodes without pressure. Linear elements integrate convection exactly, also where they move.
  bool quadratic() const {
    for (int a = 0; scene_.fluid && a < scene_.fluid->node_count(); ++a)
      if (!scene_.fluid->space().carries_scalar(a)) return true;
    return false;
  }

  // One function for every use, never inlined: on restart it must give the bits that the run would have had.
  [[gnu::noinline]] EnergyRecord terms(const State& state) const {
    const Solution &now = state.before[0], &old = state.before[1];
    EnergyRecord record;
    const double step = state.step > 0 ? loads_.step_length(state.step) : loads_.step_length(1);
    if (scene_.fluid) {
      const double rate = 1.0 / step;
      FluidInput in;
      in.step = step;
      in.fluid = now.fluid.data();
      in.fluid_reference = old.fluid.data();
      in.fluid_factor = rate;
      if (scene_.coupled()) {
        in.mesh = now.mesh.data();
        in.mesh_reference = old.mesh.data();
        in.mesh_factor = rate;
      }
      const FluidEnergy fluid = scene_.fluid->energy(in);
      record.fluid_kinetic = fluid.kinetic;
      record.viscous = fluid.viscous;
      record.fluid_inertia = fluid.inertia;
      record.fluid_mesh_motion = fluid.mesh_motion;
      record.fluid_divergence = fluid.divergence;
      record.fluid_stabilisation = fluid.stabilisation;
      const auto pressures = loads_.opening_pressures(state.step);
      const auto& open = scene_.fluid->open_boundaries();
      for (std::size_t i = 0; i < open.size(); ++i) {
        const double kinetic = step * scene_.fluid->kinetic_outflow(open[i], now.fluid);
        if (open[i].name() == group::inlet)
          record.inlet_kinetic -= kinetic;
        else
          record.outlet_kinetic += kinetic;
        if (i < pressures.size() && pressures[i] != 0)
          record.inlet_work -= step * pressures[i] * open[i].outflow(now.fluid);
      }
      if (quadratic()) record.fluid_quadrature = fluid.convection - (record.outlet_kinetic - record.inlet_kinetic);
    }
    if (scene_.wall) {
      WallStep in;
      in.wall = now.wall.data();
      in.wall_old = old.wall.data();
      if (!scene_.is_static()) {
        in.velocity = state.wall_velocity.data();
        in.acceleration = state.wall_acceleration.data();
        in.acceleration_old = acceleration_.data();
        in.step = step;
        in.beta = scene_.integrator->newmark().beta;
        in.gamma = scene_.integrator->newmark().gamma;
      }
      const WallEnergy wall = scene_.wall->energy(in);
      record.wall_kinetic = wall.kinetic;
      record.wall_isochoric = wall.isochoric;
      record.wall_volumetric = wall.volumetric;
      record.wall_inertia = wall.inertia;
      record.wall_stress = wall.stress;
      record.wall_stabilisation = wall.stabilisation;
      record.load_work = scene_.wall->pressure_work(loads_.wall_pressure(state.step), old.wall, now.wall);
    }
    return record;
  }

  const Scene<n>& scene_;
  const Loads& loads_;
  EnergyParts parts_;
  double energy_ = 0;                 ///< at the last step's end
  std::vector<double> acceleration_;  ///< of the wall at the last step's end
};

}  // namespace fsi
