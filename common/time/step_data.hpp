#pragma once

#include <vector>

#include "time/interface_kinematics.hpp"

namespace fsi {

/// How a time integrator makes rates of the unknowns of one step. Factors belong to the unknowns, references and
/// histories are known. Layouts as in Solution, acceleration_history n numbers per wall node; empty in statics.
struct StepRates {
  double step = 0;                 ///< ms; 0 in statics
  InterfaceKinematics interface;   ///< velocities of the mesh, and of the fluid on the interface, from displacements
  double fluid_factor = 0;         ///< 1/ms: du/dt = fluid_factor (u - fluid_reference)
  double acceleration_factor = 0;  ///< 1/ms^2: wall's acceleration = acceleration_factor d + acceleration_history
  std::vector<double> mesh_reference, fluid_reference, wall_reference;
  std::vector<double> acceleration_history;  ///< mm/ms^2

  bool is_static() const { return step == 0; }
};

/// What is known of the step in progress.
struct StepData {
  double time = 0;  ///< ms, at its end; load fraction in statics
  StepRates rates;
  std::vector<double> opening_pressures;  ///< kPa, mean over the step, of the scene's open boundaries in their order
  double wall_pressure = 0;               ///< kPa, on the inner face of a wall without fluid
  std::vector<double> interface_load;     ///< added to the wall's residual, as Solution::wall; empty: none
};

}  // namespace fsi
