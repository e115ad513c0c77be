#pragma once

#include <vector>

#include "time/interface_kinematics.hpp"
#include "time/state.hpp"

namespace fsi {

/// A share of a load: `weight` times its mean over [from, to] in ms.
struct LoadShare {
  double from = 0, to = 0, weight = 1;
};

/// How a time integrator makes rates of the unknowns of one step, or of one stage of it: factors of the unknowns, and
/// known references and histories. Layouts as in Solution, acceleration_history n numbers per wall node; empty in
/// statics.
struct StepRates {
  double step = 0;                 ///< ms, of the whole step; 0 in statics
  InterfaceKinematics interface;   ///< velocities of the mesh, and of the fluid on the interface, from displacements
  double fluid_factor = 0;         ///< 1/ms: du/dt = fluid_factor (u - fluid_reference)
  double acceleration_factor = 0;  ///< 1/ms^2: wall's acceleration = acceleration_factor d + acceleration_history
  std::vector<double> mesh_reference, fluid_reference, wall_reference;
  std::vector<double> openings_reference{};  ///< of what openings keep: dy/dt = fluid_factor (y - reference)
  std::vector<double> branches_reference{};  ///< of what Maxwell branches keep, with the rate of the wall
  std::vector<double> acceleration_history;  ///< mm/ms^2
  /// ms, from the middle of the interval whose difference is the balance's velocity to the balance: in that middle F^T
  /// grad v is the rate of a strain, and zero for a rigid rotation (docs/theory.md, section 5.10).
  double strain_lag = 0;

  int stage = 0;               ///< from 0
  bool last_stage = true;      ///< its end is the step's
  double time = 0;             ///< ms, at which the equations hold: the balance's
  double start = 0;            ///< ms, of the stage
  double end = 0;              ///< ms, of the stage
  double carry = 1;            ///< theta: values at the stage's end are y_0 + (y - y_0) / theta, but for pressures
  double weight = 1;           ///< of this balance in the step's change of momentum; they add up to one
  double previous_weight = 0;  ///< likewise of the last balance of the step before
  /// The balance's load: the shares, and `load_rate_weight` times State::load_rates. So the impulse of any table is
  /// conserved exactly.
  std::vector<LoadShare> load;
  double load_rate_weight = 0;

  bool is_static() const { return step == 0; }
};

/// What is known of the step, or stage, in progress.
struct StepData {
  double time = 0;  ///< ms, at the step's end; load fraction in statics
  StepRates rates;
  std::vector<double> opening_pressures;  ///< kPa, of the balance, of the scene's open boundaries in their order
  /// Into the fluid at the stage's end, mm^3/ms, of the same boundaries; 0 where no flow is prescribed. Empty: nowhere.
  std::vector<double> opening_flows{};
  double wall_pressure = 0;            ///< kPa, on the inner face of a wall without fluid
  std::vector<double> support_loads;   ///< kPa, of the wall's supports, in the order of support_loads_of(case)
  std::vector<double> interface_load;  ///< added to the wall's residual, as Solution::wall; empty: none
  bool ends_at_jump = false;           ///< the load jumps at the step's end
};

/// A balance of a finished step: the solution, and the data of its equations.
struct Balance {
  Solution at;
  StepData data;
};

}  // namespace fsi
