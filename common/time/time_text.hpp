#pragma once

#include <fmt/format.h>

#include <string>

namespace fsi {

/// Names a level: "t = 0.5 ms", or "0.4 of the load" in statics, where time is that share.
inline std::string time_text(double time, bool is_static) {
  return is_static ? fmt::format("{:g} of the load", time) : fmt::format("t = {:g} ms", time);
}

}  // namespace fsi
