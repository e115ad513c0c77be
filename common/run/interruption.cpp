#include "run/interruption.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdio>

#include "base/printable.hpp"
#include "host/child_program.hpp"
#include "host/removed_on_signal.hpp"
#include "host/standard_streams.hpp"
#include "host/stop_request.hpp"
#include "run/console.hpp"

namespace fsi {

namespace {

constexpr std::array<int, 3> watched = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t launched = 0;
using Words = std::array<char, 512>;
Words last_words{};
// The answer to the first signal: one text is being changed while the handler may read the other.
std::array<Words, 2> answers{};
std::atomic<int> answer{-1};  // which of them holds; -1: none

// Handlers do what they may: set a flag, remove files, write, end the program.

void write_words(const Words& words) {
  std::size_t length = 0;
  while (length < words.size() && words[length] != '\0') ++length;
  if (::write(STDERR_FILENO, words.data(), length) < 0) {
  }  // there is nobody left to tell
}

extern "C" void note(int number) {
  if (requested_stop() != 0) {
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  request_stop(number);
  if (const int which = answer; which >= 0 && !streams_are_silent())
    write_words(answers[static_cast<std::size_t>(which)]);
}

extern "C" void end_at_once(int number) {
  if (has_to_wait(number)) return;
  end_child();
  remove_what_a_signal_leaves();
  const bool silent = streams_are_silent() || (launched != 0 && number == SIGTERM);
  if (!silent) write_words(last_words);
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

void answer_signals(const std::string& program, std::optional<double> seconds, bool new_line) {
  const int next = answer == 0 ? 1 : 0;
  const std::string when = seconds ? "within about " + readable_duration(*seconds) : "after the solve in progress";
  Words& words = answers[static_cast<std::size_t>(next)];
  std::snprintf(words.data(), words.size(), "%s%s: ends %s, giving up the step in progress; once more ends now\n",
                new_line ? "\n" : "", shortened(program, 100).c_str(), when.c_str());
  answer = next;
}

int noted_signal() {
  return requested_stop();
}

}  // namespace fsi
