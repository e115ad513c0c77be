#include "restart/checkpoint_pace.hpp"

#include <algorithm>

namespace fsi {

bool CheckpointPace::is_due(int step, double now) const {
  if (rule_.every && *rule_.every == 0) return false;
  if (rule_.every && step % *rule_.every == 0) return true;
  const double age = now - last_, cost = cost_.value_or(rule_.first_guess);
  if (rule_.seconds) return age >= *rule_.seconds;
  if (rule_.every) return false;
  return (age >= cost / rule_.share && spent_ + cost <= rule_.share * now) || age >= rule_.longest;
}

void CheckpointPace::written(double now, double seconds) {
  cost_ = std::max(seconds, last_seconds_);  // a disk that was slow once may be slow again
  last_seconds_ = seconds;
  spent_ += seconds;
  last_ = now;
}

}  // namespace fsi
