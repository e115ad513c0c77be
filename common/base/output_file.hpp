#pragma once

#include <filesystem>

namespace fsi {

// Programs write regular files only: anything else (folder, device, pipe, socket) is never replaced.

/// The file that is to be written under a name, checked before anything is computed for it. A symbolic link stays; the
/// regular file that it leads to is returned.
/// \throws InputError when there is something other than a regular file, or when the folder is missing or cannot be
///         written
std::filesystem::path regular_output_file(const std::filesystem::path& file);

/// Refuses a file that exists and is not regular. A symbolic link is followed if `follow`, else refused.
/// \throws InputError
void require_regular_or_absent(const std::filesystem::path& file, bool follow);

}  // namespace fsi
