#pragma once

#include <string>
#include <vector>

namespace fsi {

/// The output of `fsi-compare COMMAND FILE ...`, which reads formats that Python's libraries know. Its warnings are
/// repeated.
/// \param words  from the command on
/// \param quiet  no warnings
/// \throws InputError with the first line of the program's errors, about `file`, or if fsi-compare is not beside
///         fsi-mesh
std::string converted(const std::string& file, const std::vector<std::string>& words, bool quiet = false);

/// Repeats an error about the file `said_of` as one about `file`, which the user knows. \throws InputError always
[[noreturn]] void refuse_file(const std::string& file, const std::string& said_of, std::string said);

}  // namespace fsi
