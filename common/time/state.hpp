#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace fsi {

/// Nodal values of one time level, the paper's X = (D_m, U_f, U_s), in the layouts of fem/nodal_layout.hpp. Arrays of
/// absent physics are empty.
struct Solution {
  std::vector<double> mesh;        ///< d_m, vectors per fluid node, mm
  std::vector<double> fluid;       ///< (u, p_f), vectors and scalars per fluid node, mm/ms and kPa
  std::vector<double> wall;        ///< (d_s, p_s), vectors and scalars per wall node, mm and kPa
  std::vector<double> openings{};  ///< what openings keep (openings/openings.hpp): its owner knows what stands where
  std::vector<double> branches{};  ///< what Maxwell branches of the wall keep (wall/wall_input.hpp, BranchPlaces)
};

/// Everything a time step starts from and works on.
struct State {
  int step = 0;                           ///< last finished step
  double time = 0;                        ///< ms; load fraction in statics
  Solution now;                           ///< the iterate; between steps equal to before[0]
  std::array<Solution, 3> before;         ///< finished time levels, the latest first
  std::array<double, 3> times{};          ///< of these levels, as `time`
  std::vector<double> wall_velocity;      ///< vectors per wall node, mm/ms, at before[0]
  std::vector<double> wall_acceleration;  ///< mm/ms^2; of schemes with balances at the last of them

  // What schemes with balances keep (time/balance.hpp). Empty for backward Euler and in statics.
  int since_jump = 0;                        ///< finished steps since the load last jumped
  int balances_since_jump = 0;               ///< of `balances` that belong to them
  std::array<Solution, 3> balances;          ///< solutions of the equations, the latest first
  std::array<double, 3> balance_times{};     ///< ms
  std::vector<double> wall_velocity_before;  ///< at before[1]
  Solution rate;                      ///< d/dt of displacements and velocities at before[0]; of two schemes alone:
                                      ///< generalised-alpha and tr-bdf2, as the next two
  std::vector<double> velocity_rate;  ///< of the wall's velocity, mm/ms^2
  std::vector<double> load_rates;     ///< the loads that belong to them, kPa: of openings, supports, the inner face

  std::size_t support_loads = 0;  ///< how many loads the wall's supports have
  bool has_branches = false;      ///< the wall has Maxwell branches; the same at all processes

  // A first stage of the step in progress, of schemes with two.
  Solution stage, stage_balance;         ///< the level at its end, the solution of its equations
  std::vector<double> stage_velocity;    ///< of the wall at its end, mm/ms
  double stage_end = 0, stage_time = 0;  ///< ms, of the level and of the balance

  /// state.now becomes the latest finished level.
  void finish_step(double at_time) {
    std::swap(before[2], before[1]);
    std::swap(before[1], before[0]);
    before[0] = now;
    times = {at_time, times[0], times[1]};
    ++step;
    time = at_time;
  }

  /// The solution of the equations last solved: where pressures balance.
  const Solution& last_balance() const { return has_balances() ? balances[0] : before[0]; }
  bool has_balances() const { return !balances[0].fluid.empty() || !balances[0].wall.empty(); }
};

}  // namespace fsi
