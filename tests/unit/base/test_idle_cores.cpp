#include "host/idle_cores.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace fsi::test {

namespace {

TEST(IdleCores, BusyTicksAreAllButIdleAndWaiting) {
  const auto ticks = busy_ticks(
      "cpu  111 222 333 444 555 6 7 8 0 0\n"
      "cpu0 10 20 30 4000 5000 1 2 3 100 100\n"  // guests are in user already
      "cpu2 1 2 3 4 5 0 0 0 0 0\n"
      "intr 99 1 2\n");
  EXPECT_EQ(ticks, (std::vector<long>{66, -1, 6}));
  EXPECT_TRUE(busy_ticks("").empty());
}

TEST(IdleCores, CgroupLimitIsInWholeCores) {
  EXPECT_EQ(cgroup_cores("max 100000\n"), 0);
  EXPECT_EQ(cgroup_cores(""), 0);
  EXPECT_EQ(cgroup_cores("400000 100000\n"), 4);
  EXPECT_EQ(cgroup_cores("250000 100000\n"), 2);
  EXPECT_EQ(cgroup_cores("50000 100000\n"), 1);
}

TEST(IdleCores, BusyElsewhereLeavesOutThisProcessAndForeignCores) {
  const std::vector<long> before{100, 100, 100, -1}, after{150, 125, 150, 7};
  // In half a second: core 0 all of it, core 1 half of it; this process a quarter of a second of both.
  EXPECT_DOUBLE_EQ(busy_elsewhere(before, after, {0, 1}, 100, 0.25, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(busy_elsewhere(before, after, {0, 1, 2, 3, 4}, 100, 0, 0.5), 2.5);
  EXPECT_EQ(busy_elsewhere(before, before, {0, 1}, 100, 0.01, 0.5), 0);
}

TEST(IdleCores, WatchSeesThisMachine) {
  const CoreUse use = CoreWatch().look();
  EXPECT_GE(use.cores, 1);
  EXPECT_GE(use.busy_elsewhere, 0);
  EXPECT_LE(use.busy_elsewhere, 2 * std::thread::hardware_concurrency());
}

TEST(ThreadChoice, IsWhatIsAsked) {
  EXPECT_EQ(choose_threads(3, 10, CoreUse{2, 2}).count, 3);
  EXPECT_EQ(choose_threads(3, 10, CoreUse{2, 2}).reason, "as asked");
}

TEST(ThreadChoice, LeavesBusyCoresToOthers) {
  const std::size_t large = 1000 * tetrahedra_per_thread;
  EXPECT_EQ(choose_threads(0, large, CoreUse{2, 0.1}).count, 2);
  EXPECT_EQ(choose_threads(0, large, CoreUse{2, 0.1}).reason, "2 cores idle");
  EXPECT_EQ(choose_threads(0, large, CoreUse{2, 0.9}).count, 1);
  EXPECT_EQ(choose_threads(0, large, CoreUse{2, 0.9}).reason, "other jobs keep 1 core of 2 busy");
  EXPECT_EQ(choose_threads(0, large, CoreUse{2, 2.3}).count, 1);
  EXPECT_EQ(choose_threads(0, large, CoreUse{8, 3.2}).count, 5);
}

TEST(ThreadChoice, GivesASmallMeshOneThread) {
  EXPECT_EQ(choose_threads(0, 2 * tetrahedra_per_thread - 1, CoreUse{8, 0}).count, 1);
  EXPECT_EQ(choose_threads(0, 100, CoreUse{8, 0}).reason, "the mesh is too small for more");
  EXPECT_EQ(choose_threads(0, 3 * tetrahedra_per_thread, CoreUse{8, 0}).count, 3);
  EXPECT_EQ(choose_threads(0, 3 * tetrahedra_per_thread, CoreUse{8, 6}).count, 2);
}

}  // namespace

}  // namespace fsi::test
