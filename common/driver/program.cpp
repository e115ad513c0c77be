#include "driver/program.hpp"

#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/standard_streams.hpp"

namespace fsi {

namespace {

constexpr std::size_t unexpected_limit = 1000;  // characters of a message of another library, and of a warning

void say(const std::string& name, const char* kind, const std::string& message) {
  print_error((name + ": " + kind + ": " + message + "\n").c_str());
}

int failure(const std::string& name, const std::string& message, ExitCode code) {
  // What is wrong with the command line has the program's name as its file, which stands there already.
  const std::string own = name + ": ";
  say(name, "error", message.compare(0, own.size(), own) == 0 ? message.substr(own.size()) : message);
  return code;
}

/// Without memory to put a message together.
int out_of_memory(const std::string& name) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(),
                "%.100s: error: out of memory; take a coarser mesh, an iterative linear solver or a larger machine\n",
                name.c_str());
  print_error(line.data());
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
    end_out_of_memory(name, error);
  } catch (const std::bad_alloc&) {
    return out_of_memory(name);
  } catch (const std::exception& error) {
    return failure(name, "unexpected: " + shortened(error.what(), unexpected_limit), exit_bad_input);
  } catch (...) {
    return failure(name, "unexpected exception of unknown type", exit_bad_input);
  }
}

}  // namespace fsi
