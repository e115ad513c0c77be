#include "scene/time_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "case/openings.hpp"
#include "case/support_loads.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

TimeAxis::TimeAxis(const Case& setup) : time_(setup.time ? &*setup.time : nullptr) {
  if (time_ != nullptr)
    for (const auto& [key, table] : tables_over_time(setup))
      for (double jump : table->jumps(time_->end))
        if (jump > 0 && jump <= time_->end) jumps_.push_back(jump);  // at the end, too: a restart goes on from it
  if (time_ != nullptr)
    for (const SupportLoad& load : support_loads_of(setup))
      for (double jump : load.course.jumps(time_->end))
        if (jump > 0 && jump <= time_->end) jumps_.push_back(jump);
  std::sort(jumps_.begin(), jumps_.end());
  jumps_.erase(std::unique(jumps_.begin(), jumps_.end()), jumps_.end());
  stops_ = jumps_;
  if (time_ != nullptr)
    for (double time : output_times(setup))
      if (time > 0 && time < time_->end) stops_.push_back(time);
  if (time_ != nullptr)
    for (double time : setup.output.times)
      if (time <= time_->end) stops_.push_back(time);  // at the end, too: a restart goes on from it
  std::sort(stops_.begin(), stops_.end());
  const double same = time_rounding * (time_ != nullptr ? time_->end : 1);
  stops_.erase(std::unique(stops_.begin(), stops_.end(), [&](double a, double b) { return b - a <= same; }),
               stops_.end());
  rows_ = rows_of(stops_);
  stretches_ = {
      {0, 0,
       time_ != nullptr ? time_->step : static_cast<double>(setup.static_load.value_or(StaticData{}).load_steps)}};
  share_rest();
}

double TimeAxis::length_in(const Stretch& stretch) const {
  if (stretch.asked > 0) return stretch.asked;
  return insertions_.empty() ? time_->end : insertions_.back().length;
}

void TimeAxis::set_stretches(std::vector<Stretch> stretches) {
  stretches_ = std::move(stretches);
  plans_.clear();
}

template <class Visit>
void TimeAxis::for_each_piece(const Stretch& stretch, Visit visit) const {
  double start = stretch.start;
  const double asked = length_in(stretch);
  for (auto stop = std::upper_bound(stops_.begin(), stops_.end(), start + time_rounding * asked); stop != stops_.end();
       ++stop) {
    if (*stop <= start + time_rounding * asked) continue;
    const double steps = (*stop - start) / asked;
    const int count = static_cast<int>(std::ceil(steps - time_rounding));
    const bool whole = std::abs(steps - count) <= time_rounding;
    if (!visit(Piece{start, *stop, count, whole ? asked : (*stop - start) / count})) return;
    start = *stop;
  }
  const double steps = (time_->end - start) / asked;
  int count = static_cast<int>(std::ceil(steps - time_rounding));
  constexpr double shortest = 0.5;  // of a last step, in steps
  const bool sliver = steps - (count - 1) < shortest - time_rounding;
  if (sliver && count > 1 && stretch.asked > 0) --count;  // the last one is longer, for share_rest()
  visit(Piece{start, time_->end, std::max(0, count), asked});
}

const TimeAxis::Plan& TimeAxis::plan(std::size_t stretch) const {
  plans_.resize(stretches_.size());
  if (plans_[stretch]) return *plans_[stretch];
  Plan& made = plans_[stretch].emplace();
  int steps = 0;
  for_each_piece(stretches_[stretch], [&](const Piece& piece) {
    made.pieces.push_back(piece);
    made.until.push_back(steps += piece.steps);
    return true;
  });
  return made;
}

int TimeAxis::planned(std::size_t stretch) const {
  const double asked = stretches_[stretch].asked;
  // The rest of the load in equal steps, none larger than one of a whole run would be.
  if (time_ == nullptr) return static_cast<int>(std::ceil((1 - stretches_[stretch].start) * asked - time_rounding));
  return asked > 0 ? plan(stretch).until.back() : estimated(stretches_[stretch]);
}

int TimeAxis::estimated(const Stretch& stretch) const {
  const double asked = length_in(stretch);
  const auto steps = [&](double length) {
    return std::max(0, static_cast<int>(std::ceil(length / asked - time_rounding)));
  };
  double start = stretch.start;
  int sum = 0;
  for (const Row& row : rows_) {
    if (row.last <= start + time_rounding * asked) continue;
    double first = row.first;  // the next stop
    if (first <= start + time_rounding * asked) {
      const double passed = std::floor((start + time_rounding * asked - row.first) / row.distance);
      first = std::min(row.last, row.first + (passed + 1) * row.distance);
    }
    sum += steps(first - start);
    if (row.last > first) sum += static_cast<int>(std::lround((row.last - first) / row.distance)) * steps(row.distance);
    start = row.last;
  }
  return sum + steps(time_->end - start);
}

std::vector<TimeAxis::Row> TimeAxis::rows_of(const std::vector<double>& times) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double distance = i == 0 ? 0 : times[i] - times[i - 1];
    const auto fits = [&](const Row& row) {
      return row.last == row.first || std::abs(distance - row.distance) <= 1e-6 * row.distance;
    };
    if (rows.empty() || !fits(rows.back())) {
      rows.push_back({times[i], times[i], 0});
      continue;
    }
    Row& row = rows.back();
    row.distance = row.last == row.first ? distance : row.distance;
    row.last = times[i];
  }
  return rows;
}

bool TimeAxis::jumps_at(double time) const {
  const double same = time_ == nullptr ? 0 : std::max(time_rounding * stretches_.back().asked, 1e-12 * time_->end);
  const auto next = std::lower_bound(jumps_.begin(), jumps_.end(), time);
  return (next != jumps_.end() && *next - time <= same) || (next != jumps_.begin() && time - *(next - 1) <= same);
}

int TimeAxis::planned_steps() const {
  return stretches_.back().after + planned(stretches_.size() - 1);
}

int TimeAxis::steps() const {
  return planned_steps() + static_cast<int>(insertions_.size());
}

std::size_t TimeAxis::stretch_of(int step) const {
  std::size_t i = stretches_.size() - 1;
  while (i > 0 && step <= stretches_[i].after) --i;
  return i;
}

int TimeAxis::inserted_before(int step) const {
  const auto behind = std::lower_bound(insertions_.begin(), insertions_.end(), step,
                                       [](const Insertion& inserted, int s) { return inserted.step < s; });
  return static_cast<int>(behind - insertions_.begin());
}

const Insertion* TimeAxis::insertion(int step) const {
  const std::size_t place = inserted_before(step);
  return place < insertions_.size() && insertions_[place].step == step ? &insertions_[place] : nullptr;
}

double TimeAxis::time_of(int step) const {
  if (step == 0) return 0;
  if (const Insertion* inserted = insertion(step)) return inserted->end;
  return planned_time_of(step - inserted_before(step));
}

double TimeAxis::planned_time_of(int step) const {
  const std::size_t place = stretch_of(step);
  const Stretch& stretch = stretches_[place];
  if (step == planned_steps()) return time_ != nullptr ? time_->end : 1;
  if (time_ == nullptr) return stretch.start + (step - stretch.after) * (1 - stretch.start) / planned(place);
  for (const Stretch& next : stretches_)  // where one stretch ends and the next begins, its last step cut short
    if (next.after > 0 && step == next.after) return next.start;
  const int in_stretch = step - stretch.after;
  const auto time_in = [](const Piece& piece, int until, int asked_for) {
    if (asked_for == until) return piece.end;
    const int in_piece = asked_for - (until - piece.steps);
    return std::strtod(fmt::format("{:.12g}", piece.start + in_piece * piece.step).c_str(), nullptr);
  };
  double time = time_->end;
  if (stretch.asked > 0) {
    const auto& [pieces, until] = plan(place);
    const auto found = std::lower_bound(until.begin(), until.end(), in_stretch) - until.begin();
    if (found < static_cast<std::ptrdiff_t>(until.size())) time = time_in(pieces[found], until[found], in_stretch);
  } else {  // adaptive: the plan changes with each step, and little of it is asked for
    int until = 0;
    for_each_piece(stretch, [&](const Piece& piece) {
      until += piece.steps;
      if (in_stretch <= until) time = time_in(piece, until, in_stretch);
      return in_stretch > until;
    });
  }
  return time;
}

double TimeAxis::length_of(int step) const {
  if (time_ == nullptr) return 0;
  if (const Insertion* inserted = insertion(step)) return inserted->length;
  const double length = time_of(step) - time_of(step - 1);
  const double asked = length_in(stretches_.back());
  return std::abs(length - asked) <= time_rounding * asked ? asked : length;
}

double TimeAxis::start_of_last_planned() const {
  const int before = planned_steps() - 1;
  return before <= stretches_.back().after ? stretches_.back().start : planned_time_of(before);
}

void TimeAxis::share_rest() {
  const double asked = stretches_.back().asked;
  if (time_ == nullptr || asked <= 0 || planned_steps() <= stretches_.back().after) return;
  const double start = start_of_last_planned();
  if (time_->end - start <= asked * (1 + time_rounding)) return;
  if (!insertions_.empty() && insertions_.back().end > start + time_rounding * asked) return;  // halved already
  const double half = 0.5 * (time_->end - start);
  insertions_.push_back({steps(), std::strtod(fmt::format("{:.12g}", start + half).c_str(), nullptr), half});
}

double TimeAxis::shorter_last_steps() const {
  const double asked = stretches_.back().asked;
  if (time_ == nullptr || asked <= 0 || planned_steps() <= stretches_.back().after) return 0;
  const double rest = time_->end - start_of_last_planned();
  if (rest > asked * (1 + time_rounding)) return 0.5 * rest;
  return rest < asked * (1 - time_rounding) ? rest : 0;
}

double TimeAxis::next_stop(double time) const {
  const auto next = std::upper_bound(stops_.begin(), stops_.end(), time + time_rounding * time_->end);
  return next == stops_.end() ? time_->end : *next;
}

double TimeAxis::choose(int step, double time, double longest) {
  const double stop = next_stop(time);
  const int count = std::max(1, static_cast<int>(std::ceil((stop - time) / longest - time_rounding)));
  double length = (stop - time) / count;
  drop_insertions_after(step - 1);
  // Rounding is no reason for another Jacobian.
  if (const Insertion* last = insertion(step - 1); last != nullptr && std::abs(last->length - length) <= 1e-9 * length)
    length = last->length;
  const double end = count == 1 ? stop : std::strtod(fmt::format("{:.12g}", time + length).c_str(), nullptr);
  insertions_.push_back({step, end, length});
  set_stretches({{0, end, 0}});
  return length;
}

void TimeAxis::halve(int step) {
  const double start = time_of(step - 1), half = 0.5 * (time_ ? length_of(step) : time_of(step) - start);
  const int place = inserted_before(step);
  for (std::size_t i = place; i < insertions_.size(); ++i) ++insertions_[i].step;
  if (Insertion* rest = place < static_cast<int>(insertions_.size()) ? &insertions_[place] : nullptr;
      rest != nullptr && rest->step == step + 1)
    rest->length = rest->end - (start + half);
  insertions_.insert(insertions_.begin() + place, {step, start + half, half});
}

void TimeAxis::drop_insertions_after(int last) {
  while (!insertions_.empty() && insertions_.back().step > last) insertions_.pop_back();
}

void TimeAxis::drop_later_insertions(int last) {
  if (insertion(last) == nullptr) {
    drop_insertions_after(last);
    return;
  }
  const int planned = last - inserted_before(last + 1) + 1;  // the one in progress
  const double end = planned < planned_steps() ? planned_time_of(planned) : time_->end;
  while (!insertions_.empty() && insertions_.back().step > last && insertions_.back().end >= end)
    insertions_.pop_back();
}

bool TimeAxis::go_on(std::vector<Stretch> past, int last, double time, std::vector<Insertion> inserted) {
  const bool changed = go_on_as_planned(std::move(past), last, time, std::move(inserted));
  share_rest();
  return changed;
}

bool TimeAxis::go_on_as_planned(std::vector<Stretch> past, int last, double time, std::vector<Insertion> inserted) {
  const double asked = stretches_.back().asked;
  set_stretches(std::move(past));
  insertions_ = std::move(inserted);
  const bool changed = asked != stretches_.back().asked;
  if (asked == 0 && time_ != nullptr) {  // adaptive
    if (!changed) {
      drop_insertions_after(last);
    } else {
      const std::vector<double> stops = std::exchange(stops_, jumps_);  // equal steps need no times of output
      plans_.clear();
      std::vector<Insertion> all;
      for (int step = 1; step <= last; ++step) all.push_back({step, time_of(step), length_of(step)});
      stops_ = stops;
      if (!all.empty()) all.back().end = time;
      insertions_ = std::move(all);
    }
    set_stretches({{0, time, 0}});
    return changed;
  }
  if (changed && stretches_.back().asked == 0) {  // adaptive until here
    drop_insertions_after(last);
    set_stretches({{0, time, asked}});
    return true;
  }
  if (time_ != nullptr && stretches_.back().asked > 0)
    drop_later_insertions(last);  // an earlier end's shorter last steps
  // A run that ended between two steps of its stretch, its last one cut short, goes on from that end.
  const bool between = time_ != nullptr && std::abs(time_of(last) - time) > time_rounding * asked;
  if (changed || between) {
    drop_insertions_after(last);
    if (insertion(last) != nullptr) insertions_.pop_back();  // from here the new steps are planned
    const int after = last - static_cast<int>(insertions_.size());
    if (stretches_.back().after == after) stretches_.pop_back();
    stretches_.push_back({after, time, asked});
    plans_.clear();
  }
  return changed;
}

}  // namespace fsi
