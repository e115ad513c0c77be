#pragma once

#include "run/command_line.hpp"

namespace fsi {

// Where a run reads and writes. Nothing here changes a file.

/// Whether a run goes on in the folder that it began in.
bool in_place(const CommandLine& line);

/// Refuses to continue, in another folder, a run that is still going on: its files may be of different steps.
/// \throws InputError
void require_no_run_in_source(const CommandLine& line);

/// Refuses a result folder with results, unless --force or a restart in place allows to replace them, and one with
/// files that are no results. \throws InputError
void require_folder(const CommandLine& line);

/// What to do once a file can be written again.
std::string way_on(const CommandLine& line);

}  // namespace fsi
