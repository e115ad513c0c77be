/// The main() of tests that several processes run together. The first one prints what GoogleTest prints; the others print
/// their failures alone. An assertion that ends a test of one process (ASSERT_..., an exception) ends all of them, which
/// would wait for it in vain.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "parallel/communicator.hpp"

namespace {

class FailuresOfProcess : public testing::EmptyTestEventListener {
  // GoogleTest does not tell its current test while it reports a failure.
  void OnTestStart(const testing::TestInfo& test) override {
    test_ = std::string(test.test_suite_name()) + "." + test.name();
  }

  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    const fsi::Communicator& processes = fsi::Communicator::world();
    std::fprintf(stderr, "process %d of %d: %s\n%s:%d: %s\n", processes.rank(), processes.size(), test_.c_str(),
                 result.file_name() ? result.file_name() : "?", result.line_number(), result.message());
    if (result.fatally_failed() && !processes.is_alone()) fsi::ProcessGroup::abort(1);
  }

  std::string test_;
};

}  // namespace

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  const fsi::ProcessGroup group;
  const fsi::Communicator& processes = fsi::Communicator::world();
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (!processes.is_first()) delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new FailuresOfProcess);
  return processes.any(RUN_ALL_TESTS() != 0) ? 1 : 0;
}
