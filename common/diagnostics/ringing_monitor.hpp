#pragma once

#include <optional>
#include <vector>

namespace fsi {

/// Notices pressures that alternate from step to step, a sawtooth that time schemes leave which do not damp what their
/// steps cannot resolve. With the deviation of each pressure from the line through its neighbours in time,
///   a^n = p^(n-1) - (p^(n-2) + p^n) / 2,
/// a sawtooth has <a^n, a^(n-1)> close to -|a^n| |a^(n-1)|, where what is smooth has a positive product. It is reported
/// when it alternates over eight steps and a quarter of the scene's time at least, keeps 3/4 of its size, and its
/// amplitude |a| / 2 is more than a tenth of the pressure.
class RingingMonitor {
 public:
  static constexpr int fewest_steps = 8;
  static constexpr double least_share = 0.1;  ///< of the pressure

  /// \param scene_time  ms, in which the scene swings
  explicit RingingMonitor(double scene_time) : scene_time_(scene_time) {}

  /// \param time       ms, at which the pressures balance
  /// \param pressures  kPa, of all places that count alike
  /// \returns the amplitude in kPa, the largest over the places, while there is such a sawtooth
  std::optional<double> look(double time, const std::vector<double>& pressures);
  /// Begins anew, as after a jump of the load.
  void restart();

 private:
  double scene_time_;
  std::vector<std::vector<double>> pressures_;  ///< the last ones, the latest last
  std::vector<double> times_;
  std::vector<double> deviation_;  ///< a of the last step
  int alternating_ = 0;            ///< steps in a row
  double since_ = 0;               ///< ms, of the first of them
  double first_ = 0;               ///< |a| there
};

}  // namespace fsi
