#include "host/stop_request.hpp"

#include <algorithm>
#include <csignal>
#include <optional>
#include <utility>

#include "base/stopwatch.hpp"

namespace fsi {

namespace {

volatile std::sig_atomic_t noted = 0;
std::optional<Clock::time_point> last_look;
double longest = 0;  // s

}  // namespace

void request_stop(int signal) noexcept {
  if (noted == 0) noted = signal;
}

int requested_stop() noexcept {
  return noted;
}

int look_for_stop() noexcept {
  if (last_look) longest = std::max(longest, seconds_since(*last_look));
  last_look = Clock::now();
  return noted;
}

double longest_time_between_looks() noexcept {
  return std::exchange(longest, 0.0);
}

}  // namespace fsi
