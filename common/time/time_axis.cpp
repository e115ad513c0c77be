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
  stretches_ = {
      {0, 0,
       time_ != nullptr ? time_->step : static_cast<double>(setup.static_load.value_or(StaticData{}).load_steps)}};
}

int TimeAxis::planned(const Stretch& stretch) const {
  if (time_ != nullptr)
    return std::max(0, static_cast<int>(std::ceil((time_->end - stretch.start) / stretch.asked - rounding)));
  // The rest of the load in equal steps, none larger than one of a whole run would be.
  return static_cast<int>(std::ceil((1 - stretch.start) * stretch.asked - rounding));
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
  return std::strtod(fmt::format("{:.12g}", stretch.start + (step - stretch.after) * stretch.asked).c_str(), nullptr);
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
