#include "case/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace fsi {

namespace {

/// Integral of the line through (t0, p0), (t1, p1) over the part of [from, to] inside [t0, t1].
double integral_of_segment(double t0, double p0, double t1, double p1, double from, double to) {
  const double a = std::max(t0, from), b = std::min(t1, to);
  if (b <= a) return 0.0;
  const auto value = [&](double t) { return p0 + (p1 - p0) * (t - t0) / (t1 - t0); };
  return 0.5 * (value(a) + value(b)) * (b - a);
}

}  // namespace

double PressureTable::mean(double from, double to) const {
  if (points.empty() || to <= from) return 0.0;
  double integral = points.front().second * std::max(0.0, std::min(to, points.front().first) - from) +
                    points.back().second * std::max(0.0, to - std::max(from, points.back().first));
  // A step needs the segments that it lies in, of however many. The others would add zeros.
  const auto behind = std::upper_bound(points.begin(), points.end(), from,
                                       [](double time, const auto& point) { return time < point.first; });
  integral += 0.0;
  for (std::size_t i = behind == points.begin() ? 0 : static_cast<std::size_t>(behind - points.begin()) - 1;
       i + 1 < points.size() && points[i].first < to; ++i)
    if (points[i + 1].first > points[i].first)
      integral +=
          integral_of_segment(points[i].first, points[i].second, points[i + 1].first, points[i + 1].second, from, to);
  return integral / (to - from);
}

std::vector<double> PressureTable::jumps() const {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (points[i].first == points[i + 1].first && points[i].second != points[i + 1].second)
      times.push_back(points[i].first);
  return times;
}

double wall_stabilisation(const Case& setup) {
  assert(setup.structure);
  // A pressure that is continuous where layers meet leaks from one to the other, the more the larger alpha is.
  const bool leaks = setup.structure->layer_pressure == LayerPressure::continuous;
  const double standard = setup.stabilisation == Stabilisation::projected && leaks ? 0.05 : 0.5;
  return setup.structure->stabilisation.value_or(standard);
}

int TimeData::steps() const {
  return static_cast<int>(std::lround(std::ceil(end / step - 1e-9)));
}

std::vector<double> output_times(const Case& setup) {
  std::vector<double> times;
  if (!setup.time) return times;
  const double end = setup.time->end;
  const bool of_its_own = setup.time->adaptive && setup.output.every > 0 && !setup.output.fields.empty();
  if (!setup.output.interval && !of_its_own) return times;
  const double interval = setup.output.interval.value_or(end / 12);
  const int count = static_cast<int>(std::ceil(end / interval - 1e-9));
  // To twelve digits, as the ends of steps.
  for (int k = 0; k < count; ++k) times.push_back(std::strtod(fmt::format("{:.12g}", k * interval).c_str(), nullptr));
  times.push_back(end);
  return times;
}

}  // namespace fsi
