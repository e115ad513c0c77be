#pragma once

#include <string>
#include <vector>

namespace fsi {

/// What `fsi-compare COMMAND FILE ...` prints, which reads formats that Python's libraries know. Its warnings are repeated.
/// \param words  from the command on
/// \param quiet  no warnings
/// \throws InputError saying of `file` what the program says
std::string converted(const std::string& file, const std::vector<std::string>& words, bool quiet = false);

/// What was said of a file, said of the one that the user knows. \throws InputError always
[[noreturn]] void refuse_file(const std::string& file, const std::string& said_of, std::string said);

}  // namespace fsi
