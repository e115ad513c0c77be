#pragma once

#include <chrono>

namespace fsi {

using Clock = std::chrono::steady_clock;

/// Wall time since a moment, s.
inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace fsi
