#include "driver/program.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/error.hpp"

namespace fsi {

namespace {

int failure(const std::string& name, const std::string& message, ExitCode code) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s: error: %s\n", name.c_str(), message.c_str());
  return code;
}

}  // namespace

void warn(const std::string& name, const std::string& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s: warning: %s\n", name.c_str(), message.c_str());
}

int run_program(const std::string& name, const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& error) {
    return failure(name, error.what(), exit_bad_input);
  } catch (const ConvergenceError& error) {
    return failure(name, error.what(), exit_not_converged);
  } catch (const std::bad_alloc&) {
    return failure(name, "out of memory; take a coarser mesh, an iterative linear solver or a larger machine",
                   exit_bad_input);
  } catch (const std::exception& error) {
    return failure(name, std::string("unexpected: ") + error.what(), exit_bad_input);
  } catch (...) {
    return failure(name, "unexpected exception of unknown type", exit_bad_input);
  }
}

}  // namespace fsi
