#pragma once

namespace fsi {

/// Whether all processes of the program end with this same exit code: they all call this to say so within so many seconds.
/// Then they can end in order; else one of them knows of something that the others do not, who go on and may wait for it in
/// vain. True at once for a process that is alone.
bool all_end_with(int exit_code, double seconds);

}  // namespace fsi
