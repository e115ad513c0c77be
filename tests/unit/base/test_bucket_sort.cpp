// As std::sort, by a key first.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "base/bucket_sort.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

TEST(BucketSort, SortsAsStdSortDoes) {
  Random random(3);
  for (const std::size_t count : {0, 1, 7, 1000}) {
    std::vector<std::pair<int, int>> entries;
    for (std::size_t i = 0; i < count; ++i)
      entries.emplace_back(static_cast<int>(10 * std::abs(random())), static_cast<int>(100 * random()));
    auto expected = entries;
    std::sort(expected.begin(), expected.end());
    bucket_sort(
        entries, 11, [](const auto& entry) { return entry.first; }, std::less<>());
    EXPECT_EQ(entries, expected);
  }
}

}  // namespace

}  // namespace fsi::test
