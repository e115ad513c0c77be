#include "driver/interruption.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "base/removed_on_signal.hpp"
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

}  // namespace

}  // namespace fsi::test
