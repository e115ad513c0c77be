#include "driver/interruption.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>

#include "base/printable.hpp"
#include "base/removed_on_signal.hpp"
#include "base/standard_streams.hpp"

namespace fsi {

namespace {

constexpr std::array<int, 3> watched = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t noted = 0;
volatile std::sig_atomic_t launched = 0;
std::array<char, 512> last_words{};

// Handlers do what they may: set a flag, remove files, write, end the program.

extern "C" void note(int number) {
  if (noted != 0) {
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  noted = number;
}

extern "C" void end_at_once(int number) {
  if (has_to_wait(number)) return;
  remove_what_a_signal_leaves();
  std::size_t length = 0;
  while (length < last_words.size() && last_words[length] != '\0') ++length;
  const bool silent = streams_are_silent() || (launched != 0 && number == SIGTERM);
  if (!silent && ::write(STDERR_FILENO, last_words.data(), length) < 0) {
  }  // there is nobody left to tell
  ::_exit(interrupted_exit_code(number));
}

void watch(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  for (const int number : watched) sigaddset(&action.sa_mask, number);
  action.sa_flags = SA_RESTART;  // no write to a file fails half-way
  for (const int number : watched) {
    struct sigaction before {};
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
}

}  // namespace

void end_at_signals(const std::string& program, const std::string& said) {
  std::snprintf(last_words.data(), last_words.size(), "%s: interrupted%s%s\n", shortened(program, 100).c_str(),
                said.empty() ? "" : " ", shortened(said, 300).c_str());
  watch(end_at_once);
}

void expect_launcher() {
  launched = 1;
}

void note_signals() {
  watch(note);
}

int noted_signal() {
  return noted;
}

}  // namespace fsi
