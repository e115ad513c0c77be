#include "openings/lumped_start.hpp"

#include <Eigen/LU>
#include <cstddef>
#include <stdexcept>

namespace fsi {

namespace {

using Kept = std::vector<std::vector<double>>;

/// What the laws keep a period later.
Kept marched(const LumpedVessel& vessel, Kept kept, int steps) {
  const double step = vessel.period / steps, k = 2 / step;  // the balance is in the middle of a step
  for (int i = 0; i < steps; ++i) {
    const double time = (i + 0.5) * step;
    double pressure = 0;
    if (vessel.pressure) {
      pressure = vessel.pressure(time);
    } else {
      double flow = vessel.inflow(time), conductance = 0;
      for (std::size_t a = 0; a < kept.size(); ++a) {
        const double slope = vessel.laws[a]->slope(k);
        flow += vessel.laws[a]->pressure(k, kept[a].data(), 0) / slope;
        conductance += 1 / slope;
      }
      pressure = flow / conductance;
    }
    for (std::size_t a = 0; a < kept.size(); ++a) {
      const OpeningLaw& law = *vessel.laws[a];
      const double flow = (pressure - law.pressure(k, kept[a].data(), 0)) / law.slope(k);
      const std::vector<double> middle = law.kept(k, kept[a].data(), flow);
      for (std::size_t j = 0; j < middle.size(); ++j) kept[a][j] = 2 * middle[j] - kept[a][j];
    }
  }
  return kept;
}

Eigen::VectorXd flat(const Kept& kept) {
  std::vector<double> values;
  for (const auto& own : kept) values.insert(values.end(), own.begin(), own.end());
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

std::vector<std::vector<double>> periodic_start(const LumpedVessel& vessel, int steps) {
  if (vessel.laws.empty() && !vessel.pressure) throw std::runtime_error("nothing lets out what flows in");
  Kept zero;
  for (const auto& law : vessel.laws) zero.emplace_back(law->start().size(), 0.0);
  const Eigen::VectorXd offset = flat(marched(vessel, zero, steps));
  const Eigen::Index count = offset.size();
  if (count == 0) return zero;
  Eigen::MatrixXd change = Eigen::MatrixXd::Identity(count, count);  // of the start, less what is left of it
  Eigen::Index column = 0;
  for (std::size_t a = 0; a < zero.size(); ++a)
    for (double& number : zero[a]) {
      number = 1;
      change.col(column++) -= flat(marched(vessel, zero, steps)) - offset;
      number = 0;
    }
  const Eigen::VectorXd found = change.partialPivLu().solve(offset);
  Eigen::Index next = 0;
  for (auto& own : zero)
    for (double& number : own) number = found[next++];
  return zero;
}

}  // namespace fsi
