#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.hpp"

namespace fsi {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw InputError(file.string(), "", "cannot be written (" + reason + ")",
                   "check the permissions and the free space of the folder");
}

/// Forces what has been written to a file or folder onto the disk.
void synchronise(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags);
  if (descriptor < 0) refuse(path, std::strerror(errno));
  const bool failed = ::fsync(descriptor) != 0 && errno != EINVAL;  // some file systems cannot synchronise folders
  const int reason = errno;
  ::close(descriptor);
  if (failed) refuse(path, std::strerror(reason));
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file) {
  std::filesystem::path name = file;
  name += ".tmp";
  return name;
}

void replace_by_temporary(const std::filesystem::path& file) {
  const auto temporary = temporary_name(file);
  synchronise(temporary, O_RDONLY);
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) refuse(file, error.message());
  const auto folder = file.parent_path();
  synchronise(folder.empty() ? std::filesystem::path(".") : folder, O_RDONLY | O_DIRECTORY);
}

void write_atomically(const std::filesystem::path& file, const std::string& contents) {
  const auto temporary = temporary_name(file);
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  if (!stream) refuse(temporary, std::strerror(errno));
  stream << contents;
  stream.close();
  if (!stream) refuse(temporary, std::strerror(errno));
  replace_by_temporary(file);
}

}  // namespace fsi
