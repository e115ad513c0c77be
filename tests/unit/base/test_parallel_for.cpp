#include "host/parallel_for.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstddef>
#include <vector>

namespace {

using namespace fsi;

class ParallelFor : public testing::Test {
 protected:
  ~ParallelFor() override { set_threads(before_); }

 private:
  int before_ = threads();
};

TEST_F(ParallelFor, VisitsEachIndexOnceWhateverTheTeam) {
  for (const int team : {1, 2, 3, 4})
    for (const bool shared : {false, true})
      for (const int count : {0, 1, 2, 3, 5, 64, 1001}) {
        set_threads(team);
        std::vector<int> visits(count, 0);
        parallel_for(count, shared, [&](int i) { ++visits[i]; });
        EXPECT_EQ(visits, std::vector<int>(count, 1)) << team << " threads, shared: " << shared;
      }
}

TEST_F(ParallelFor, TakesUnsignedCounts) {
  set_threads(3);
  std::vector<char> visited(10, 0);
  parallel_for(visited.size(), true, [&](std::size_t i) { visited[i] = 1; });
  EXPECT_EQ(visited, std::vector<char>(10, 1));
}

TEST_F(ParallelFor, SharesOnlyWhatIsToBeShared) {
  set_threads(2);
  std::vector<int> team(2);
  parallel_for(2, true, [&](int i) { team[i] = omp_get_num_threads(); });
  EXPECT_EQ(team, (std::vector<int>{2, 2}));
  parallel_for(2, false, [&](int i) { team[i] = omp_get_num_threads(); });
  EXPECT_EQ(team, (std::vector<int>{1, 1}));
}

TEST_F(ParallelFor, EachThreadHasSuccessiveIndices) {
  set_threads(3);
  std::vector<int> thread(10);
  parallel_for(10, true, [&](int i) { thread[i] = omp_get_thread_num(); });
  EXPECT_EQ(thread, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 2, 2, 2}));
}

}  // namespace
