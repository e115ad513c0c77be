#pragma once

#include <string>

#include "run/stepper_maker.hpp"

namespace fsi {

/// The body of a driver's main(): parses the command line, reads case and mesh, builds the scene, runs the steps,
/// writes the results. Errors become a line on stderr and an exit code (run_program()). \returns the exit code
int run_driver(const std::string& program, const std::string& description, int argc, const char* const* argv,
               const StepperMaker& make_stepper);

}  // namespace fsi
