#include "diagnostics/ringing_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace fsi {

namespace {

constexpr double opposite = -0.7;  // cosine of successive deviations
constexpr double fair_part = 0.25, lasting = 0.75;

double product(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

void RingingMonitor::restart() {
  pressures_.clear();
  times_.clear();
  deviation_.clear();
  alternating_ = 0;
}

std::optional<double> RingingMonitor::look(double time, const std::vector<double>& pressures) {
  pressures_.push_back(pressures);
  times_.push_back(time);
  if (pressures_.size() < 3) return {};
  const auto &p0 = pressures_[0], &p1 = pressures_[1], &p2 = pressures_[2];
  const double w = (times_[1] - times_[0]) / (times_[2] - times_[0]);
  std::vector<double> deviation(p1.size());
  double smooth = 0;  // the sawtooth is not in the mean of a value and the line through its neighbours
  for (std::size_t i = 0; i < p1.size(); ++i) {
    const double line = (1 - w) * p0[i] + w * p2[i];
    deviation[i] = p1[i] - line;
    smooth += 0.25 * (p1[i] + line) * (p1[i] + line);
  }
  smooth = std::sqrt(smooth);
  const double size = std::sqrt(product(deviation, deviation));
  const bool turns = !deviation_.empty() &&
                     product(deviation, deviation_) < opposite * size * std::sqrt(product(deviation_, deviation_));
  deviation_ = std::move(deviation);
  pressures_.erase(pressures_.begin());
  times_.erase(times_.begin());
  if (!turns || 0.5 * size <= least_share * smooth) {
    alternating_ = 0;
    return {};
  }
  if (alternating_++ == 0) {
    since_ = time;
    first_ = size;
  }
  const double lasted = time - since_;
  if (alternating_ < fewest_steps || lasted < fair_part * scene_time_) return {};
  if (size < lasting * first_) return {};
  double largest = 0;
  for (const double a : deviation_) largest = std::max(largest, 0.5 * std::abs(a));
  return largest;
}

}  // namespace fsi
