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

/// From now on SIGTERM ends the program without that line: launchers of several processes send it to the others when
/// one has failed, and that one has printed the reason.
void expect_launcher();

/// From now on the first of them is only noted (host/stop_request.hpp), so that a run can end in order. A second one
/// ends the program at once by its default action. This holds to the end of the program.
void note_signals();

/// Sets the line that the signal handler prints on stderr at the first noted signal: that the program ends within about
/// so many seconds, and what a second signal does. To be called again as the estimate changes; without it the handler
/// prints nothing.
/// \param seconds   empty: there is no estimate yet
/// \param new_line  begin with a line feed, since the cursor may stand behind a line of progress
void answer_signals(const std::string& program, std::optional<double> seconds, bool new_line);

/// The signal that has been noted, 0: none.
int noted_signal();

/// Exit code of a program that a signal ended, as shells have it: 130 after SIGINT, 143 SIGTERM, 129 SIGHUP.
inline int interrupted_exit_code(int signal) {
  return 128 + signal;
}

}  // namespace fsi
