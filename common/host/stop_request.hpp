#pragma once

#include <exception>

namespace fsi {

// The wish that the program end soon: a signal handler notes it, long computations look for it where they can give up what
// they are doing.

/// Thrown where a computation gives up because the program was asked to end. What it worked on is then as it may be.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "asked to end"; }
};

/// Notes the signal that asks for the end; the first one counts. May be called by a signal handler.
void request_stop(int signal) noexcept;

/// The signal that has been noted; 0: none.
int requested_stop() noexcept;

/// The same for a computation that looks now and again, on the main thread: the time between two looks is how long a
/// signal may wait.
int look_for_stop() noexcept;

/// The longest time between two looks since the last call, s; 0: there were no two.
double longest_time_between_looks() noexcept;

}  // namespace fsi
