#pragma once

#include <stdexcept>
#include <string>

namespace fsi {

/// A mistake in what the user handed over (case file, mesh, checkpoint, command line). Programs print what() and exit
/// with code 1. what() is one printable line `FILE: KEY: PROBLEM; REMEDY`, long parts shortened, empty ones left out.
class InputError : public std::runtime_error {
 public:
  /// \param file     file at fault, or the program's name for the command line
  /// \param key      key path (`structure.layers.media.c10`), physical group, element or option
  /// \param problem  what is wrong, with the offending value
  /// \param remedy   what would be right
  InputError(const std::string& file, const std::string& key, const std::string& problem, const std::string& remedy);
};

/// A solver that gave up. Programs save the last good state, print what() and exit with code 2.
/// what() is one printable line `PROBLEM; try REMEDY`, without a remedy `PROBLEM`.
class ConvergenceError : public std::runtime_error {
 public:
  ConvergenceError(const std::string& problem, const std::string& remedy);
};

/// Exit codes shared by all programs.
enum ExitCode : int { exit_done = 0, exit_bad_input = 1, exit_not_converged = 2 };

}  // namespace fsi
