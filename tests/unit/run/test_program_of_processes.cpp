#include <gtest/gtest.h>

#include <string>

#include "host/available_memory.hpp"
#include "host/standard_streams.hpp"
#include "io/first_process.hpp"
#include "parallel/communicator.hpp"
#include "run/program.hpp"

namespace fsi::test {

namespace {

TEST(ProgramOfProcesses, SaysOnceThatMemoryRanOut) {
  const Communicator& processes = Communicator::world();
  keep_streams_silent(!processes.is_first());
  testing::internal::CaptureStderr();
  const int code = run_program("fsi-x", [&]() -> int {
    do_together(processes, [&] {
      if (processes.rank() == 1) throw OutOfMemory("7 GiB asked");
    });
    return 0;
  });
  const std::string said = testing::internal::GetCapturedStderr();
  keep_streams_silent(false);
  EXPECT_EQ(code, 1);
  EXPECT_EQ(said.substr(0, 29), processes.is_first() ? "fsi-x: error: out of memory (" : "") << said;
}

}  // namespace

}  // namespace fsi::test
