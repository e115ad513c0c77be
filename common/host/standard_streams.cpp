#include "host/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"

namespace fsi {

namespace {

volatile std::sig_atomic_t silent_now = 0;

}  // namespace

void keep_streams_silent(bool silent) noexcept {
  silent_now = silent ? 1 : 0;
}

bool streams_are_silent() noexcept {
  return silent_now != 0;
}

void guard_standard_streams() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // open() returns the lowest free descriptor, which is this one. In the wrong mode on purpose: as with a closed
    // descriptor, reading the input and writing the outputs fail with EBADF.
    const int taken = ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (taken >= 0 && taken != descriptor) ::close(taken);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool nobody_reads(int error) {
  return error == EPIPE || error == EBADF;
}

int try_to_print(const std::string& text) {
  if (streams_are_silent()) return 0;
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (std::fflush(stdout) == 0 && written) return 0;
  return errno != 0 ? errno : EIO;
}

void print(const std::string& text) {
  if (const int error = try_to_print(text); error != 0)
    throw InputError("standard output", "", std::string("cannot be written (") + std::strerror(error) + ")",
                     "let it go to a terminal, a pipe that is read, or a disk with space");
}

void print_error(const char* line) noexcept {
  if (streams_are_silent()) return;
  std::fflush(stdout);
  std::size_t left = std::strlen(line);
  while (left > 0) {
    const ssize_t written = ::write(STDERR_FILENO, line, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    line += written;
    left -= static_cast<std::size_t>(written);
  }
}

}  // namespace fsi
