#include "parallel/whole_order.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/shared_nodes.hpp"

namespace fsi::test {

namespace {

constexpr int whole = 17;

double value(int node, int k) {
  return 10 * node + k + 0.25;
}

/// Scattered; with many processes the last one owns nothing.
int owner(int node) {
  const int size = Communicator::world().size();
  return (node * 7 / 3) % std::max(1, size - (size > 2 ? 1 : 0));
}

TEST(WholeOrder, StretchesHoldTheWholeInItsOrder) {
  const Communicator& world = Communicator::world();
  const NodeShare share = shared_nodes(world, whole, owner);
  const WholeOrder order(share);
  EXPECT_EQ(order.whole(), whole);
  auto values = nodal_array(share, 3, value);
  for (std::size_t i = 0; i < share.owned.size(); ++i)  // copies are not read
    if (share.owned[i] == 0) values[3 * i] = -1;
  const auto stretch = order.to_stretches(values.data(), 3);
  ASSERT_EQ(stretch.size(), 3 * static_cast<std::size_t>(order.count()));
  const auto all = world.gather(stretch);
  ASSERT_EQ(all.size(), 3u * whole);
  for (int a = 0; a < whole; ++a)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(all[static_cast<std::size_t>(3 * a + k)], value(a, k));
}

TEST(WholeOrder, WhatIsReadComesToOwnersAndCopies) {
  const NodeShare share = shared_nodes(Communicator::world(), whole, owner);
  const WholeOrder order(share);
  std::vector<double> stretch;
  for (std::int64_t a = order.first(); a < order.first() + order.count(); ++a)
    for (int k = 0; k < 2; ++k) stretch.push_back(value(static_cast<int>(a), k));
  EXPECT_EQ(order.from_stretches(stretch.data(), 2), nodal_array(share, 2, value));
}

TEST(WholeOrder, OfFewItemsGoesByTheirKeys) {
  const NodeShare share = shared_nodes(Communicator::world(), whole, owner);
  std::vector<std::int64_t> keys;
  for (const int a : share.whole_node) keys.push_back(1000 - 3 * a);  // descending: the last node comes first
  const auto order = WholeOrder::by_keys(Communicator::world(), keys, share.owned);
  const auto values = nodal_array(share, 1, value);
  const auto all = Communicator::world().gather(order.to_stretches(values.data(), 1));
  ASSERT_EQ(all.size(), static_cast<std::size_t>(whole));
  for (int a = 0; a < whole; ++a) EXPECT_EQ(all[static_cast<std::size_t>(a)], value(whole - 1 - a, 0));
}

TEST(WholeOrder, OfNothingIsEmpty) {
  const auto order = WholeOrder::by_keys(Communicator::world(), {}, {});
  EXPECT_EQ(order.whole(), 0);
  EXPECT_TRUE(order.to_stretches(nullptr, 3).empty());
  EXPECT_TRUE(order.from_stretches(nullptr, 3).empty());
}

TEST(WholeOrder, RefusesANodeWithoutOwner) {
  NodeShare share = shared_nodes(Communicator::world(), whole, owner);
  for (std::size_t i = 0; i < share.owned.size(); ++i)
    if (share.whole_node[i] == 5) share.owned[i] = 0;
  EXPECT_THROW(WholeOrder{share}, std::logic_error);
}

}  // namespace

}  // namespace fsi::test
