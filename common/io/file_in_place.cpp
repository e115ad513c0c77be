#include "io/file_in_place.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <utility>

#include "io/write_error.hpp"

namespace fsi {

namespace {

[[noreturn]] void refuse_disturbed(const std::filesystem::path& file, const std::string& what) {
  throw WriteError(file, "", "it has been " + what + " since the run made it",
                   "leave the files of a running computation where they are");
}

}  // namespace

FileInPlace::FileInPlace(std::filesystem::path file) : path_(std::move(file)) {
  struct stat status;
  if (::stat(path_.c_str(), &status) != 0) throw WriteError(path_, errno);
  device_ = status.st_dev;
  number_ = status.st_ino;
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileInPlace::Opened FileInPlace::open() const {
  const int descriptor = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) refuse_disturbed(path_, "deleted or moved");
  if (descriptor < 0) throw WriteError(path_, errno);
  Opened opened(path_, descriptor);
  struct stat status;
  if (::fstat(descriptor, &status) != 0) throw WriteError(path_, errno);
  if (status.st_dev != device_ || status.st_ino != number_) refuse_disturbed(path_, "replaced");
  if (static_cast<std::uint64_t>(status.st_size) != size_) refuse_disturbed(path_, "cut or lengthened");
  return opened;
}

FileInPlace::Opened::Opened(Opened&& other) noexcept
    : path_(other.path_), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileInPlace::Opened::~Opened() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileInPlace::Opened::write(std::uint64_t offset, const void* bytes, std::size_t size) {
  assert(descriptor_ >= 0);
  for (const char* next = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t done = ::pwrite(descriptor_, next, size, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw WriteError(path_, errno);
    if (done == 0) throw WriteError(path_, EIO);
    next += done;
    offset += static_cast<std::uint64_t>(done);
    size -= static_cast<std::size_t>(done);
  }
}

std::string FileInPlace::Opened::read(std::uint64_t offset, std::size_t size) {
  assert(descriptor_ >= 0);
  std::string bytes(size, '\0');
  for (std::size_t have = 0; have < size;) {
    const ssize_t done = ::pread(descriptor_, bytes.data() + have, size - have, static_cast<off_t>(offset + have));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw WriteError(path_, errno);
    if (done == 0) refuse_disturbed(path_, "cut");
    have += static_cast<std::size_t>(done);
  }
  return bytes;
}

void FileInPlace::Opened::sync() {
  while (::fdatasync(descriptor_) != 0) {
    if (errno == EINTR) continue;
    if (errno == EINVAL || errno == ENOTSUP) return;  // a file system that cannot
    throw WriteError(path_, errno);
  }
}

void FileInPlace::Opened::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) throw WriteError(path_, errno);
}

}  // namespace fsi
