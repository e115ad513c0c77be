#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "io/checked_file.hpp"
#include "io/write_error.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

/// Reads up to `size` bytes. \returns how many there were
std::size_t read(int descriptor, char* bytes, std::size_t size, const fs::path& shown_as) {
  std::size_t got = 0;
  while (got < size) {
    const ssize_t n = ::read(descriptor, bytes + got, size - got);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw WriteError(shown_as, "", std::string("reading it back: ") + std::strerror(errno), "check the disk");
    if (n == 0) break;
    got += static_cast<std::size_t>(n);
  }
  return got;
}

void require_contents(const fs::path& temporary, std::string_view contents, const fs::path& shown_as) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  };
  const Descriptor descriptor{::open(temporary.c_str(), O_RDONLY | O_CLOEXEC)};
  if (descriptor.number < 0) throw WriteError(shown_as, errno);
  // Lets the system drop its cached pages, so that the bytes compared come from the disk.
  ::posix_fadvise(descriptor.number, 0, 0, POSIX_FADV_DONTNEED);
  std::vector<char> piece(1 << 20);
  std::size_t got = piece.size();
  while (got == piece.size()) {
    got = read(descriptor.number, piece.data(), piece.size(), shown_as);
    if (got > contents.size() || std::memcmp(piece.data(), contents.data(), got) != 0) break;
    contents.remove_prefix(got);
    if (got < piece.size() && contents.empty()) return;
  }
  throw WriteError(shown_as, "", "reading it back gives other bytes than were written", "check the disk");
}

/// The last steps for a temporary file that is synchronised already.
void rename_temporary(const fs::path& file) {
  require_still_regular(file);
  if (std::rename(temporary_name(file).c_str(), file.c_str()) != 0) throw WriteError(file, errno);
}

}  // namespace

fs::path temporary_name(const fs::path& file) {
  fs::path name = file;
  name += ".tmp";
  return name;
}

void remove_temporary(const fs::path& file) noexcept {
  try {
    ::unlink(temporary_name(file).c_str());
  } catch (...) {  // no memory for the name: there is nothing that could be done
  }
}

void replace_by_temporary(const fs::path& file) {
  try {
    auto temporary = CheckedFile::existing(temporary_name(file), file);
    temporary.synchronise();
    temporary.close();
    rename_temporary(file);
  } catch (...) {
    remove_temporary(file);
    throw;
  }
  synchronise_folder(file.parent_path());
}

void write_atomically(const fs::path& file, std::string_view contents, ReadBack check) {
  try {
    auto temporary = CheckedFile::create_new(temporary_name(file), file);
    temporary.write(contents);
    temporary.synchronise();
    temporary.close();
    if (check == ReadBack::yes) require_contents(temporary_name(file), contents, file);
    rename_temporary(file);
  } catch (...) {
    remove_temporary(file);
    throw;
  }
  synchronise_folder(file.parent_path());
}

}  // namespace fsi
