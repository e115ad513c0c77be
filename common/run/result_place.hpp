#pragma once

#include "run/command_line.hpp"

namespace fsi {

// Where a run reads and writes. Nothing here changes a file.

/// Whether a run goes on in the folder that it began in.
bool in_place(const CommandLine& line);

/// A run that is going on is no run to continue: its files are of different steps at different moments. \throws InputError
void require_no_run_in_source(const CommandLine& line);

/// Nothing is replaced that the user has not named, whether to be replaced or to be continued. \throws InputError
void require_folder(const CommandLine& line);

/// What to do once a file can be written again.
std::string way_on(const CommandLine& line);

}  // namespace fsi
