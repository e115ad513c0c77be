#include "driver/interruption.hpp"

#include <array>
#include <csignal>

namespace fsi {

namespace {

constexpr std::array<int, 2> watched = {SIGINT, SIGTERM};
volatile std::sig_atomic_t came = 0;

/// Does what a handler may do: sets a flag, or gives way to the default action.
extern "C" void note(int number) {
  if (came != 0) {
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  came = number;
}

}  // namespace

Interruption::Interruption() {
  came = 0;
  for (const int number : watched) {
    struct sigaction before {};
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = note;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;  // no write to a file fails half-way
    sigaction(number, &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (const int number : watched) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler == note) std::signal(number, SIG_DFL);
  }
}

int Interruption::signal() {
  return came;
}

}  // namespace fsi
