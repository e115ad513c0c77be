#include "host/stop_request.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <utility>

namespace fsi {

namespace {

using Clock = std::chrono::steady_clock;

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
  const auto now = Clock::now();
  if (last_look) longest = std::max(longest, std::chrono::duration<double>(now - *last_look).count());
  last_look = now;
  return noted;
}

double longest_time_between_looks() noexcept {
  return std::exchange(longest, 0.0);
}

}  // namespace fsi
