#include "case/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

namespace fsi {

namespace {

/// To twelve digits, as the ends of steps are.
double rounded(double time) {
  return std::strtod(fmt::format("{:.12g}", time).c_str(), nullptr);
}

/// Both ascending; of `further` only what is farther than `same` from all of `times`.
std::vector<double> merged_times(std::vector<double> times, const std::vector<double>& further, double same) {
  const auto given = static_cast<std::ptrdiff_t>(times.size());
  for (const double time : further) {
    const auto next = std::lower_bound(times.begin(), times.begin() + given, time - same);
    if (next == times.begin() + given || *next > time + same) times.push_back(time);
  }
  std::inplace_merge(times.begin(), times.begin() + given, times.end());
  return times;
}

}  // namespace

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

std::vector<double> further_output_times(const Case& setup) {
  if (!setup.time || !setup.time->periodic_change) return setup.output.times;
  const double period = *setup.time->period, end = setup.time->end, same = 1e-9 * end;
  std::vector<double> ends;
  for (int k = 1; k * period < end - same; ++k) ends.push_back(rounded(k * period));
  return merged_times(setup.output.times, ends, same);
}

std::vector<double> output_times(const Case& setup) {
  std::vector<double> times;
  if (!setup.time) return times;
  const double end = setup.time->end;
  const bool of_its_own = setup.time->adaptive && setup.output.every > 0 && !setup.output.fields.empty();
  if (!setup.output.interval && !of_its_own) return times;
  const double interval = setup.output.interval.value_or(end / 12);
  const int count = static_cast<int>(std::ceil(end / interval - 1e-9));
  for (int k = 0; k < count; ++k) times.push_back(rounded(k * interval));
  times.push_back(end);
  return merged_times(std::move(times), further_output_times(setup), 1e-9 * end);
}

}  // namespace fsi
