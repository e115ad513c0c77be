/// What all processes hear when each says something. Run by 1, 2 and 3 processes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {
namespace {

const Communicator& all() {
  return Communicator::world();
}

TEST(Communicator, RanksAreCountedFromZero) {
  EXPECT_GE(all().rank(), 0);
  EXPECT_LT(all().rank(), all().size());
  EXPECT_EQ(all().is_first(), all().rank() == 0);
  EXPECT_EQ(all().is_alone(), all().size() == 1);
  EXPECT_EQ(all().sum(std::int64_t{1}), all().size());
}

TEST(Communicator, OneByItselfHearsOnlyItself) {
  EXPECT_TRUE(Communicator::alone().is_alone());
  EXPECT_EQ(Communicator::alone().sum(0.1 * all().rank()), 0.1 * all().rank());
  EXPECT_EQ(Communicator::alone().sum_before(7), 0);
  EXPECT_EQ(Communicator::alone().gather(2.5), std::vector<double>{2.5});
}

/// 0.1 + 0.2 + 0.3 in this order is not 0.3 + 0.2 + 0.1 in the last bit.
TEST(Communicator, SumsGoInTheOrderOfProcesses) {
  const auto said_by = [](int rank) { return 0.1 * (rank + 1); };
  double expected = 0;
  for (int r = 0; r < all().size(); ++r) expected += said_by(r);
  EXPECT_EQ(all().sum(said_by(all().rank())), expected);

  std::vector<double> several{said_by(all().rank()), 1e16 * (all().rank() == 0 ? 1 : -1), 1.0};
  double cancelled = 0;
  for (int r = 0; r < all().size(); ++r) cancelled += 1e16 * (r == 0 ? 1 : -1);
  all().sum(several);
  EXPECT_EQ(several, (std::vector<double>{expected, cancelled, static_cast<double>(all().size())}));

  all().sum(nullptr, 0);  // nothing is summed, nothing is read
}

TEST(Communicator, WholeNumbersAreSummedExactly) {
  const std::int64_t large = std::int64_t{1} << 60;  // no double in between
  EXPECT_EQ(all().sum(all().rank() == 0 ? large + 1 : 0), large + 1);
}

TEST(Communicator, SmallestAndLargest) {
  const double mine = all().rank() - 1.5;
  EXPECT_EQ(all().smallest(mine), -1.5);
  EXPECT_EQ(all().largest(mine), all().size() - 2.5);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(all().smallest(infinity), infinity);
  EXPECT_EQ(all().largest(-infinity), -infinity);
}

/// Wherever it stands: before, among and behind what is smaller.
TEST(Communicator, NotANumberIsNeverOverheard) {
  for (int r = 0; r < all().size(); ++r) {
    const double mine = all().rank() == r ? std::nan("") : -static_cast<double>(all().rank());
    EXPECT_TRUE(std::isnan(all().smallest(mine))) << r;
    EXPECT_TRUE(std::isnan(all().largest(mine))) << r;
    EXPECT_TRUE(std::isnan(all().sum(mine))) << r;
  }
}

TEST(Communicator, AnyIsTrueIfOneIs) {
  EXPECT_FALSE(all().any(false));
  for (int r = 0; r < all().size(); ++r) EXPECT_TRUE(all().any(all().rank() == r)) << r;
}

TEST(Communicator, SumBeforeNumbersThroughAll) {
  // 0, 10, 20, ... of the processes 0, 1, 2, ...
  const std::int64_t r = all().rank();
  EXPECT_EQ(all().sum_before(10 * r), 10 * r * (r - 1) / 2);
}

TEST(Communicator, GatherKeepsTheOrderAndAnyLength) {
  std::vector<double> numbers;
  std::vector<int> ints;
  std::vector<std::int64_t> longs;
  for (int r = 0; r < all().size(); ++r) numbers.push_back(r + 0.5);
  EXPECT_EQ(all().gather(all().rank() + 0.5), numbers);

  // Process r gives r entries, the first one none.
  ints.clear();
  for (int r = 0; r < all().size(); ++r)
    for (int i = 0; i < r; ++i) ints.push_back(10 * r + i), longs.push_back((std::int64_t{1} << 40) + 10 * r + i);
  std::vector<int> mine;
  std::vector<std::int64_t> my_longs;
  std::vector<double> my_numbers;
  for (int i = 0; i < all().rank(); ++i) {
    mine.push_back(10 * all().rank() + i);
    my_longs.push_back((std::int64_t{1} << 40) + mine.back());
    my_numbers.push_back(mine.back());
  }
  EXPECT_EQ(all().gather(mine), ints);
  EXPECT_EQ(all().gather(my_longs), longs);
  EXPECT_EQ(all().gather(my_numbers), std::vector<double>(ints.begin(), ints.end()));
  EXPECT_EQ(all().gather_at_first(my_numbers),
            all().is_first() ? std::vector<double>(ints.begin(), ints.end()) : std::vector<double>{});
}

TEST(Communicator, TheFirstIsHeardByAll) {
  std::string text = all().is_first() ? std::string("a\0b", 3) : "something longer";
  all().broadcast(text);
  EXPECT_EQ(text, std::string("a\0b", 3));
  std::vector<double> numbers(static_cast<std::size_t>(all().is_first() ? 2 : 5), all().is_first() ? 0.25 : 1);
  all().broadcast(numbers);
  EXPECT_EQ(numbers, std::vector<double>(2, 0.25));
  std::int64_t number = all().is_first() ? -3 : 8;
  all().broadcast(number);
  EXPECT_EQ(number, -3);
  std::string nothing = all().is_first() ? "" : "x";
  all().broadcast(nothing);
  EXPECT_EQ(nothing, "");
}

TEST(Communicator, EachGetsWhatIsMeantForIt) {
  // Process r sends r + s numbers 100 r + s to process s.
  std::vector<std::vector<double>> to_each, expected;
  const int r = all().rank();
  for (int s = 0; s < all().size(); ++s) {
    to_each.emplace_back(static_cast<std::size_t>(r + s), 100.0 * r + s);
    expected.emplace_back(static_cast<std::size_t>(r + s), 100.0 * s + r);
  }
  EXPECT_EQ(all().send_and_receive(to_each), expected);
}

TEST(Communicator, TrafficIsCounted) {
  const Traffic before = all().traffic();
  all().sum(1.0);
  std::vector<std::vector<double>> to_each(static_cast<std::size_t>(all().size()), std::vector<double>(4, 1.0));
  all().send_and_receive(to_each);
  const Traffic now = all().traffic();
  EXPECT_EQ(now.reductions - before.reductions, all().is_alone() ? 0 : 1);
  EXPECT_EQ(now.messages - before.messages, all().size() - 1);
  EXPECT_EQ(now.bytes - before.bytes, 32 * (all().size() - 1));
}

}  // namespace
}  // namespace fsi
