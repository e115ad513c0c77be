#include "run/program.hpp"

#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "host/available_memory.hpp"
#include "host/standard_streams.hpp"
#include "parallel/communicator.hpp"
#include "parallel/end_together.hpp"

namespace fsi {

namespace {

constexpr std::size_t unexpected_limit = 1000;  // characters of a message of another library, and of a warning

void say(const std::string& name, const std::string& kind, const std::string& message) {
  print_error((name + ": " + kind + ": " + message + "\n").c_str());
}

/// Of several processes one speaks for all if all end with this code. If they do not, a process that fails says so itself
/// and ends the others, which may wait for it.
struct LastWords {
  explicit LastWords(int exit_code) : code(exit_code), alike(all_end_with(exit_code, patience)) {
    if (!alike) keep_streams_silent(false);
  }
  ~LastWords() {
    if (!alike) ProcessGroup::abort(code);
  }
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;
  /// "error", or "error (process 2 of 3)".
  std::string kind() const {
    const Communicator& world = Communicator::world();
    return alike ? "error"
                 : "error (process " + std::to_string(world.rank() + 1) + " of " + std::to_string(world.size()) + ")";
  }

  static constexpr double patience = 6;  // seconds
  int code;
  bool alike;
};

int failure(const std::string& name, const std::string& message, ExitCode code) {
  const LastWords last(code);
  // What is wrong with the command line has the program's name as its file, which stands there already.
  const std::string own = name + ": ";
  say(name, last.kind(), message.compare(0, own.size(), own) == 0 ? message.substr(own.size()) : message);
  return code;
}

/// Without memory to put a message together.
int out_of_memory(const std::string& name) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(),
                "%.100s: error: out of memory; take a coarser mesh, an iterative linear solver or a larger machine\n",
                name.c_str());
  keep_streams_silent(false);
  print_error(line.data());
  if (!Communicator::world().is_alone()) ProcessGroup::abort(exit_bad_input);  // the others know nothing of it
  return exit_bad_input;
}

}  // namespace

void warn(const std::string& name, const std::string& message) {
  say(name, "warning", shortened(message, unexpected_limit));
}

int run_program(const std::string& name, const std::function<int()>& body) {
  try {
    guard_standard_streams();
    return body();
  } catch (const InputError& error) {
    return failure(name, error.what(), exit_bad_input);
  } catch (const ConvergenceError& error) {
    return failure(name, error.what(), exit_not_converged);
  } catch (const OutOfMemory& error) {
    if (Communicator::world().is_alone()) end_out_of_memory(name, error);
    return failure(name, error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return out_of_memory(name);
  } catch (const std::exception& error) {
    return failure(name, "unexpected: " + shortened(error.what(), unexpected_limit), exit_bad_input);
  } catch (...) {
    return failure(name, "unexpected exception of unknown type", exit_bad_input);
  }
}

}  // namespace fsi
