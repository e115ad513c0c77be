/// Nodes of a graph shared out among processes. Run by 1, 2 and 3 processes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/even_stretch.hpp"
#include "parallel/graph_partition.hpp"

namespace fsi {
namespace {

struct Graph {
  std::vector<int> offsets{0}, columns;
};

/// Neighbours of each node, itself among them as in the graphs of matrices.
template <class Joined>
Graph graph(int nodes, const Joined& joined) {
  Graph result;
  for (int a = 0; a < nodes; ++a) {
    for (int b = 0; b < nodes; ++b)
      if (a == b || joined(a, b)) result.columns.push_back(b);
    result.offsets.push_back(static_cast<int>(result.columns.size()));
  }
  return result;
}

/// `side` x `side` nodes, each joined to those left and right, above and below.
Graph square(int side) {
  return graph(side * side,
               [side](int a, int b) { return std::abs(a / side - b / side) + std::abs(a % side - b % side) == 1; });
}

/// Of a graph that all processes have: each hands over its stretch.
std::vector<int> partition(const Graph& g, const std::vector<int>& weights) {
  const EvenStretch mine(static_cast<std::int64_t>(weights.size()), Communicator::world());
  Graph here;
  for (auto a = static_cast<std::size_t>(mine.first); a < static_cast<std::size_t>(mine.last); ++a) {
    here.columns.insert(here.columns.end(), g.columns.begin() + g.offsets[a], g.columns.begin() + g.offsets[a + 1]);
    here.offsets.push_back(static_cast<int>(here.columns.size()));
  }
  return partition_of_graph(here.offsets, here.columns, {weights.begin() + mine.first, weights.begin() + mine.last},
                            Communicator::world());
}

/// Weight of each process's part.
std::vector<int> shares(const std::vector<int>& owners, const std::vector<int>& weights) {
  std::vector<int> result(static_cast<std::size_t>(Communicator::world().size()), 0);
  for (std::size_t a = 0; a < owners.size(); ++a) result.at(static_cast<std::size_t>(owners[a])) += weights[a];
  return result;
}

void expect_balanced(const std::vector<int>& owners, const std::vector<int>& weights) {
  const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / Communicator::world().size();
  for (const int share : shares(owners, weights)) EXPECT_NEAR(share, mean, 0.1 * mean);
}

int cut_edges(const Graph& g, const std::vector<int>& owners) {
  int cut = 0;
  for (std::size_t a = 0; a < owners.size(); ++a)
    for (int at = g.offsets[a]; at < g.offsets[a + 1]; ++at) cut += owners[a] != owners[g.columns[at]];
  return cut / 2;
}

/// Every process tells what it got, as one list.
void expect_same_everywhere(const std::vector<int>& owners) {
  const std::vector<int> everyones = Communicator::world().gather(owners);
  for (std::size_t at = 0; at < everyones.size(); ++at) EXPECT_EQ(everyones[at], owners[at % owners.size()]);
}

TEST(GraphPartition, SquareIsCutWhereItIsShort) {
  const Graph g = square(30);
  const std::vector<int> weights(900, 1);
  const auto owners = partition(g, weights);
  ASSERT_EQ(owners.size(), weights.size());
  expect_balanced(owners, weights);
  expect_same_everywhere(owners);
  // Straight cuts have 30 edges each; the heuristic's may be half as long again.
  EXPECT_LE(cut_edges(g, owners), 45 * (Communicator::world().size() - 1));
}

TEST(GraphPartition, TheSameAnswerAgain) {
  const Graph g = square(24);
  std::vector<int> weights(576);
  for (int a = 0; a < 576; ++a) weights[a] = 1 + a % 5;
  const auto owners = partition(g, weights);
  EXPECT_EQ(partition(g, weights), owners);
  partition(square(7), std::vector<int>(49, 1));  // what another graph left behind does not matter
  EXPECT_EQ(partition(g, weights), owners);
}

/// The upper half of the square weighs four times the lower one: parts are even by weight, not by number.
TEST(GraphPartition, WeightsAreBalanced) {
  const Graph g = square(30);
  std::vector<int> weights(900, 1);
  std::fill_n(weights.begin(), 450, 4);
  expect_balanced(partition(g, weights), weights);
}

TEST(GraphPartition, PartsThatNothingJoins) {
  // Two squares of 15 x 15 nodes without an edge between them, and 30 nodes by themselves.
  const int side = 15, nodes = 2 * side * side;
  const Graph g = graph(nodes + 30, [=](int a, int b) {
    if (a >= nodes || b >= nodes || a / (side * side) != b / (side * side)) return false;
    a %= side * side, b %= side * side;
    return std::abs(a / side - b / side) + std::abs(a % side - b % side) == 1;
  });
  const std::vector<int> weights(static_cast<std::size_t>(nodes) + 30, 1);
  const auto owners = partition(g, weights);
  expect_balanced(owners, weights);
  expect_same_everywhere(owners);
}

/// Fewer nodes than processes: every node has an owner, some processes have nothing.
TEST(GraphPartition, ProcessesMayBeEmpty) {
  for (int nodes = 1; nodes <= 4; ++nodes) {
    const Graph line = graph(nodes, [](int a, int b) { return std::abs(a - b) == 1; });
    const auto owners = partition(line, std::vector<int>(static_cast<std::size_t>(nodes), 1));
    ASSERT_EQ(static_cast<int>(owners.size()), nodes);
    for (const int owner : owners) {
      EXPECT_GE(owner, 0);
      EXPECT_LT(owner, Communicator::world().size());
    }
    expect_same_everywhere(owners);
  }
}

TEST(GraphPartition, OneProcessOwnsAll) {
  const Graph g = square(3);
  EXPECT_EQ(partition_of_graph(g.offsets, g.columns, std::vector<int>(9, 1), Communicator::alone()),
            std::vector<int>(9, 0));
}

}  // namespace
}  // namespace fsi
