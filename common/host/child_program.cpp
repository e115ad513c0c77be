#include "host/child_program.hpp"

#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "base/error.hpp"
#include "host/removed_on_signal.hpp"

namespace fsi {

namespace {

std::atomic<pid_t> running{0};  // the child, 0: none

/// A pipe whose ends are closed with it. \throws InputError when it cannot be made
class Pipe {
 public:
  Pipe() {
    if (::pipe(ends_.data()) != 0) throw InputError("pipe", "", std::strerror(errno), "close other programs");
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int end(int which) const { return ends_[which]; }
  void close_end(int which) {
    if (ends_[which] >= 0) ::close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// Ignored signals are inherited: where SIGCHLD is one, the system throws the status of children away.
void keep_status_of_children() {
  struct sigaction action {};
  if (::sigaction(SIGCHLD, nullptr, &action) != 0) return;
  if (action.sa_handler == SIG_IGN) ::signal(SIGCHLD, SIG_DFL);
}

pid_t start(const std::vector<std::string>& words, const posix_spawn_file_actions_t& actions) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (auto& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  keep_status_of_children();
  const SignalsWait until_it_is_known;
  pid_t child = 0;
  const int failure = ::posix_spawn(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
  if (failure != 0)
    throw InputError(words.front(), "", std::string("cannot be started (") + std::strerror(failure) + ")",
                     "check its permissions");
  running = child;
  return child;
}

/// Waits for the child's status. Its process id stays its own until the status is taken, so that end_child() never
/// signals another process.
int status_of(pid_t child) {
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  running = 0;
  int status = -1;  // no success, should it be lost
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Reads both pipes until the child has closed them.
void read_all(Pipe& first, std::string& text_of_first, Pipe& second, std::string& text_of_second) {
  std::array<pollfd, 2> waiting{{{first.end(0), POLLIN, 0}, {second.end(0), POLLIN, 0}}};
  const std::array<std::string*, 2> texts{&text_of_first, &text_of_second};
  int open = 2;
  while (open > 0) {
    if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
    for (std::size_t i = 0; i < 2; ++i) {
      if (waiting[i].fd < 0 || waiting[i].revents == 0) continue;
      std::array<char, 4096> block;
      const auto count = ::read(waiting[i].fd, block.data(), block.size());
      if (count > 0) {
        texts[i]->append(block.data(), static_cast<std::size_t>(count));
      } else if (count == 0 || errno != EINTR) {
        waiting[i].fd = -1;
        --open;
      }
    }
  }
}

}  // namespace

std::filesystem::path beside_this_program(const std::string& name) {
  std::error_code error;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto path = here.parent_path() / name;
  return !error && std::filesystem::is_regular_file(path, error) ? path : std::filesystem::path();
}

ChildEnd run_child(const std::vector<std::string>& words) {
  Pipe output, errors;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const auto& [pipe, descriptor] : {std::pair{&output, STDOUT_FILENO}, std::pair{&errors, STDERR_FILENO}}) {
    posix_spawn_file_actions_adddup2(&actions, pipe->end(1), descriptor);
    posix_spawn_file_actions_addclose(&actions, pipe->end(0));
  }
  pid_t child = 0;
  try {
    child = start(words, actions);
  } catch (...) {
    posix_spawn_file_actions_destroy(&actions);
    throw;
  }
  posix_spawn_file_actions_destroy(&actions);
  output.close_end(1);
  errors.close_end(1);
  ChildEnd end;
  read_all(output, end.output, errors, end.errors);
  const int status = status_of(child);
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return end;
}

void end_child() noexcept {
  const pid_t child = running.exchange(0);
  if (child == 0) return;
  constexpr int tries = 100, pause_ms = 50;
  ::kill(child, SIGTERM);
  for (int i = 0; i < tries; ++i) {
    if (::waitpid(child, nullptr, WNOHANG) != 0) return;  // it has ended, or another thread has taken its status
    ::poll(nullptr, 0, pause_ms);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

}  // namespace fsi
