#include "io/write_error.hpp"

#include <cerrno>
#include <system_error>

namespace fsi {

namespace {

std::string reason_of(int number) {
  return number == 0 ? "unknown reason" : std::generic_category().message(number);
}

std::string remedy_for(int number) {
  switch (number) {
    case ENOSPC:
    case EDQUOT:
      return "free some disk space";
    case EFBIG:
      return "raise the limit on the size of files (ulimit -f)";
    case ENOENT:
    case ENOTDIR:
    case ESTALE:
      return "leave the files of a running computation where they are";
    case EACCES:
    case EPERM:
    case EROFS:
      return "make the folder one that you may write";
    default:
      return "check the disk and the free space of the folder";
  }
}

}  // namespace

WriteError::WriteError(std::filesystem::path file, int number, const std::string& key)
    : WriteError(std::move(file), key, reason_of(number), remedy_for(number)) {}

WriteError::WriteError(std::filesystem::path file, const std::string& key, const std::string& reason,
                       const std::string& remedy)
    : InputError(file.string(), key, "cannot be written (" + reason + ")", remedy),
      file_(std::move(file)),
      key_(key),
      reason_(reason),
      remedy_(remedy) {}

WriteError WriteError::then(const std::string& what) const {
  return {file_, key_, reason_, remedy_ + ", then " + what};
}

}  // namespace fsi
