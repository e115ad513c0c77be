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
  std::string output;  ///< of its standard output
  std::string errors;  ///< of its standard error
};

/// Runs a program to its end. \param words  its path and arguments
/// \throws InputError when it cannot be started
ChildEnd run_child(const std::vector<std::string>& words);

/// Asks the child that runs to end, waits for it, and ends it after some seconds: what it makes is not left behind by a
/// program that a signal ends. May be called by a signal handler; nothing is done where no child runs.
void end_child() noexcept;

}  // namespace fsi
