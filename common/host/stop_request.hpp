#pragma once

#include <exception>

namespace fsi {

// A request that the program end soon: a signal handler notes it, long computations look for it where they can stop.

/// Thrown where a computation stops because the program was asked to end. What it worked on may be half done.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "asked to end"; }
};

/// Notes the signal that asks for the end; the first one counts. May be called by a signal handler.
void request_stop(int signal) noexcept;

/// The signal that has been noted; 0: none.
int requested_stop() noexcept;

/// The same for a computation that looks repeatedly, on the main thread. Measures the time between two looks, which is
/// how long a signal may wait.
int look_for_stop() noexcept;

/// The longest time between two looks since the last call of this function, s; 0 if there was no look.
double longest_time_between_looks() noexcept;

}  // namespace fsi
