#include "host/child_program.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace fsi {
namespace {

TEST(ChildProgram, EndsWithItsCodeAndWhatItWrote) {
  const ChildEnd end = run_child({"/bin/sh", "-c", "echo said; echo complained >&2; exit 3"});
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.output, "said\n");
  EXPECT_EQ(end.errors, "complained\n");
  EXPECT_EQ(run_child({"/bin/sh", "-c", "kill -9 $$"}).code, 128 + SIGKILL);
}

/// As inherited from a parent that does not wait for its children.
TEST(ChildProgram, FailsWhereItsSignalIsIgnored) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const ChildEnd end = run_child({"/bin/sh", "-c", "exit 3"});
  std::signal(SIGCHLD, before);
  EXPECT_EQ(end.code, 3);
}

}  // namespace
}  // namespace fsi
