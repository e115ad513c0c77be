#include "host/removed_on_signal.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace fsi {

namespace {

// Fixed storage: a signal handler may neither allocate nor wait for a lock.
struct Place {
  std::atomic<bool> taken{false}, ready{false};
  FilesInside inside = FilesInside::stay;
  char path[PATH_MAX] = {};
};
std::array<Place, 16> places;

std::atomic<int> waiting_for{0};  // number of SignalsWait objects
std::atomic<int> waiting{0};      // the signal held back, 0: none

/// Removes each file of the folder, by system calls: opendir() allocates, which a signal handler may not.
void remove_files_in(const char* folder) noexcept {
  const int descriptor = ::open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  // An entry by getdents64(2): inode and offset, 8 bytes each; length, 2; type, 1; name.
  constexpr std::size_t at_length = 16, at_name = 19;
  alignas(std::uint64_t) std::array<char, 4096> entries;
  for (long count; (count = ::syscall(SYS_getdents64, descriptor, entries.data(), entries.size())) > 0;)
    for (std::size_t at = 0; at < static_cast<std::size_t>(count);) {
      std::uint16_t length = 0;
      std::memcpy(&length, &entries[at + at_length], sizeof length);
      ::unlinkat(descriptor, &entries[at + at_name], 0);  // refuses folders, . and .. among them
      at += length;
    }
  ::close(descriptor);
}

}  // namespace

RemovedOnSignal::RemovedOnSignal(const std::filesystem::path& path, FilesInside inside) noexcept {
  if (path.native().size() >= PATH_MAX) return;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].taken.exchange(true)) continue;
    std::memcpy(places[i].path, path.c_str(), path.native().size() + 1);
    places[i].inside = inside;
    places[i].ready = true;
    place_ = static_cast<int>(i);
    return;
  }
}

RemovedOnSignal::RemovedOnSignal(RemovedOnSignal&& other) noexcept : place_(std::exchange(other.place_, -1)) {}

RemovedOnSignal::~RemovedOnSignal() {
  if (place_ < 0) return;
  Place& place = places[static_cast<std::size_t>(place_)];
  place.ready = false;
  place.taken = false;
}

SignalsWait::SignalsWait() noexcept {
  ++waiting_for;
}

SignalsWait::~SignalsWait() {
  if (--waiting_for > 0) return;
  if (const int signal = waiting.exchange(0); signal != 0) std::raise(signal);
}

bool has_to_wait(int signal) noexcept {
  if (waiting_for == 0) return false;
  waiting = signal;
  return true;
}

void remove_what_a_signal_leaves() noexcept {
  for (std::size_t i = places.size(); i-- > 0;) {
    if (!places[i].ready || ::unlink(places[i].path) == 0) continue;
    if (places[i].inside == FilesInside::go) remove_files_in(places[i].path);
    ::rmdir(places[i].path);
  }
}

}  // namespace fsi
