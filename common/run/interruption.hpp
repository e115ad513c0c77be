#pragma once

#include <optional>
#include <string>

namespace fsi {

// What a program does at SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal is gone). One that was ignored when the
// program began, as by nohup, stays ignored.

/// From now on the first of them ends the program at once: what is kept for removal (host/removed_on_signal.hpp) is
/// removed, stderr gets the line `PROGRAM: interrupted SAID`, the exit code is interrupted_exit_code. For times when
/// there is nothing to finish.
void end_at_signals(const std::string& program, const std::string& said);

/// SIGTERM is without that line from now on: launchers of several processes send it to the others when one has failed and
/// has said why.
void expect_launcher();

/// From now on the first of them is only noted (host/stop_request.hpp), so that a run can end in order. A second one ends
/// the program at once, as if nothing watched. To the end of the program: a run that is done says so.
void note_signals();

/// The first one that is noted is answered at once by a line on stderr: that the program ends within about so many seconds,
/// and what a second one does. To be called again as the estimate changes; without it nothing is said.
/// \param seconds   empty: nobody knows yet
/// \param new_line  a line on the terminal is open
void answer_signals(const std::string& program, std::optional<double> seconds, bool new_line);

/// The signal that has been noted, 0: none.
int noted_signal();

/// Exit code of a program that a signal ended, as shells have it: 130 after SIGINT, 143 SIGTERM, 129 SIGHUP.
inline int interrupted_exit_code(int signal) {
  return 128 + signal;
}

}  // namespace fsi
