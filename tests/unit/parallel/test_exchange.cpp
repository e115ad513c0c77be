/// Owners' values brought to copies and back. Run by 1, 2 and 3 processes.
///
/// A ring of processes: each owns three items and holds copies of the last item of the one before and of the first of the
/// one behind. With two processes both are the same neighbour, with one there is none.
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/exchange.hpp"

namespace fsi {
namespace {

class RingOfProcesses : public testing::Test {
 protected:
  const Communicator& all = Communicator::world();
  const int before = (all.rank() + all.size() - 1) % all.size(), behind = (all.rank() + 1) % all.size();
  const int copies = all.is_alone() ? 0 : 2;

  /// Own items are 0, 1, 2; copies 3 (of `before`) and 4 (of `behind`).
  Exchange exchange() const {
    std::vector<Exchange::Neighbour> neighbours;
    if (all.size() == 2) {
      // Item 2 goes to the other's copy 3, item 0 to its copy 4: what is sent stands in the order of what is received.
      neighbours.push_back({before, {2, 0}, {3, 4}});
    } else if (all.size() > 2) {
      neighbours.push_back({before, {0}, {3}});
      neighbours.push_back({behind, {2}, {4}});
    }
    return {all, neighbours};
  }

  static double value(int rank, int item, int entry) { return 100 * rank + 10 * item + entry; }

  std::vector<double> own_values(int entries) const {
    std::vector<double> values(static_cast<std::size_t>(3 + copies) * entries, -1);
    for (int item = 0; item < 3; ++item)
      for (int e = 0; e < entries; ++e) values[item * entries + e] = value(all.rank(), item, e);
    return values;
  }
};

TEST_F(RingOfProcesses, CopiesGetTheValuesOfTheirOwners) {
  const Exchange ring = exchange();
  for (const int entries : {1, 3}) {
    auto values = own_values(entries), expected = values;
    for (int e = 0; e < entries && copies > 0; ++e) {
      expected[3 * entries + e] = value(before, 2, e);
      expected[4 * entries + e] = value(behind, 0, e);
    }
    ring.update(values, entries);
    EXPECT_EQ(values, expected) << entries;
    ring.update(values, entries);  // once more: nothing new
    EXPECT_EQ(values, expected) << entries;
  }
  EXPECT_EQ(ring.sent_items(), static_cast<std::size_t>(copies));
  EXPECT_EQ(ring.received_items(), static_cast<std::size_t>(copies));
}

TEST_F(RingOfProcesses, OwnersGetWhatStandsInCopies) {
  const Exchange ring = exchange();
  std::vector<double> values(static_cast<std::size_t>(3 + copies) * 2, 0);
  for (int copy = 0; copy < copies; ++copy)
    for (int e = 0; e < 2; ++e) values[(3 + copy) * 2 + e] = value(all.rank(), 3 + copy, e);
  const auto from = ring.from_copies(values, 2);
  ASSERT_EQ(from.size(), ring.neighbours().size());
  if (all.size() == 2) {  // of item 2 its copy 3 at `behind`, of item 0 the copy 4 at `before`
    EXPECT_EQ(from[0], (std::vector<double>{value(behind, 3, 0), value(behind, 3, 1), value(before, 4, 0),
                                            value(before, 4, 1)}));
  } else if (all.size() > 2) {
    EXPECT_EQ(from[0], (std::vector<double>{value(before, 4, 0), value(before, 4, 1)}));
    EXPECT_EQ(from[1], (std::vector<double>{value(behind, 3, 0), value(behind, 3, 1)}));
  }
}

TEST_F(RingOfProcesses, OwnValuesSummedOverCopies) {
  // Each process counts every item that it holds: what owners and copies count together is how many hold an item.
  const Exchange ring = exchange();
  std::vector<double> holders(static_cast<std::size_t>(3 + copies), 1);
  const auto from = ring.from_copies(holders);
  for (std::size_t n = 0; n < from.size(); ++n)
    for (std::size_t i = 0; i < from[n].size(); ++i) holders[ring.neighbours()[n].sent[i]] += from[n][i];
  const double own = std::accumulate(holders.begin(), holders.begin() + 3, 0.0);
  EXPECT_EQ(all.sum(own), all.size() * (3 + copies));
}

TEST_F(RingOfProcesses, FloatsAreBroughtAndAdded) {
  const Exchange ring = exchange();
  std::vector<float> values(static_cast<std::size_t>(3 + copies), static_cast<float>(all.rank() + 1));
  ring.update(values);
  if (copies > 0) {
    EXPECT_EQ(values[3], before + 1);
    EXPECT_EQ(values[4], behind + 1);
  }
  ring.add_from_copies(values);  // items 0 and 2 have one copy each
  const float own = static_cast<float>(all.rank() + 1);
  EXPECT_EQ(values[1], own);
  for (const int item : {0, 2}) EXPECT_EQ(values[item], copies > 0 ? 2 * own : own);
}

TEST_F(RingOfProcesses, RowsOfAnyLengthGoBothWays) {
  const Exchange ring = exchange();
  Exchange::Rows rows(static_cast<std::size_t>(3 + copies));
  for (int item = 0; item < 3; ++item) rows[item].assign(item, 10.0 * all.rank() + item);  // of 0, 1 and 2 numbers
  ring.update_rows(rows);
  if (copies > 0) {
    EXPECT_EQ(rows[3], std::vector<double>(2, 10.0 * before + 2));
    EXPECT_TRUE(rows[4].empty());
  }
  const auto back = ring.rows_from_copies(rows);
  ASSERT_EQ(back.size(), ring.neighbours().size());
  for (std::size_t n = 0; n < back.size(); ++n)
    for (std::size_t i = 0; i < back[n].size(); ++i) EXPECT_EQ(back[n][i], rows[ring.neighbours()[n].sent[i]]);
}

/// Each process has as many items as its number says, the first none, and copies of all others'.
TEST(ShareOfNumbers, FindsOwnersByNumber) {
  const Communicator& all = Communicator::world();
  const int own = all.rank();
  const std::int64_t whole = all.size() * (all.size() - 1) / 2, first = all.sum_before(std::int64_t{own});
  std::vector<std::int64_t> copies;
  for (std::int64_t number = whole - 1; number >= 0; --number)
    if (number < first || number >= first + own) copies.push_back(number);
  const ShareOfNumbers share(all, own, copies);
  EXPECT_EQ(share.first, first);
  EXPECT_EQ(share.items(), whole);
  std::vector<double> values(share.items(), -1);
  for (int item = 0; item < own; ++item) values[item] = 100.0 + static_cast<double>(share.number(item));
  share.exchange.update(values);
  for (int item = 0; item < share.items(); ++item)
    EXPECT_EQ(values[item], 100.0 + static_cast<double>(share.number(item)));
}

TEST_F(RingOfProcesses, MessagesAndBytesAreCounted) {
  const Exchange ring = exchange();
  auto values = own_values(3);
  const Traffic before_update = all.traffic();
  ring.update(values, 3);
  const Traffic now = all.traffic();
  EXPECT_EQ(now.messages - before_update.messages, static_cast<std::int64_t>(ring.neighbours().size()));
  EXPECT_EQ(now.bytes - before_update.bytes, static_cast<std::int64_t>(copies * 3 * sizeof(double)));
  EXPECT_EQ(now.reductions, before_update.reductions);
}

/// A neighbour that only sends, or only receives.
TEST(Exchange, OneWay) {
  const Communicator& all = Communicator::world();
  std::vector<Exchange::Neighbour> neighbours;
  if (all.is_first())
    for (int r = 1; r < all.size(); ++r) neighbours.push_back({r, {0}, {}});
  else
    neighbours.push_back({0, {}, {1}});
  const Exchange from_first(all, neighbours);
  std::vector<double> values{10.0 + all.rank(), -1};
  from_first.update(values);
  EXPECT_EQ(values, (std::vector<double>{10.0 + all.rank(), all.is_first() ? -1 : 10.0}));
}

TEST(Exchange, WithoutNeighboursNothingHappens) {
  std::vector<double> values{1, 2};
  Exchange().update(values);
  EXPECT_EQ(values, (std::vector<double>{1, 2}));
  EXPECT_TRUE(Exchange().from_copies(values).empty());
}

}  // namespace
}  // namespace fsi
