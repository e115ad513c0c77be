#pragma once

#include <string>

#include "run/stepper_maker.hpp"

namespace fsi {

/// The whole of a driver: parse the command line, read case and mesh, build the scene, march it in time, write the
/// results. Returns the exit code.
int run_driver(const std::string& program, const std::string& description, int argc, const char* const* argv,
               const StepperMaker& make_stepper);

}  // namespace fsi
