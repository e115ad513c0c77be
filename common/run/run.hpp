#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "host/idle_cores.hpp"
#include "io/folder_lock.hpp"
#include "run/command_line.hpp"
#include "run/stepper_maker.hpp"

namespace fsi {

/// One run: everything from the scene at rest, or a checkpoint, to the last step or a signal.
/// \param watch  of the cores, from the program's start on
/// \param lock   of the result folder; empty at all processes but the first
/// \returns the exit code of the program
/// \throws InputError before anything is written; ConvergenceError for a step or a prestress without solution;
///         WriteError where a result cannot be written
template <int n>
int run_case(const std::string& program, const CommandLine& line, const Case& setup, const StepperMaker& make_stepper,
             const CoreWatch& watch, const std::optional<FolderLock>& lock);

}  // namespace fsi
