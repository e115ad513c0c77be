#pragma once

#include <array>
#include <vector>

namespace fsi {

/// Nodal values of one time level, the paper's X = (D_m, U_f, U_s). Arrays of absent physics are empty. With n
/// components of a vector:
struct Solution {
  std::vector<double> mesh;  ///< d_m, n numbers per fluid node, mm
  std::vector<double> flow;  ///< (u, p_f), n + 1 per fluid node, mm/ms and kPa
  std::vector<double> wall;  ///< (d_s, p_s), n + 1 per wall node, mm and kPa
};

/// Everything a time step starts from and works on.
struct State {
  int step = 0;                           ///< last finished step
  double time = 0;                        ///< ms; load fraction in statics
  Solution now;                           ///< the iterate; between steps equal to before[0]
  std::array<Solution, 3> before;         ///< finished time levels, the latest first
  std::vector<double> wall_velocity;      ///< n per wall node, mm/ms, at before[0]
  std::vector<double> wall_acceleration;  ///< mm/ms^2
};

/// What is known of the step in progress.
struct StepData {
  double time = 0;                           ///< ms, at its end
  double inlet_pressure = 0;                 ///< kPa, mean over the step
  double wall_pressure = 0;                  ///< kPa, on the inner face of a wall without fluid
  std::vector<double> acceleration_history;  ///< n per wall node, mm/ms^2; empty in statics
  std::vector<double> interface_load;        ///< added to the wall's residual, n + 1 per wall node; empty: none
};

}  // namespace fsi
