#include "time/time_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace fsi {

namespace {
constexpr double rounding = 1e-9;  // of a step: no further one for what is left
}  // namespace

TimeAxis::TimeAxis(const Case& setup) : time_(setup.time ? &*setup.time : nullptr) {
  if (time_ != nullptr)
    for (const auto* table : {&setup.inlet, &setup.load})
      if (*table)
        for (double jump : (*table)->jumps())
          if (jump > 0 && jump <= time_->end) jumps_.push_back(jump);  // at the end, too: a restart goes on from it
  std::sort(jumps_.begin(), jumps_.end());
  jumps_.erase(std::unique(jumps_.begin(), jumps_.end()), jumps_.end());
  stretches_ = {
      {0, 0,
       time_ != nullptr ? time_->step : static_cast<double>(setup.static_load.value_or(StaticData{}).load_steps)}};
}

std::vector<TimeAxis::Piece> TimeAxis::pieces(const Stretch& stretch) const {
  std::vector<Piece> pieces;
  double start = stretch.start;
  for (double jump : jumps_) {
    if (jump <= start + rounding * stretch.asked) continue;
    const double steps = (jump - start) / stretch.asked;
    const int count = static_cast<int>(std::ceil(steps - rounding));
    const bool whole = std::abs(steps - count) <= rounding;
    pieces.push_back({start, jump, count, whole ? stretch.asked : (jump - start) / count});
    start = jump;
  }
  const int count = static_cast<int>(std::ceil((time_->end - start) / stretch.asked - rounding));
  pieces.push_back({start, time_->end, std::max(0, count), stretch.asked});
  return pieces;
}

int TimeAxis::planned(const Stretch& stretch) const {
  if (time_ != nullptr) {
    int steps = 0;
    for (const Piece& piece : pieces(stretch)) steps += piece.steps;
    return steps;
  }
  // The rest of the load in equal steps, none larger than one of a whole run would be.
  return static_cast<int>(std::ceil((1 - stretch.start) * stretch.asked - rounding));
}

bool TimeAxis::jumps_at(double time) const {
  return std::any_of(jumps_.begin(), jumps_.end(),
                     [&](double jump) { return std::abs(time - jump) <= rounding * stretches_.back().asked; });
}

int TimeAxis::steps() const {
  return stretches_.back().after + planned(stretches_.back());
}

const Stretch& TimeAxis::stretch_of(int step) const {
  std::size_t i = stretches_.size() - 1;
  while (i > 0 && step <= stretches_[i].after) --i;
  return stretches_[i];
}

double TimeAxis::time_of(int step) const {
  const Stretch& stretch = stretch_of(step);
  if (step == steps()) return time_ != nullptr ? time_->end : 1;
  if (time_ == nullptr) return stretch.start + (step - stretch.after) * (1 - stretch.start) / planned(stretch);
  for (const Stretch& next : stretches_)  // where one stretch ends and the next begins, its last step cut short
    if (next.after > 0 && step == next.after) return next.start;
  int done = stretch.after;  // steps before the piece
  for (const Piece& piece : pieces(stretch)) {
    const int in_piece = step - done;
    done += piece.steps;
    if (step > done) continue;
    if (step == done) return piece.end;
    return std::strtod(fmt::format("{:.12g}", piece.start + in_piece * piece.step).c_str(), nullptr);
  }
  return time_->end;
}

bool TimeAxis::go_on(std::vector<Stretch> past, int last, double time) {
  const double asked = stretches_.back().asked;
  stretches_ = std::move(past);
  const bool changed = asked != stretches_.back().asked;
  // A run that ended between two steps of its stretch, its last one cut short, goes on from that end.
  const bool between = time_ != nullptr && std::abs(time_of(last) - time) > rounding * asked;
  if (changed || between) {
    if (stretches_.back().after == last) stretches_.pop_back();
    stretches_.push_back({last, time, asked});
  }
  return changed;
}

}  // namespace fsi
