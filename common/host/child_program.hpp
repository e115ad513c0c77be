#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fsi {

/// The program of this name in the folder of the running one; empty if there is none.
std::filesystem::path beside_this_program(const std::string& name);

/// How a child program ended.
struct ChildEnd {
  int code = 0;        ///< exit code; 128 + n when signal n ended it
  std::string output;  ///< what it wrote to its standard output
  std::string errors;  ///< and to its standard error
};

/// Runs a program to its end; one at a time. \param words  its path and arguments
/// \throws InputError when it cannot be started
ChildEnd run_child(const std::vector<std::string>& words);

/// Sends SIGTERM to the running child, waits for its end, and kills it after 5 s: a program that a signal ends leaves
/// no child behind. May be called by a signal handler. Does nothing if no child runs.
void end_child() noexcept;

}  // namespace fsi
