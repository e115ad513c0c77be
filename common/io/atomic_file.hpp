#pragma once

#include <filesystem>
#include <string_view>

namespace fsi {

/// FILE.tmp, the name under which a file is prepared before it replaces FILE.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Puts a finished temporary_name(file) on disk (fsync) and renames it to `file`: after a kill at any moment `file` is
/// either the old or the new one, complete. If one of the two fails, the temporary file is removed and the old one
/// stays.
/// \throws WriteError when the file system refuses, or when `file` is anything but a regular file
void replace_by_temporary(const std::filesystem::path& file);

/// Removes temporary_name(file) if it exists: after an error while it was made.
void remove_temporary(const std::filesystem::path& file) noexcept;

enum class ReadBack { no, yes };

/// Replaces a file's contents by temporary file and rename, as replace_by_temporary().
/// \param check  yes: the file is read back, from the disk if the system allows it, and compared with `contents` before
///               it replaces the old one
/// \throws WriteError as replace_by_temporary, and when other bytes are read
void write_atomically(const std::filesystem::path& file, std::string_view contents, ReadBack check = ReadBack::no);

}  // namespace fsi
