#pragma once

#include <array>
#include <utility>
#include <vector>

namespace fsi {

/// Nodal values of one time level, the paper's X = (D_m, U_f, U_s), in the layouts of fem/nodal_layout.hpp. Arrays of
/// absent physics are empty.
struct Solution {
  std::vector<double> mesh;   ///< d_m, vectors per fluid node, mm
  std::vector<double> fluid;  ///< (u, p_f), vectors and scalars per fluid node, mm/ms and kPa
  std::vector<double> wall;   ///< (d_s, p_s), vectors and scalars per wall node, mm and kPa
};

/// Everything a time step starts from and works on.
struct State {
  int step = 0;                           ///< last finished step
  double time = 0;                        ///< ms; load fraction in statics
  Solution now;                           ///< the iterate; between steps equal to before[0]
  std::array<Solution, 3> before;         ///< finished time levels, the latest first
  std::array<double, 3> times{};          ///< of these levels, as `time`
  std::vector<double> wall_velocity;      ///< vectors per wall node, mm/ms, at before[0]
  std::vector<double> wall_acceleration;  ///< mm/ms^2

  /// state.now becomes the latest finished level.
  void finish_step(double at_time) {
    std::swap(before[2], before[1]);
    std::swap(before[1], before[0]);
    before[0] = now;
    times = {at_time, times[0], times[1]};
    ++step;
    time = at_time;
  }
};

}  // namespace fsi
