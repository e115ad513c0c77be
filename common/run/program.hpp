#pragma once

#include <functional>
#include <string>

namespace fsi {

/// Runs the body of a main() with guarded standard streams and turns what it throws into one printable line on stderr,
/// `NAME: error: ...`, and an exit code: InputError 1, ConvergenceError 2, out of memory and anything unexpected 1.
/// Otherwise returns the body's own code. Of several processes (ProcessGroup) that fail alike one speaks; one that fails
/// by itself speaks and ends the others.
int run_program(const std::string& name, const std::function<int()>& body);

/// Prints "NAME: warning: MESSAGE", one printable line, to the standard error stream; the program goes on.
void warn(const std::string& name, const std::string& message);

}  // namespace fsi
