#include "derived/period_change.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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
  PeriodChange change{end};
  for (std::size_t q = 0; q < 3; ++q) {
    const double range = std::max(extremes.range[q], PeriodComparison::least_range * extremes.size[q]);
    if (extremes.difference[q] > 0) share[q] = extremes.difference[q] / range;
    if (extremes.mean_difference[q] > 0) change.mean[q] = extremes.mean_difference[q] / range;
    change.contraction[q] =
        extremes.square[q] > 0 ? extremes.product[q] / extremes.square[q] : std::numeric_limits<double>::quiet_NaN();
  }
  change.pressure = share[0];
  change.flow = share[1];
  change.displacement = share[2];
  return change;
}

std::optional<PeriodComparison::Extremes> PeriodComparison::add(double time, const PeriodicValues& values) {
  const double spacing = period_ / phases;
  if (!begun_) {
    begun_ = true;
    time_ = time;
    now_ = values;
    passed_ = static_cast<std::int64_t>(std::floor(time / spacing * (1 + time_rounding)));
    const std::size_t scalars = 2 * openings_, vectors = values.displacement.size();
    at_phases_ = {std::vector<double>(phases * scalars, 0.0), std::vector<double>(phases * vectors, 0.0)};
    mean_ = mean_change_ = {std::vector<double>(scalars, 0.0), std::vector<double>(vectors, 0.0)};
    before_.sum = behind_.sum = mean_;
    least_.assign(scalars, 0.0);
    most_ = least_;
    return {};
  }
  if (time <= time_) return {};
  assert(values.displacement.size() == now_.displacement.size());
  std::optional<Extremes> ended;
  const double step = time - time_;
  const PeriodicValues* first = &now_;
  PeriodicValues between, last_between;
  double from =
      std::max(0.0, time_ / spacing - static_cast<double>(passed_));  // in shares of the way to the next phase
  for (double next = static_cast<double>(passed_ + 1) * spacing; next <= time * (1 + time_rounding);
       next = static_cast<double>(passed_ + 1) * spacing) {
    const double part = std::min(1.0, (next - time_) / step);
    interpolate(now_.pressures, values.pressures, part, between.pressures);
    interpolate(now_.flows, values.flows, part, between.flows);
    interpolate(now_.displacement, values.displacement, part, between.displacement);
    if (from < 1) take(from, 1, *first, between);
    std::swap(between, last_between);
    first = &last_between;
    from = 0;
    // Too little is known of a mean without more than its first half.
    if (before_.weight > 0.5 * spacing * (1 - time_rounding)) pass(static_cast<int>(passed_ % phases), before_);
    std::swap(before_, behind_);
    behind_.weight = 0;
    std::fill(behind_.sum.scalars.begin(), behind_.sum.scalars.end(), 0.0);
    std::fill(behind_.sum.vectors.begin(), behind_.sum.vectors.end(), 0.0);
    ++passed_;
    if (passed_ % phases != 0) continue;
    compare_means();
    if (known_ == 2 * phases) ended = extremes_;
    extremes_ = {};
  }
  const double to = time / spacing - static_cast<double>(passed_);
  if (to > from * (1 + time_rounding)) take(from, to, *first, values);
  now_ = values;
  time_ = time;
  return ended;
}

void PeriodComparison::take(double from, double to, const PeriodicValues& first, const PeriodicValues& last) {
  // Of v from v_0 to v_1 in u from a to b the integral of u v is (b - a) (v_0 (2 a + b) + v_1 (a + 2 b)) / 6.
  const double length = to - from, spacing = period_ / phases;
  const double whole = spacing * length / 2;
  const double rising_first = spacing * length * (2 * from + to) / 6,
               rising_last = spacing * length * (from + 2 * to) / 6;
  const double falling_first = whole - rising_first, falling_last = whole - rising_last;
  before_.weight += falling_first + falling_last;
  behind_.weight += rising_first + rising_last;
  const auto add = [&](const std::vector<double>& start, const std::vector<double>& end, std::vector<double>& falling,
                       std::vector<double>& rising, std::size_t at) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      falling[at + i] += falling_first * start[i] + falling_last * end[i];
      rising[at + i] += rising_first * start[i] + rising_last * end[i];
    }
  };
  add(first.pressures, last.pressures, before_.sum.scalars, behind_.sum.scalars, 0);
  add(first.flows, last.flows, before_.sum.scalars, behind_.sum.scalars, openings_);
  add(first.displacement, last.displacement, before_.sum.vectors, behind_.sum.vectors, 0);
}

void PeriodComparison::pass(int phase, const Around& around) {
  const auto at = static_cast<std::size_t>(phase);
  // The first phase that is seen is without what was before the run.
  const bool repeats = known_ > phases, first = phase == 0 || known_ == 0;
  const auto raise = [](double& largest, double value) { largest = std::max(largest, value); };
  for (std::size_t i = 0; i < 2 * openings_; ++i) {
    const std::size_t kind = i < openings_ ? 0 : 1;
    const double value = around.sum.scalars[i] / around.weight;
    double& stored = at_phases_.scalars[at * 2 * openings_ + i];
    if (repeats) raise(extremes_.difference[kind], std::abs(value - stored));
    stored = value;
    least_[i] = first ? value : std::min(least_[i], value);
    most_[i] = first ? value : std::max(most_[i], value);
    raise(extremes_.range[kind], most_[i] - least_[i]);
    raise(extremes_.size[kind], std::abs(value));
  }
  const std::size_t count = around.sum.vectors.size();
  double* stored = at_phases_.vectors.data() + at * count;
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(components_)) {
    for (int k = 0; k < components_; ++k) vector[k] = around.sum.vectors[i + k] / around.weight;
    if (repeats) raise(extremes_.difference[2], length(vector.data(), stored + i, components_));
    std::copy(vector.begin(), vector.begin() + components_, stored + i);
    // From phase 0, which is stored first.
    raise(extremes_.range[2], length(vector.data(), at_phases_.vectors.data() + i, components_));
    raise(extremes_.size[2], length(vector.data(), nullptr, components_));
  }
  known_ = std::min<std::int64_t>(known_ + 1, 2 * phases);
}

void PeriodComparison::compare_means() {
  if (known_ < phases) return;
  const std::int64_t before = means_;
  means_ = std::min<std::int64_t>(means_ + 1, 2);
  const auto new_mean = [](const std::vector<double>& values, std::size_t count, std::size_t i) {
    double sum = 0;
    for (std::size_t phase = 0; phase < phases; ++phase) sum += values[phase * count + i];
    return sum / phases;
  };
  // All entries that belong together: one number, or the components of a vector.
  const auto compare = [&](const std::vector<double>& values, std::vector<double>& mean, std::vector<double>& change,
                           std::size_t from, std::size_t components, std::size_t q) {
    double product = 0, square = 0, difference = 0;
    for (std::size_t i = from; i < from + components; ++i) {
      const double next = new_mean(values, mean.size(), i), by = next - mean[i];
      product += by * change[i];
      square += change[i] * change[i];
      difference += by * by;
      mean[i] = next;
      change[i] = before >= 1 ? by : 0;
    }
    if (before >= 1) extremes_.mean_difference[q] = std::max(extremes_.mean_difference[q], std::sqrt(difference));
    if (before < 2) return;
    extremes_.product[q] = std::max(extremes_.product[q], product);
    extremes_.square[q] = std::max(extremes_.square[q], square);
  };
  for (std::size_t i = 0; i < 2 * openings_; ++i)
    compare(at_phases_.scalars, mean_.scalars, mean_change_.scalars, i, 1, i < openings_ ? 0 : 1);
  const auto components = static_cast<std::size_t>(components_);
  for (std::size_t i = 0; i < mean_.vectors.size(); i += components)
    compare(at_phases_.vectors, mean_.vectors, mean_change_.vectors, i, components, 2);
}

void PeriodComparison::share(const Communicator& processes) {
  for (auto* part : {&extremes_.difference, &extremes_.range, &extremes_.size})
    for (double& value : *part) value = processes.largest(value);
}

void PeriodComparison::keep(RestartArchive& archive) {
  if (!archive.recalls() && !begun_) return;
  const auto columns = static_cast<std::size_t>(phases);
  std::vector<double> clock{period_, time_, before_.weight, behind_.weight};
  std::vector<double> extremes;
  for (const auto* part : {&extremes_.difference, &extremes_.range, &extremes_.size})
    extremes.insert(extremes.end(), part->begin(), part->end());
  const bool kept = archive.wants({"phase_clock"});
  if (kept) archive.array("phase_clock", ArrayKind::alike, clock, {clock.size()});
  if (!kept || clock[0] != period_)
    return archive.warn("periods are compared anew: the earlier run had no such comparison of this period");
  begun_ = true;
  time_ = clock[1];
  before_.weight = clock[2];
  behind_.weight = clock[3];
  archive.integer("passed", passed_, count_range);
  archive.integer("known", known_, {0, 2 * phases, true});
  archive.integer("means", means_, {0, 2, true});
  const auto alike = [&](const char* name, std::vector<double>& values, std::size_t length) {
    archive.array(name, ArrayKind::alike, values, {length});
  };
  alike("extremes", extremes, extremes.size());
  for (std::size_t q = 0; q < 3; ++q) {
    extremes_.difference[q] = extremes[q];
    extremes_.range[q] = extremes[3 + q];
    extremes_.size[q] = extremes[6 + q];
  }
  const std::size_t scalars = 2 * openings_;
  alike("pressures", now_.pressures, openings_);
  alike("flows", now_.flows, openings_);
  alike("scalars", at_phases_.scalars, columns * scalars);
  alike("before", before_.sum.scalars, scalars);
  alike("behind", behind_.sum.scalars, scalars);
  alike("mean", mean_.scalars, scalars);
  alike("mean_change", mean_change_.scalars, scalars);
  alike("least", least_, scalars);
  alike("most", most_, scalars);
  if (archive.recalls() ? !archive.wants({"displacement", "vectors"}) : now_.displacement.empty()) return;
  archive.array("displacement", ArrayKind::interface, now_.displacement);
  archive.array("vectors", ArrayKind::interface_columns, at_phases_.vectors, {{}, columns});
  archive.array("before_displacement", ArrayKind::interface, before_.sum.vectors);
  archive.array("behind_displacement", ArrayKind::interface, behind_.sum.vectors);
  archive.array("mean_displacement", ArrayKind::interface, mean_.vectors);
  archive.array("mean_displacement_change", ArrayKind::interface, mean_change_.vectors);
}

}  // namespace fsi
