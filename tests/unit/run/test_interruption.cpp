#include "run/interruption.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "host/child_program.hpp"
#include "host/removed_on_signal.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

/// How a forked process ends that does this: its exit code, or minus the signal.
template <class Body>
int end_of(Body body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

constexpr int all[] = {SIGINT, SIGTERM, SIGHUP};

TEST(Interruption, IsNotedOnce) {
  for (const int number : all) {
    EXPECT_EQ(end_of([&] {
                note_signals();
                if (noted_signal() != 0) return 1;
                std::raise(number);
                return noted_signal();
              }),
              number);
    EXPECT_EQ(end_of([&] {
                note_signals();
                std::raise(SIGINT);
                std::raise(number);
                return 1;
              }),
              -number);
  }
}

TEST(Interruption, EndsAtOnceWithAnExitCodeUnlessIgnored) {
  for (const int number : all) {
    EXPECT_EQ(end_of([&] {
                close(STDERR_FILENO);
                end_at_signals("fsi-x", "early");
                std::raise(number);
                return 1;
              }),
              128 + number);
    EXPECT_EQ(end_of([&] {
                std::signal(number, SIG_IGN);
                end_at_signals("fsi-x", "early");
                note_signals();
                std::raise(number);
                return 10 + noted_signal();
              }),
              10);
  }
}

TEST(Interruption, WaitsForWhatIsBeingMade) {
  EXPECT_EQ(end_of([&]() -> int {
              close(STDERR_FILENO);
              end_at_signals("fsi-x", "");
              const SignalsWait outer;
              { const SignalsWait inner; }
              std::raise(SIGHUP);
              _exit(1);  // still waiting
            }),
            1);
  EXPECT_EQ(end_of([&] {
              close(STDERR_FILENO);
              end_at_signals("fsi-x", "");
              {
                const SignalsWait made;
                std::raise(SIGHUP);
              }
              return 1;
            }),
            129);
}

class SignalAnswer : public FolderTest {
 protected:
  /// What a forked process has written to stderr that does this.
  template <class Body>
  std::string said_by(Body body) {
    const auto file = folder_ / "stderr";
    end_of([&] {
      if (std::freopen(file.c_str(), "w", stderr) == nullptr) return 1;
      body();
      return 0;
    });
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
};

TEST_F(SignalAnswer, ComesAtOnceWithTheLastEstimate) {
  const std::string rest = ", giving up the step in progress; once more ends now\n";
  EXPECT_EQ(said_by([] {
              note_signals();
              answer_signals("fsi-x", {}, false);
              std::raise(SIGINT);
            }),
            "fsi-x: ends after the solve in progress" + rest);
  EXPECT_EQ(said_by([] {
              note_signals();
              answer_signals("fsi-x", {}, true);
              for (const double seconds : {1.0, 75.0}) answer_signals("fsi-x", seconds, true);
              std::raise(SIGTERM);
            }),
            "\nfsi-x: ends within about 1 min 15 s" + rest);
}

TEST_F(SignalAnswer, IsNotGivenUnasked) {
  EXPECT_EQ(said_by([] {
              note_signals();
              std::raise(SIGHUP);
            }),
            "");
}

class RemovedPaths : public FolderTest {};

TEST_F(RemovedPaths, VanishWithTheProcess) {
  const auto made = folder_ / "made", kept = folder_ / "kept", file = made / "file";
  std::filesystem::create_directory(made);
  write_text(file, "");
  write_text(kept, "");
  EXPECT_EQ(end_of([&] {
              close(STDERR_FILENO);
              end_at_signals("fsi-x", "");
              { const RemovedOnSignal no_longer(kept); }
              const RemovedOnSignal folder(made), inside(file);
              std::raise(SIGTERM);
              return 1;
            }),
            143);
  EXPECT_FALSE(std::filesystem::exists(made));
  EXPECT_TRUE(std::filesystem::exists(kept));
}

TEST_F(RemovedPaths, TakeTheirFilesAlongIfTheyMay) {
  const auto own = folder_ / "own", users = folder_ / "users";
  for (const auto& folder : {own, users}) {
    std::filesystem::create_directory(folder);
    // More than the handler reads of a folder at a time.
    for (int i = 0; i < 300; ++i) write_text(folder / ("a file with a long name " + std::to_string(i)), "");
  }
  EXPECT_EQ(end_of([&] {
              close(STDERR_FILENO);
              end_at_signals("fsi-x", "");
              const RemovedOnSignal of_program(own, FilesInside::go), of_user(users);
              std::raise(SIGTERM);
              return 1;
            }),
            143);
  EXPECT_FALSE(std::filesystem::exists(own));
  EXPECT_TRUE(std::filesystem::exists(users / "a file with a long name 299"));
}

TEST_F(RemovedPaths, AreNotMadeAnewByAChild) {
  const auto file = folder_ / "made by the child", began = folder_ / "began";
  EXPECT_EQ(end_of([&] {
              close(STDERR_FILENO);
              end_at_signals("fsi-x", "");
              alarm(100);  // this test's own end where the signal below does not come
              std::thread([&] {
                while (!std::filesystem::exists(began)) std::this_thread::yield();
                kill(getpid(), SIGTERM);
              }).detach();
              run_child({"/bin/sh", "-c", "echo > '" + began.string() + "'; sleep 1; echo > '" + file.string() + "'"});
              return 1;
            }),
            143);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace

}  // namespace fsi::test
