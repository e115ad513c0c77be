#pragma once

#include <string>

#include "case/case.hpp"
#include "host/idle_cores.hpp"
#include "run/command_line.hpp"
#include "run/stepper_maker.hpp"

namespace fsi {

/// --check: reads case and mesh as a run would, builds the scene, tries a step, and prints what a run would be: media, layers,
/// openings, supports, samples, unknowns, steps, memory and seconds. Writes no file. A prestress that has to be found is
/// found only for a small wall; without it no step is tried.
/// \returns the exit code: 0, also where the step tried finds no solution, which is said
/// \throws InputError where a run would refuse case or mesh; ConvergenceError where the prestress is not found
template <int n>
int check_case(const std::string& program, const CommandLine& line, const Case& setup, const StepperMaker& make_stepper,
               const CoreWatch& watch);

}  // namespace fsi
