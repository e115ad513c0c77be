#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "monolithic/coupled_solvers/amg/coarsening.hpp"
#include "unit/linear/grid_matrices.hpp"

namespace {

using namespace fsi;

constexpr int side = 9;

/// A cube of nodes whose face k = 0 is the interface and whose face i = 0 is prescribed.
NodeMarks cube_marks() {
  NodeMarks marks(side * side * side);
  for (int node = 0; node < marks.nodes(); ++node) {
    marks.prescribed[node] = node % side == 0;
    marks.interface[node] = node < side * side;
  }
  return marks;
}

void expect_rows_sum_to_one(const NodeTransfer& t) {
  for (int i = 0; i < t.fine_nodes(); ++i) {
    double sum = 0;
    for (int at = t.graph.offsets[i]; at < t.graph.offsets[i + 1]; ++at) sum += t.weights[at];
    EXPECT_NEAR(sum, 1, 1e-14) << "node " << i;
  }
  for (int c = 0; c < t.coarse_nodes; ++c) EXPECT_LT(t.transposed.offsets[c], t.transposed.offsets[c + 1]);
}

class Kinds : public ::testing::TestWithParam<CoarseningKind> {};
INSTANTIATE_TEST_SUITE_P(Coarsening, Kinds, ::testing::Values(CoarseningKind::colouring, CoarseningKind::aggregation));

TEST_P(Kinds, InterpolateConstantsAndCoarsenFast) {
  const auto graph = test::grid_graph(side);
  const auto result = coarsen(*graph, NodeMarks(graph->rows()), {GetParam(), true, true});
  expect_rows_sum_to_one(result.transfer);
  EXPECT_LT(result.transfer.coarse_nodes, graph->rows() / 5);
  EXPECT_GT(result.transfer.coarse_nodes, graph->rows() / 40);
  EXPECT_EQ(result.marks.nodes(), result.transfer.coarse_nodes);
  const auto again = coarsen(*graph, NodeMarks(graph->rows()), {GetParam(), true, true});
  EXPECT_EQ(again.transfer.graph.columns, result.transfer.graph.columns);
  EXPECT_EQ(again.transfer.weights, result.transfer.weights);
}

TEST_P(Kinds, KeepGroupsApart) {
  const auto graph = test::grid_graph(side);
  const NodeMarks marks = cube_marks();
  for (bool mixed : {true, false}) {
    const auto result = coarsen(*graph, marks, {GetParam(), mixed, true});
    const auto& t = result.transfer;
    expect_rows_sum_to_one(t);
    int crossings = 0;
    for (int i = 0; i < t.fine_nodes(); ++i)
      for (int at = t.graph.offsets[i]; at < t.graph.offsets[i + 1]; ++at) {
        const bool coarse_interface = result.marks.interface[t.graph.columns[at]];
        if (marks.interface[i]) {
          EXPECT_TRUE(coarse_interface);
        }
        if (!marks.interface[i] && coarse_interface) ++crossings;
      }
    if (mixed)
      EXPECT_GT(crossings, 0);
    else
      EXPECT_EQ(crossings, 0);
  }
}

/// Two volumes that share a face but number it differently get the same weights there.
TEST_P(Kinds, MatchOnACommonInterface) {
  const auto graph = test::grid_graph(side);
  NodeMarks marks = cube_marks(), mirrored(marks.nodes());
  const int nodes = graph->rows();
  const auto mirror = [&](int node) { return nodes - 1 - node; };
  for (int node = 0; node < nodes; ++node) {
    mirrored.interface[mirror(node)] = marks.interface[node];
    mirrored.prescribed[mirror(node)] = marks.prescribed[node];
  }
  std::vector<int> first, second;
  std::vector<char> prescribed;
  for (int node = 0; node < side * side; ++node) {
    first.push_back(node);
    second.push_back(mirror(node));
    prescribed.push_back(marks.prescribed[node]);
  }
  const NodeGraph surface = interface_graph(*graph, first, *graph, second);
  const NodeTransfer coarse = coarsen_interface(surface, prescribed, GetParam());
  expect_rows_sum_to_one(coarse);
  const auto fluid = extend_interface(*graph, marks, first, coarse, {GetParam(), true, true});
  const auto wall = extend_interface(*graph, mirrored, second, coarse, {GetParam(), false, true});
  expect_rows_sum_to_one(fluid.transfer);
  expect_rows_sum_to_one(wall.transfer);
  ASSERT_EQ(fluid.coarse_interface.size(), static_cast<std::size_t>(coarse.coarse_nodes));
  for (int k = 0; k < side * side; ++k) {
    std::set<std::pair<int, double>> expected, of_fluid, of_wall;
    for (int at = coarse.graph.offsets[k]; at < coarse.graph.offsets[k + 1]; ++at)
      expected.insert({coarse.graph.columns[at], coarse.weights[at]});
    const auto collect = [](const Coarsening& volume, int node, auto& into) {
      const auto& t = volume.transfer;
      for (int at = t.graph.offsets[node]; at < t.graph.offsets[node + 1]; ++at) {
        const auto& list = volume.coarse_interface;
        const auto found = std::find(list.begin(), list.end(), t.graph.columns[at]);
        ASSERT_NE(found, list.end());
        into.insert({static_cast<int>(found - list.begin()), t.weights[at]});
      }
    };
    collect(fluid, first[k], of_fluid);
    collect(wall, second[k], of_wall);
    EXPECT_EQ(of_fluid, expected);
    EXPECT_EQ(of_wall, expected);
  }
}

TEST_P(Kinds, PreferFreeCoarseNodes) {
  const auto graph = test::grid_graph(side);
  NodeMarks marks(graph->rows());
  for (int node = 0; node < marks.nodes(); ++node) marks.prescribed[node] = node % side == 0;
  const auto result = coarsen(*graph, marks, {GetParam(), true, true});
  expect_rows_sum_to_one(result.transfer);
  EXPECT_EQ(std::count(result.marks.prescribed.begin(), result.marks.prescribed.end(), 1), 0);
  for (int c = 0; c < result.transfer.coarse_nodes; ++c) EXPECT_FALSE(marks.prescribed[result.transfer.seeds[c]]);

  // Nothing free: the coarse nodes are prescribed, and say so.
  marks.prescribed.assign(marks.nodes(), 1);
  const auto held = coarsen(*graph, marks, {GetParam(), true, true});
  expect_rows_sum_to_one(held.transfer);
  EXPECT_EQ(std::count(held.marks.prescribed.begin(), held.marks.prescribed.end(), 0), 0);
}

TEST_P(Kinds, LeavePrescribedNodesOutWithoutScalarPart) {
  const auto graph = test::grid_graph(side);
  const NodeMarks marks = cube_marks();
  const auto result = coarsen(*graph, marks, {GetParam(), true, false});
  const auto& t = result.transfer;
  for (int i = 0; i < t.fine_nodes(); ++i)
    EXPECT_EQ(t.graph.offsets[i] == t.graph.offsets[i + 1], marks.prescribed[i] != 0);
}

TEST(Coarsening, NamesAreChecked) {
  EXPECT_EQ(coarsening_kinds().at("colouring"), CoarseningKind::colouring);
  EXPECT_THROW(coarsening_kinds().at("coloring"), InputError);
}

TEST(Coarsening, CoarseNodesOfAColouringAreIndependent) {
  const auto graph = test::grid_graph(side);
  const auto result = coarsen(*graph, NodeMarks(graph->rows()), {});
  const auto& seeds = result.transfer.seeds;
  for (int a : seeds)
    for (int b : seeds)
      if (a != b) {
        EXPECT_LT(graph->find(a, b), 0);
      }
}

TEST(Coarsening, RowColoursSeparateNeighbours) {
  const auto graph = test::grid_graph(6);
  const RowColours colours = colour_rows(*graph);
  EXPECT_EQ(colours.rows.size(), 216u);
  for (int c = 0; c < colours.colours(); ++c)
    for (int a = colours.offsets[c]; a < colours.offsets[c + 1]; ++a)
      for (int b = a + 1; b < colours.offsets[c + 1]; ++b) EXPECT_LT(graph->find(colours.rows[a], colours.rows[b]), 0);
}

TEST(Coarsening, StrongGraphDropsWeakCouplings) {
  BlockMatrix<1, 1> a(test::grid_graph(4, true));
  for (int i = 0; i < 64; ++i)
    for (int at = a.graph->offsets[i]; at < a.graph->offsets[i + 1]; ++at) {
      const int distance = std::abs(a.graph->columns[at] - i);
      a.values[at] = distance == 0 ? 4 : (distance == 1 ? -1.9 : -0.01);
    }
  const NodeGraph strong = strong_graph(a, 1, 0.1);
  for (int i = 0; i < 64; ++i)
    for (int at = strong.offsets[i]; at < strong.offsets[i + 1]; ++at) EXPECT_LE(std::abs(strong.columns[at] - i), 1);
  EXPECT_EQ(strong_graph(a, 1, 0).blocks(), a.graph->blocks());
}

}  // namespace
