#include "run/process_threads.hpp"

#include <gtest/gtest.h>

namespace fsi::test {

namespace {

constexpr std::size_t large = 100 * tetrahedra_per_thread;

TEST(ProcessThreads, ShareTheCoresOfTheirHost) {
  EXPECT_EQ(part_of_cores(8, 2, large).count, 4);
  EXPECT_EQ(part_of_cores(8, 3, large).count, 2);
  EXPECT_EQ(part_of_cores(2, 3, large).count, 1);
  EXPECT_EQ(part_of_cores(8, 2, large).reason, "8 cores for 2 processes on a host");
}

TEST(ProcessThreads, AreNoMoreThanTheCellsAreWorth) {
  EXPECT_EQ(part_of_cores(8, 2, 2 * tetrahedra_per_thread + 1).count, 2);
  EXPECT_EQ(part_of_cores(8, 2, 0).count, 1);
}

TEST(ProcessThreads, AreThoseAskedFor) {
  const ThreadChoice choice = threads_of_process(3, large, CoreWatch(), Communicator::alone());
  EXPECT_EQ(choice.count, 3);
  EXPECT_EQ(choice.reason, "as asked");
}

}  // namespace

}  // namespace fsi::test
