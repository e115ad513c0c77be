// How many threads each of several processes takes.
#include <gtest/gtest.h>

#include "run/process_threads.hpp"

namespace fsi::test {
namespace {

constexpr std::size_t large = 1000 * tetrahedra_per_thread;

ThreadChoice choice(int own, int all, int processes, std::size_t cells = large, int asked = 0) {
  return threads_of_process(asked, cells, HostCores{own, all, processes});
}

TEST(ProcessThreads, CoresOfTheHostAreSharedOut) {
  EXPECT_EQ(choice(8, 8, 2).count, 4);
  EXPECT_EQ(choice(8, 8, 3).count, 2);
  EXPECT_EQ(choice(2, 2, 3).count, 1);
  EXPECT_EQ(choice(8, 8, 2).reason, "8 cores for 2 processes on a host; processes are not bound to cores");
}

TEST(ProcessThreads, ABoundProcessTakesItsOwnCores) {
  EXPECT_EQ(choice(3, 8, 2).count, 3);
  EXPECT_EQ(choice(1, 2, 2).reason, "2 cores for 2 processes on a host; the launcher binds each process to 1 core");
}

TEST(ProcessThreads, NoneWithFewCells) {
  EXPECT_EQ(choice(8, 8, 2, 2 * tetrahedra_per_thread + 1).count, 2);
  EXPECT_EQ(choice(8, 8, 2, 0).count, 1);
  EXPECT_TRUE(choice(8, 8, 2, 0).warning.empty());
}

TEST(ProcessThreads, MoreThreadsThanCoresAreWarnedOf) {
  EXPECT_TRUE(choice(2, 4, 2, large, 2).warning.empty());
  EXPECT_TRUE(choice(1, 2, 3, large, 1).warning.empty());  // more processes than cores are another matter
  EXPECT_EQ(choice(1, 4, 2, large, 2).count, 2);
  EXPECT_EQ(
      choice(1, 4, 2, large, 2).warning,
      "2 threads of each process share 1 core, since the launcher binds it there: start the run by mpirun --map-by "
      "slot:PE=2 --bind-to core, or with --threads 1");
  EXPECT_EQ(choice(4, 4, 2, large, 3).warning,
            "3 threads of each process share 2 cores: start fewer processes, or --threads 2");
}

TEST(ProcessThreads, AsAskedWhenAlone) {
  const ThreadChoice alone = threads_of_process(3, large, CoreWatch(), Communicator::alone());
  EXPECT_EQ(alone.count, 3);
  EXPECT_EQ(alone.reason, "as asked");
}

}  // namespace
}  // namespace fsi::test
