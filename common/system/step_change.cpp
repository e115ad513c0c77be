#include "system/step_change.hpp"

#include <algorithm>
#include <cmath>

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

constexpr double smallest_change = 0.01;  // of a field: changes below count as large as this

}  // namespace

template <int n>
double relative_to_step(const State& state, const StepData& data, const FieldDifference& fluid,
                        const FieldDifference& wall, const Communicator& processes) {
  constexpr int entries = MixedLayout<n>::entries;
  // Where values alternate from step to step, two steps show what changes beside that.
  const bool two = data.rates.stage == 0 && state.balances_since_jump > 1;
  const Solution& before = two ? state.balances[1] : data.rates.stage > 0 ? state.stage_balance : state.last_balance();
  std::vector<double> sums;  // of each field of vectors and of scalars: squares of difference, change and size
  const auto measure = [&](const FieldDifference& medium, const std::vector<double>& now,
                           const std::vector<double>& old) {
    double difference[2] = {}, change[2] = {}, size[2] = {};
    for (std::size_t i = 0, a = 0; i < medium.difference.size(); ++a)
      for (int entry = 0; entry < entries; ++entry, ++i) {
        const double volume = medium.volumes[a];
        difference[entry == n] += volume * medium.difference[i] * medium.difference[i];
        change[entry == n] += volume * (now[i] - old[i]) * (now[i] - old[i]);
        size[entry == n] += volume * now[i] * now[i];
      }
    for (const int kind : {0, 1}) sums.insert(sums.end(), {difference[kind], change[kind], size[kind]});
  };
  measure(fluid, state.now.fluid, before.fluid);
  measure(wall, state.now.wall, before.wall);
  processes.sum(sums);
  double largest = 0;
  for (std::size_t i = 0; i < sums.size(); i += 3) {
    const double difference = sums[i], change = sums[i + 1], size = sums[i + 2];
    const double steps = two ? 4 : 1;  // squared
    const double worth = std::max(std::min(change / steps, size), smallest_change * smallest_change * size);
    if (difference > 0) largest = std::max(largest, difference / worth);
  }
  return std::sqrt(largest);
}

template <int n>
bool stays(const Wall<n>& wall, const std::vector<double>& before, const std::vector<double>& after) {
  constexpr double rounding = 1e-9;
  const std::vector<double> volumes = owned_volumes<n>(wall.space(), wall.nodes());
  double sums[2] = {};  // of squares of the way, and of volumes
  for (int a = 0; a < wall.node_count(); ++a) {
    for (int k = 0; k < n; ++k) {
      const double way = after[MixedLayout<n>::vector(a, k)] - before[MixedLayout<n>::vector(a, k)];
      sums[0] += volumes[a] * way * way;
    }
    sums[1] += volumes[a];
  }
  wall.nodes().processes().sum(sums, 2);
  return std::sqrt(sums[0] / sums[1]) <= rounding * std::cbrt(sums[1]);
}

template <int n>
double relative_distance(const Wall<n>& wall, const std::vector<double>& before, const std::vector<double>& one,
                         const std::vector<double>& other) {
  const std::vector<double> volumes = owned_volumes<n>(wall.space(), wall.nodes());
  double sums[2] = {};  // squared, of the difference and of the change
  for (int a = 0; a < wall.node_count(); ++a)
    for (int k = 0; k < n; ++k) {
      const std::size_t i = MixedLayout<n>::vector(a, k);
      sums[0] += volumes[a] * (one[i] - other[i]) * (one[i] - other[i]);
      sums[1] += volumes[a] * (other[i] - before[i]) * (other[i] - before[i]);
    }
  wall.nodes().processes().sum(sums, 2);
  return sums[0] == 0 ? 0 : std::sqrt(sums[0] / sums[1]);
}

template <int n>
std::vector<double> owned_volumes(const FunctionSpace<n>& space, const PartNodes& part) {
  std::vector<double> volumes = space.volumes();
  for (int a = 0; part.share && a < part.node_count(); ++a)
    if (!part.owns(a)) volumes[a] = 0;
  return volumes;
}

#define FSI_INSTANTIATE(n)                                                                                           \
  template double relative_to_step<n>(const State&, const StepData&, const FieldDifference&, const FieldDifference&, \
                                      const Communicator&);                                                          \
  template double relative_distance<n>(const Wall<n>&, const std::vector<double>&, const std::vector<double>&,       \
                                       const std::vector<double>&);                                                  \
  template bool stays<n>(const Wall<n>&, const std::vector<double>&, const std::vector<double>&);                    \
  template std::vector<double> owned_volumes<n>(const FunctionSpace<n>&, const PartNodes&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
