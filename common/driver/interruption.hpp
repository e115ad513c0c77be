#pragma once

namespace fsi {

/// While it lives, the first SIGINT (Ctrl-C) or SIGTERM is only noted, so that a run can end after the step in
/// progress. A second one ends the program at once, as if nothing watched. A signal that was ignored stays ignored.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that came, 0: none.
  static int signal();
  /// Whether one came.
  explicit operator bool() const { return signal() != 0; }
};

/// Exit code of a program that a signal ended, as shells have it: 130 after SIGINT, 143 after SIGTERM.
inline int interrupted_exit_code(int signal) {
  return 128 + signal;
}

}  // namespace fsi
