#pragma once

#include <array>
#include <cstring>
#include <type_traits>

#include "parallel/communicator.hpp"

namespace fsi {

/// Energy balance of one step: a row of energy.csv (docs/energy.md). Everything in uJ = mm^3 kPa. Energies are those at
/// the step's end, the rest is of the step alone. Each is evaluated on its own but `remainder`, the rest.
struct EnergyRecord {
  double fluid_kinetic = 0, wall_kinetic = 0;
  double wall_isochoric = 0, wall_volumetric = 0;  ///< elastic energy of the wall

  double springs = 0;        ///< stored in the springs of the wall's supports
  double wall_branches = 0;  ///< in those of the Maxwell branches of its layers

  double inlet_work = 0;                         ///< of the pressures at all openings on the fluid, and of given flows
  double load_work = 0;                          ///< of the pressure on a wall without fluid
  double support_work = 0;                       ///< of pressure and traction of the wall's supports
  double damping = 0;                            ///< dissipation in their dampers
  double inlet_kinetic = 0, outlet_kinetic = 0;  ///< kinetic energy that flows in, and out
  double viscous = 0;                            ///< dissipation in the fluid
  double wall_viscous = 0;                       ///< in the wall's layers
  double backflow = 0;                           ///< taken by the stabilisation of backflow at openings

  // Numerical dissipation by origin; negative where the discretisation adds energy.
  double fluid_inertia = 0, fluid_mesh_motion = 0, fluid_divergence = 0, fluid_stabilisation = 0;
  double fluid_quadrature = 0;
  double wall_inertia = 0, wall_stress = 0, wall_stabilisation = 0;
  double support_springs = 0;  ///< their forces are those of the balance, not along the step

  double remainder = 0;  ///< supply() - change of energy() - viscous - wall_viscous - damping - backflow - numerical()

  double energy() const {
    return fluid_kinetic + wall_kinetic + wall_isochoric + wall_volumetric + springs + wall_branches;
  }
  double supply() const { return inlet_work + load_work + support_work + inlet_kinetic - outlet_kinetic; }
  double numerical() const {
    return fluid_inertia + fluid_mesh_motion + fluid_divergence + fluid_stabilisation + fluid_quadrature +
           wall_inertia + wall_stress + wall_stabilisation + support_springs;
  }
};

/// Sums the processes' parts of a record, each number by itself, all in one message.
inline void sum_over(const Communicator& processes, EnergyRecord& record) {
  if (processes.is_alone()) return;
  static_assert(std::is_trivially_copyable_v<EnergyRecord> && sizeof(EnergyRecord) % sizeof(double) == 0,
                "nothing but numbers");
  std::array<double, sizeof(EnergyRecord) / sizeof(double)> numbers;
  std::memcpy(numbers.data(), &record, sizeof record);
  processes.sum(numbers.data(), numbers.size());
  std::memcpy(static_cast<void*>(&record), numbers.data(), sizeof record);
}

/// Which parts of the balance a scene has.
struct EnergyParts {
  bool fluid = false, wall = false;
  bool in_time = true;     ///< not static
  bool quadratic = false;  ///< elements whose rule does not integrate convection exactly
  bool backflow = false;   ///< openings with stabilisation of backflow
  bool springs = false, dampers = false, support_loads = false;  ///< of the wall's supports
  bool viscous_wall = false, branches = false;
};

}  // namespace fsi
