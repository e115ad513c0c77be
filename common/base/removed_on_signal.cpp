#include "base/removed_on_signal.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>
#include <utility>

namespace fsi {

namespace {

// Fixed storage: a signal handler may neither allocate nor wait for a lock.
struct Place {
  std::atomic<bool> taken{false}, ready{false};
  char path[PATH_MAX] = {};
};
std::array<Place, 16> places;

std::atomic<int> waiting_for{0};  // how many SignalsWait live
std::atomic<int> waiting{0};      // the signal that waits, 0: none

}  // namespace

RemovedOnSignal::RemovedOnSignal(const std::filesystem::path& path) noexcept {
  if (path.native().size() >= PATH_MAX) return;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].taken.exchange(true)) continue;
    std::memcpy(places[i].path, path.c_str(), path.native().size() + 1);
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
  for (std::size_t i = places.size(); i-- > 0;)
    if (places[i].ready && ::unlink(places[i].path) != 0) ::rmdir(places[i].path);
}

}  // namespace fsi
