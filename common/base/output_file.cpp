#include "base/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "base/error.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

const char* name_of(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::symlink:
      return "a symbolic link";
    case fs::file_type::block:
    case fs::file_type::character:
      return "a device";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    default:
      return "no regular file";
  }
}

}  // namespace

void require_regular_or_absent(const fs::path& file, bool follow) {
  std::error_code error;
  const auto own = fs::symlink_status(file, error);
  if (own.type() == fs::file_type::not_found) return;
  const bool linked = own.type() == fs::file_type::symlink;
  const auto type = linked && follow ? fs::status(file, error).type() : own.type();
  if (type == fs::file_type::regular) return;
  if (linked && type == fs::file_type::not_found)
    throw InputError(file.string(), "", "is a symbolic link to nothing", "remove it, or give another name");
  if (type == fs::file_type::none || type == fs::file_type::unknown)
    throw InputError(file.string(), "", "cannot be looked at (" + error.message() + ")", "give another name");
  throw InputError(file.string(), "", std::string("is ") + name_of(type) + (linked && follow ? ", by a link" : ""),
                   "give the name of a regular file, or of one that does not exist");
}

fs::path regular_output_file(const fs::path& file) {
  if (!file.has_filename()) throw InputError(file.string(), "", "is a folder", "give the name of a file");
  require_regular_or_absent(file, true);
  std::error_code error;
  fs::path place = file;
  if (fs::symlink_status(file, error).type() == fs::file_type::symlink) {
    place = fs::canonical(file, error);
    if (error)
      throw InputError(file.string(), "", "cannot be looked at (" + error.message() + ")", "give another name");
  }
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    throw InputError(file.string(), "", "there is no folder " + folder.string(), "make it first");
  if (::access(folder.c_str(), W_OK) != 0)
    throw InputError(file.string(), "",
                     "the folder " + folder.string() + " cannot be written (" + std::strerror(errno) + ")",
                     "choose another place");
  return place;
}

}  // namespace fsi
