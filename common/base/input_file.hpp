#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace fsi {

/// What a program expects of a file that a user names.
struct InputFileKind {
  const char* missing;                 ///< problem where there is nothing: "no such file"
  const char* missing_remedy;          ///< "give the path of a case file"
  const char* remedy;                  ///< for anything but a regular file, and for one that is too large
  std::uint64_t largest = UINT64_MAX;  ///< bytes; no file of the kind has more
};

/// Refuses what cannot be read as a file, before anything opens it: a pipe that nobody writes to would hang, a device
/// may never end, and a file far larger than any of its kind would fill the memory.
/// \throws InputError that names the file
void require_regular_file(const std::filesystem::path& file, const InputFileKind& kind);

/// Takes the byte order mark from the first line of a UTF-8 text, which spreadsheets put there.
void drop_byte_order_mark(std::string& line);

}  // namespace fsi
