#include "derived/period_change.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "time/time_rounding.hpp"

namespace fsi {

namespace {

void interpolate(const std::vector<double>& from, const std::vector<double>& to, double part,
                 std::vector<double>& between) {
  between.resize(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) between[i] = part == 1 ? to[i] : from[i] + part * (to[i] - from[i]);
}

/// Length of a vector, or of the difference of two.
double length(const double* vector, const double* from, int components) {
  double squares = 0;
  for (int k = 0; k < components; ++k) {
    const double part = vector[k] - (from == nullptr ? 0 : from[k]);
    squares += part * part;
  }
  return std::sqrt(squares);
}

}  // namespace

double PeriodChange::largest() const {
  return std::max({pressure, flow, displacement});
}

PeriodChange change_of(const PeriodComparison::Extremes& extremes, double end) {
  std::array<double, 3> share{};
  for (std::size_t q = 0; q < 3; ++q) {
    const double range = std::max(extremes.range[q], PeriodComparison::least_range * extremes.size[q]);
    if (extremes.difference[q] > 0) share[q] = extremes.difference[q] / range;
  }
  return {end, share[0], share[1], share[2]};
}

std::optional<PeriodComparison::Extremes> PeriodComparison::add(double time, const PeriodicValues& values) {
  const double spacing = period_ / phases;
  if (!begun_) {
    begun_ = true;
    time_ = time;
    now_ = values;
    passed_ = static_cast<std::int64_t>(std::floor(time / spacing * (1 + time_rounding)));
    scalars_.assign(phases * 2 * openings_, 0.0);
    vectors_.assign(phases * values.displacement.size(), 0.0);
    start_period(values);
    if (std::abs(static_cast<double>(passed_) * spacing - time) <= time_rounding * time)
      pass(static_cast<int>(passed_ % phases), values);
    return {};
  }
  if (time <= time_) return {};
  assert(values.displacement.size() == now_.displacement.size());
  std::optional<Extremes> ended;
  PeriodicValues between;
  for (double next = static_cast<double>(passed_ + 1) * spacing; next <= time * (1 + time_rounding);
       next = static_cast<double>(passed_ + 1) * spacing) {
    const double part = std::min(1.0, (next - time_) / (time - time_));
    interpolate(now_.pressures, values.pressures, part, between.pressures);
    interpolate(now_.flows, values.flows, part, between.flows);
    interpolate(now_.displacement, values.displacement, part, between.displacement);
    ++passed_;
    const int phase = static_cast<int>(passed_ % phases);
    // The end of a period is the beginning of the next: it belongs to both.
    if (phase == 0) {
      if (known_ == 2 * phases) ended = extremes_;
      start_period(between);
    }
    pass(phase, between);
  }
  now_ = values;
  time_ = time;
  return ended;
}

void PeriodComparison::start_period(const PeriodicValues& values) {
  extremes_ = {};
  least_ = values.pressures;
  least_.insert(least_.end(), values.flows.begin(), values.flows.end());
  most_ = least_;
}

void PeriodComparison::pass(int phase, const PeriodicValues& values) {
  const auto at = static_cast<std::size_t>(phase);
  const bool repeats = known_ >= phases;
  const auto raise = [](double& largest, double value) { largest = std::max(largest, value); };
  for (std::size_t i = 0; i < 2 * openings_; ++i) {
    const std::size_t kind = i < openings_ ? 0 : 1;
    const double value = kind == 0 ? values.pressures[i] : values.flows[i - openings_];
    double& stored = scalars_[at * 2 * openings_ + i];
    if (repeats) raise(extremes_.difference[kind], std::abs(value - stored));
    stored = value;
    least_[i] = std::min(least_[i], value);
    most_[i] = std::max(most_[i], value);
    raise(extremes_.range[kind], most_[i] - least_[i]);
    raise(extremes_.size[kind], std::abs(value));
  }
  const auto& displacement = values.displacement;
  double* stored = vectors_.data() + at * displacement.size();
  for (std::size_t i = 0; i < displacement.size(); i += static_cast<std::size_t>(components_)) {
    const double* vector = displacement.data() + i;
    if (repeats) raise(extremes_.difference[2], length(vector, stored + i, components_));
    std::copy(vector, vector + components_, stored + i);
    raise(extremes_.range[2], length(vector, vectors_.data() + i, components_));  // from phase 0, which is stored first
    raise(extremes_.size[2], length(vector, nullptr, components_));
  }
  known_ = std::min<std::int64_t>(known_ + 1, 2 * phases);
}

void PeriodComparison::share(const Communicator& processes) {
  for (auto* part : {&extremes_.difference, &extremes_.range, &extremes_.size})
    for (double& value : *part) value = processes.largest(value);
}

void PeriodComparison::keep(Memory& memory) {
  if (!memory.recalls() && !begun_) return;
  const auto columns = static_cast<std::size_t>(phases);
  std::vector<double> clock{period_, time_};
  std::vector<double> extremes;
  for (const auto* part : {&extremes_.difference, &extremes_.range, &extremes_.size})
    extremes.insert(extremes.end(), part->begin(), part->end());
  const bool kept =
      memory.wants({"clock", "passed", "known", "extremes", "pressures", "flows", "scalars", "least", "most"});
  if (kept) memory.array("clock", ArrayKind::alike, clock, {clock.size()});
  if (!kept || clock[0] != period_)
    return memory.warn("periods are compared anew: the earlier run had no comparison of this period");
  begun_ = true;
  time_ = clock[1];
  memory.integer("passed", passed_, count_range);
  memory.integer("known", known_, {0, 2 * phases, true});
  const auto alike = [&](const char* name, std::vector<double>& values, std::size_t length) {
    memory.array(name, ArrayKind::alike, values, {length});
  };
  alike("extremes", extremes, extremes.size());
  for (std::size_t q = 0; q < 3; ++q) {
    extremes_.difference[q] = extremes[q];
    extremes_.range[q] = extremes[3 + q];
    extremes_.size[q] = extremes[6 + q];
  }
  alike("pressures", now_.pressures, openings_);
  alike("flows", now_.flows, openings_);
  alike("scalars", scalars_, columns * 2 * openings_);
  alike("least", least_, 2 * openings_);
  alike("most", most_, 2 * openings_);
  if (memory.recalls() ? !memory.wants({"displacement", "vectors"}) : now_.displacement.empty()) return;
  memory.array("displacement", ArrayKind::interface, now_.displacement);
  memory.array("vectors", ArrayKind::interface_columns, vectors_, {{}, columns});
}

}  // namespace fsi
