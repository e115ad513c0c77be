#pragma once

#include <filesystem>
#include <string>

namespace fsi {

/// FILE.tmp, the name under which a file is prepared before it replaces FILE.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Puts a finished temporary_name(file) on disk (fsync) and renames it to `file`: after a kill at any moment `file` is
/// either the old or the new one, complete. \throws InputError when the file system refuses
void replace_by_temporary(const std::filesystem::path& file);

/// Replaces a file's contents in that way.
void write_atomically(const std::filesystem::path& file, const std::string& contents);

}  // namespace fsi
