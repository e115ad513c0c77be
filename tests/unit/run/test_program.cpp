#include "run/program.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "base/error.hpp"

namespace fsi::test {

namespace {

struct Outcome {
  int code;
  std::string errors;
};

template <class Body>
Outcome outcome_of(Body body) {
  testing::internal::CaptureStderr();
  const int code = run_program("fsi-x", body);
  return {code, testing::internal::GetCapturedStderr()};
}

TEST(Program, ReturnsItsOwnCode) {
  EXPECT_EQ(outcome_of([] { return 0; }).code, 0);
  EXPECT_EQ(outcome_of([] { return 2; }).code, 2);
}

TEST(Program, TurnsExceptionsIntoOneLineAndACode) {
  const auto input = outcome_of([]() -> int { throw InputError("a.toml", "k", "is wrong", "correct it"); });
  EXPECT_EQ(input.code, 1);
  EXPECT_EQ(input.errors, "fsi-x: error: a.toml: k: is wrong; correct it\n");

  const auto convergence = outcome_of([]() -> int { throw ConvergenceError("step 3 failed", "a smaller step"); });
  EXPECT_EQ(convergence.code, 2);
  EXPECT_EQ(convergence.errors, "fsi-x: error: step 3 failed; try a smaller step\n");

  const auto memory = outcome_of([]() -> int { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, 1);
  EXPECT_EQ(memory.errors.rfind("fsi-x: error: out of memory", 0), 0u);

  const auto bug = outcome_of([]() -> int { throw std::logic_error("index"); });
  EXPECT_EQ(bug.code, 1);
  EXPECT_EQ(bug.errors, "fsi-x: error: unexpected: index\n");

  const auto of_the_command_line = outcome_of([]() -> int { throw InputError("fsi-x", "--size", "is wrong", "2"); });
  EXPECT_EQ(of_the_command_line.errors, "fsi-x: error: --size: is wrong; 2\n") << "the name stands there once";

  const auto lines = outcome_of([]() -> int { throw std::runtime_error("one\ntwo\x1b"); });
  EXPECT_EQ(lines.errors, "fsi-x: error: unexpected: one\\ntwo\\x1b\n");

  const auto unknown = outcome_of([]() -> int { throw 3; });
  EXPECT_EQ(unknown.code, 1);
}

}  // namespace

}  // namespace fsi::test
