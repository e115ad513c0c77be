#include "io/checked_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "io/write_error.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

constexpr mode_t everybody_but_the_mask = 0666;

[[noreturn]] void refuse_irregular(const fs::path& file) {
  throw WriteError(file, "", "it is no regular file", "remove it or give another name");
}

/// Some file systems cannot synchronise folders, or anything: then there is nothing to wait for.
bool means_not_supported(int number) {
  return number == EINVAL || number == ENOTSUP;
}

/// 0 or errno.
int synchronise_descriptor(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno == EINTR) continue;
    return means_not_supported(errno) ? 0 : errno;
  }
  return 0;
}

/// 0 or errno. Linux has closed the descriptor whatever the result; an interruption loses nothing.
int close_descriptor(int descriptor) {
  return ::close(descriptor) == 0 || errno == EINTR ? 0 : errno;
}

int open_descriptor(const fs::path& file, int flags, const fs::path& shown_as) {
  for (;;) {
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, everybody_but_the_mask);
    if (descriptor >= 0) return descriptor;
    if (errno != EINTR) throw WriteError(shown_as, errno);
  }
}

/// Opens a regular file for writing at its end. Does not wait for the reader of a pipe.
int open_regular(const fs::path& file) {
  require_still_regular(file);
  return open_descriptor(file, O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK, file);
}

}  // namespace

void require_still_regular(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) refuse_irregular(file);
}

void synchronise_folder(const fs::path& folder) {
  const fs::path named = folder.empty() ? fs::path(".") : folder;
  const int descriptor = open_descriptor(named, O_RDONLY | O_DIRECTORY, named);
  const int synchronised = synchronise_descriptor(descriptor);
  const int closed = close_descriptor(descriptor);
  if (synchronised != 0 || closed != 0) throw WriteError(named, synchronised != 0 ? synchronised : closed);
}

// Delegates, so that a failure here finds an object whose destructor closes the descriptor.
CheckedFile::CheckedFile(fs::path shown_as, int descriptor) : CheckedFile() {
  path_ = std::move(shown_as);
  descriptor_ = descriptor;
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail(errno);
  if (!S_ISREG(status.st_mode)) refuse_irregular(path_);
  size_ = static_cast<std::uint64_t>(status.st_size);
}

CheckedFile CheckedFile::create(const fs::path& file) {
  CheckedFile created(file, open_regular(file));
  while (::ftruncate(created.descriptor_, 0) != 0)
    if (errno != EINTR) created.fail(errno);
  created.size_ = 0;
  return created;
}

CheckedFile CheckedFile::append(const fs::path& file) {
  return {file, open_regular(file)};
}

CheckedFile CheckedFile::existing(const fs::path& file, const fs::path& shown_as) {
  return {shown_as, open_descriptor(file, O_WRONLY | O_APPEND | O_NONBLOCK, shown_as)};
}

CheckedFile CheckedFile::create_new(const fs::path& file, const fs::path& shown_as) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) throw WriteError(file, errno);
  return {shown_as, open_descriptor(file, O_WRONLY | O_CREAT | O_EXCL, shown_as)};
}

CheckedFile::~CheckedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

CheckedFile::CheckedFile(CheckedFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

CheckedFile& CheckedFile::operator=(CheckedFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

void CheckedFile::fail(int number) const {
  throw WriteError(path_, number);
}

void CheckedFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    if (written == 0) fail(EIO);  // nothing written without an error: not to be tried for ever
    size_ += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void CheckedFile::require_in_place() const {
  struct stat here {
  }, named{};
  if (::fstat(descriptor_, &here) != 0) fail(errno);
  if (::stat(path_.c_str(), &named) != 0 || here.st_dev != named.st_dev || here.st_ino != named.st_ino)
    throw WriteError(path_, "", "it has been deleted, moved or replaced since it was opened",
                     "leave the files of a running computation where they are");
}

void CheckedFile::require_undisturbed() const {
  require_in_place();
  struct stat here {};
  if (::fstat(descriptor_, &here) != 0) fail(errno);
  if (static_cast<std::uint64_t>(here.st_size) != size_)
    throw WriteError(path_, "",
                     fmt::format("it has {} bytes, not {}: something else writes to it", here.st_size, size_),
                     "leave the files of a running computation alone");
}

void CheckedFile::cut_to(std::uint64_t size) noexcept {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) == 0) size_ = size;
}

void CheckedFile::synchronise() {
  if (const int number = synchronise_descriptor(descriptor_)) fail(number);
}

void CheckedFile::close() {
  if (descriptor_ < 0) return;
  if (const int number = close_descriptor(std::exchange(descriptor_, -1))) fail(number);
}

}  // namespace fsi
