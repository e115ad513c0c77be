#include "case/pressure_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fsi {

namespace {

/// Integral of the line through (t0, p0), (t1, p1) over the part of [from, to] inside [t0, t1].
double integral_of_segment(double t0, double p0, double t1, double p1, double from, double to) {
  const double a = std::max(t0, from), b = std::min(t1, to);
  if (b <= a) return 0.0;
  const auto value = [&](double t) { return p0 + (p1 - p0) * (t - t0) / (t1 - t0); };
  return 0.5 * (value(a) + value(b)) * (b - a);
}

constexpr double rounding = 1e-12;  // of a period: times this close to its end are its end

}  // namespace

double PressureTable::integral(double from, double to) const {
  double integral = points.front().second * std::max(0.0, std::min(to, points.front().first) - from) +
                    points.back().second * std::max(0.0, to - std::max(from, points.back().first));
  // Only the segments that the step lies in: a table may have many. The others would add zeros.
  const auto behind = std::upper_bound(points.begin(), points.end(), from,
                                       [](double time, const auto& point) { return time < point.first; });
  for (std::size_t i = behind == points.begin() ? 0 : static_cast<std::size_t>(behind - points.begin()) - 1;
       i + 1 < points.size() && points[i].first < to; ++i)
    if (points[i + 1].first > points[i].first)
      integral +=
          integral_of_segment(points[i].first, points[i].second, points[i + 1].first, points[i + 1].second, from, to);
  return integral;
}

double PressureTable::mean(double from, double to) const {
  if (points.empty() || to <= from) return 0.0;
  if (period <= 0) return integral(from, to) / (to - from);
  // Times are measured from the start of their period, and whole periods in between are counted.
  double first = std::floor(from / period), last = std::floor(to / period);
  double begin = from - first * period, end = to - last * period;
  if (period - begin <= rounding * period) begin = 0, ++first;
  if (end <= rounding * period && last > first) end = period, --last;
  if (first >= last) return integral(begin, end) / (end - begin);
  const double whole = last - first - 1;
  const double sum = integral(begin, period) + integral(0, end) + (whole > 0 ? whole * integral(0, period) : 0);
  return sum / (to - from);
}

double PressureTable::at(double time) const {
  if (points.empty()) return 0;
  if (period > 0) {
    time -= std::floor(time / period) * period;
    if (time <= rounding * period) time = period;  // the end of the period before
  }
  const auto behind =
      std::lower_bound(points.begin(), points.end(), time, [](const auto& point, double t) { return point.first < t; });
  if (behind == points.begin()) return points.front().second;
  if (behind == points.end()) return points.back().second;
  const auto& [t0, p0] = *(behind - 1);
  const auto& [t1, p1] = *behind;
  return p0 + (p1 - p0) * (time - t0) / (t1 - t0);
}

std::vector<double> PressureTable::jumps_of_points() const {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (points[i].first == points[i + 1].first && points[i].second != points[i + 1].second)
      times.push_back(points[i].first);
  return times;
}

std::vector<double> PressureTable::jumps(double until) const {
  std::vector<double> within = jumps_of_points();
  if (period <= 0) return within;
  // At the ends of a period what counts is where it ends and begins.
  within.erase(std::remove_if(within.begin(), within.end(), [&](double t) { return t <= 0 || t >= period; }),
               within.end());
  if (jumps_in_period() > within.size()) within.push_back(period);
  std::vector<double> times;
  if (within.empty() || !std::isfinite(until)) return within;
  for (double start = 0, k = 0; start < until; start = ++k * period)
    for (const double time : within)
      if (start + time <= until) times.push_back(start + time);
  return times;
}

std::size_t PressureTable::jumps_in_period() const {
  std::size_t inside = 0;
  for (const double time : jumps_of_points()) inside += time > 0 && time < period;
  double first = points.empty() ? 0 : points.front().second, last = at_end();
  for (const auto& [time, value] : points)
    if (time <= 0) first = value;
  for (auto point = points.rbegin(); point != points.rend() && point->first >= period; ++point) last = point->second;
  return inside + (first != last ? 1 : 0);
}

}  // namespace fsi
