#include "openings/lumped_start.hpp"

#include <cstddef>
#include <stdexcept>

#include "linear/direct/dense_inverse.hpp"

namespace fsi {

namespace {

using Kept = std::vector<std::vector<double>>;

/// The pressure in the vessel, kPa: the one that is given, or with which the laws let out what flows in. A law without
/// resistance sets it.
double pressure_in(const LumpedVessel& vessel, const Kept& kept, double k, double time) {
  if (vessel.pressure) return vessel.pressure(time);
  double flow = vessel.inflow(time), conductance = 0;
  for (std::size_t a = 0; a < kept.size(); ++a) {
    const double slope = vessel.laws[a]->slope(k), at_rest = vessel.laws[a]->pressure(k, kept[a].data(), 0);
    if (slope == 0) return at_rest;
    flow += at_rest / slope;
    conductance += 1 / slope;
  }
  return flow / conductance;
}

/// What the laws keep a period later.
Kept marched(const LumpedVessel& vessel, Kept kept, int steps) {
  const double step = vessel.period / steps, k = 2 / step;  // the balance is in the middle of a step
  for (int i = 0; i < steps; ++i) {
    const double pressure = pressure_in(vessel, kept, k, (i + 0.5) * step);
    for (std::size_t a = 0; a < kept.size(); ++a) {
      if (kept[a].empty()) continue;
      const OpeningLaw& law = *vessel.laws[a];
      const double flow = (pressure - law.pressure(k, kept[a].data(), 0)) / law.slope(k);
      const std::vector<double> middle = law.kept(k, kept[a].data(), flow);
      for (std::size_t j = 0; j < middle.size(); ++j) kept[a][j] = 2 * middle[j] - kept[a][j];
    }
  }
  return kept;
}

std::vector<double> flat(const Kept& kept) {
  std::vector<double> values;
  for (const auto& own : kept) values.insert(values.end(), own.begin(), own.end());
  return values;
}

}  // namespace

std::vector<std::vector<double>> periodic_start(const LumpedVessel& vessel, int steps) {
  if (vessel.laws.empty() && !vessel.pressure) throw std::runtime_error("nothing lets out what flows in");
  Kept zero;
  for (const auto& law : vessel.laws) zero.emplace_back(law->start().size(), 0.0);
  const std::vector<double> offset = flat(marched(vessel, zero, steps));
  const std::size_t count = offset.size();
  std::vector<double> change(count * count, 0.0);  // by columns: of what the march starts from, less what is left of it
  std::size_t column = 0;
  for (auto& own : zero)
    for (double& number : own) {
      number = 1;
      const std::vector<double> later = flat(marched(vessel, zero, steps));
      number = 0;
      for (std::size_t i = 0; i < count; ++i) change[column * count + i] = offset[i] - later[i] + (i == column ? 1 : 0);
      ++column;
    }
  const std::vector<double> inverse = dense_inverse(change, static_cast<int>(count));
  if (inverse.empty() && count > 0) throw std::runtime_error("the openings have no periodic state");
  std::size_t row = 0;
  for (auto& own : zero)
    for (double& number : own) {
      for (std::size_t j = 0; j < count; ++j) number += inverse[j * count + row] * offset[j];
      ++row;
    }
  return zero;
}

}  // namespace fsi
