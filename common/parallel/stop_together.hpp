#pragma once

#include "host/stop_request.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// For all processes together, now and again in a long computation: gives it up where one of them was asked to end.
/// \throws Stopped at all of them
inline void stop_together(const Communicator& processes) {
  if (processes.any(look_for_stop() != 0)) throw Stopped();
}

}  // namespace fsi
