#include "time/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fem/nodal_layout.hpp"

namespace fsi {

namespace {

/// Weights of values at `times` in their divided difference of degree times.size() - 1.
template <std::size_t count>
std::array<double, count> divided_difference(const std::array<double, count>& times) {
  std::array<double, count> weights;
  for (std::size_t i = 0; i < count; ++i) {
    weights[i] = 1;
    for (std::size_t j = 0; j < count; ++j)
      if (j != i) weights[i] /= times[i] - times[j];
  }
  return weights;
}

constexpr double forgetting = 4;  // decay of the pressure's scale, in units of 1 / scene_time

double relative(double error, double scale) {
  return error > 0 ? error / scale : 0;
}

}  // namespace

double StepErrors::largest() const {
  return std::max({displacement, velocity, pressure});
}

std::string StepErrors::text() const {
  return fmt::format("displacement {:.1e}, velocity {:.1e}, pressure {:.1e}", displacement, velocity, pressure);
}

template <int n>
ErrorEstimate<n>::ErrorEstimate(std::vector<double> fluid_volumes, std::vector<double> wall_volumes,
                                const ErrorTerms& terms, double scene_time, const Communicator& processes)
    : fluid_volumes_(std::move(fluid_volumes)),
      wall_volumes_(std::move(wall_volumes)),
      terms_(terms),
      scene_time_(scene_time),
      processes_(&processes),
      has_fluid_(processes.any(!fluid_volumes_.empty())),
      has_wall_(processes.any(!wall_volumes_.empty())) {}

template <int n>
template <class Value>
double ErrorEstimate<n>::norm(const std::vector<double>& volumes, int entries, int first, int count,
                              Value value) const {
  double sums[2] = {0, 0};  // of squares, and of volumes
  for (std::size_t node = 0; node < volumes.size(); ++node) {
    sums[1] += volumes[node];
    for (int k = 0; k < count; ++k) {
      const double x = value(node * entries + first + k);
      sums[0] += volumes[node] * x * x;
    }
  }
  processes_->sum(sums, 2);
  return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
}

template <int n>
StepErrors ErrorEstimate<n>::of(const State& state, const StepData& data) {
  constexpr int entries = MixedLayout<n>::entries;
  const StepRates& rates = data.rates;
  const double dt = rates.step;
  // Levels: the new one, carried from the balance to the step's end, and finished ones.
  const auto end = [&](const std::vector<double>& now, const std::vector<double>& old, std::size_t i) {
    return old[i] + (now[i] - old[i]) / rates.carry;
  };
  const auto norm_of = [&](std::vector<double> Solution::*field, const std::vector<double>& volumes) {
    const auto &now = state.now.*field, &old = state.before[0].*field;
    return norm(volumes, entries, 0, n, [&](std::size_t i) { return end(now, old, i); });
  };
  last_ = {};
  if (has_wall_) last_.displacement = norm_of(&Solution::wall, wall_volumes_);
  if (has_fluid_) last_.velocity = norm_of(&Solution::fluid, fluid_volumes_);
  std::vector<double> Solution::*const medium = has_fluid_ ? &Solution::fluid : &Solution::wall;
  const std::vector<double>& medium_volumes = has_fluid_ ? fluid_volumes_ : wall_volumes_;
  last_.pressure = norm(medium_volumes, entries, n, 1, [&](std::size_t i) { return (state.now.*medium)[i]; });

  StepErrors errors;
  if (since_jump_ < terms_.order + (rates.carry < 1 ? 1 : 0)) return errors;
  errors.known = true;
  const auto& t = state.times;
  // A scheme whose balance lies between two levels leaves what its steps cannot resolve as a sawtooth in the levels.
  // The balances, means of neighbours, have none of it.
  const bool between = rates.carry < 1;
  const auto& before = between ? state.balances : state.before;
  const auto& times = between ? state.balance_times : t;
  const double time = between ? rates.time : data.time;
  const auto second = divided_difference<3>({time, times[0], times[1]});
  const auto added = [&](std::vector<double> Solution::*field, const std::vector<double>& volumes) {
    const auto &y = state.now.*field, &y0 = before[0].*field, &y1 = before[1].*field, &y2 = before[2].*field;
    const double curvature = 2 * norm(volumes, entries, 0, n, [&](std::size_t i) {
                               return second[0] * y[i] + second[1] * y0[i] + second[2] * y1[i];
                             });
    if (terms_.order == 1) return terms_.constant * dt * dt * curvature;
    const auto third = divided_difference<4>({time, times[0], times[1], times[2]});
    const double change = 6 * norm(volumes, entries, 0, n, [&](std::size_t i) {
                            return third[0] * y[i] + third[1] * y0[i] + third[2] * y1[i] + third[3] * y2[i];
                          });
    // Of what swings, the two derivatives are out of phase.
    const double shift = std::min(terms_.shift, terms_.largest_shift / dt);
    return dt * dt * dt * std::hypot(terms_.constant * change, shift * curvature);
  };
  const double swings = scene_time_ / dt;
  if (has_wall_)
    errors.displacement =
        swings * relative(added(&Solution::wall, wall_volumes_), std::max(scale_.displacement, last_.displacement));
  if (has_fluid_)
    errors.velocity =
        swings * relative(added(&Solution::fluid, fluid_volumes_), std::max(scale_.velocity, last_.velocity));

  // Pressures: at balances; of a scheme with two stages at those of the last ones.
  const bool balances = state.has_balances();
  const std::size_t older = rates.stage > 0 ? 2 : 1;
  const auto &p0 = state.now.*medium, &p1 = (balances ? state.balances[0] : state.before[0]).*medium,
             &p2 = (balances ? state.balances[older] : state.before[1]).*medium;
  const double t1 = balances ? state.balance_times[0] : t[0], t2 = balances ? state.balance_times[older] : t[1];
  double change = 0;
  if (terms_.order == 1) {
    const auto w = divided_difference<2>({rates.time, t1});
    change = dt * norm(medium_volumes, entries, n, 1, [&](std::size_t i) { return w[0] * p0[i] + w[1] * p1[i]; });
  } else {
    const auto w = divided_difference<3>({rates.time, t1, t2});
    change = 2 * dt * dt * norm(medium_volumes, entries, n, 1, [&](std::size_t i) {
               return w[0] * p0[i] + w[1] * p1[i] + w[2] * p2[i];
             });
  }
  errors.pressure = relative(terms_.constant * change, std::max(scale_.pressure, last_.pressure));
  return errors;
}

template <int n>
void ErrorEstimate<n>::accept(const StepData& data) {
  scale_.displacement = std::max(scale_.displacement, last_.displacement);
  scale_.velocity = std::max(scale_.velocity, last_.velocity);
  scale_.pressure = std::max(scale_.pressure * std::exp(-forgetting * data.rates.step / scene_time_), last_.pressure);
  since_jump_ = data.ends_at_jump ? 0 : since_jump_ + 1;
}

template <int n>
void ErrorEstimate<n>::keep(RestartArchive& archive) {
  std::vector<double> numbers{static_cast<double>(since_jump_), scale_.displacement, scale_.velocity, scale_.pressure};
  archive.array("estimate", ArrayKind::alike, numbers, {4});
  since_jump_ = static_cast<int>(numbers[0]);
  scale_ = {numbers[1], numbers[2], numbers[3]};
}

template class ErrorEstimate<2>;
template class ErrorEstimate<3>;

}  // namespace fsi
