#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "host/threads.hpp"
#include "monolithic/coupled_solvers/amg/coarsening.hpp"
#include "monolithic/coupled_solvers/amg/galerkin.hpp"
#include "unit/linear/grid_matrices.hpp"

namespace {

using namespace fsi;
using Dense = std::vector<std::vector<double>>;

/// P of `entries` entries a node, the vector part of prescribed nodes left out.
Dense dense(const NodeTransfer& t, int entries, int vector) {
  Dense p(t.fine_nodes() * entries, std::vector<double>(t.coarse_nodes * entries, 0.0));
  for (int i = 0; i < t.fine_nodes(); ++i)
    for (int at = t.graph.offsets[i]; at < t.graph.offsets[i + 1]; ++at)
      for (int k = t.fine_prescribed[i] ? vector : 0; k < entries; ++k)
        p[i * entries + k][t.graph.columns[at] * entries + k] = t.weights[at];
  return p;
}

template <int Rows, int Columns>
Dense dense(const BlockMatrix<Rows, Columns>& a, int column_nodes) {
  Dense full(a.graph->rows() * Rows, std::vector<double>(column_nodes * Columns, 0.0));
  for (int i = 0; i < a.graph->rows(); ++i)
    for (int at = a.graph->offsets[i]; at < a.graph->offsets[i + 1]; ++at)
      for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c)
          full[i * Rows + r][a.graph->columns[at] * Columns + c] = a.block(at)[r * Columns + c];
  return full;
}

Dense triple(const Dense& left, const Dense& a, const Dense& right) {
  Dense ar(a.size(), std::vector<double>(right[0].size(), 0.0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a[0].size(); ++k)
      if (a[i][k] != 0)
        for (std::size_t j = 0; j < right[0].size(); ++j) ar[i][j] += a[i][k] * right[k][j];
  Dense result(left[0].size(), std::vector<double>(right[0].size(), 0.0));
  for (std::size_t k = 0; k < left.size(); ++k)
    for (std::size_t i = 0; i < left[0].size(); ++i)
      if (left[k][i] != 0)
        for (std::size_t j = 0; j < right[0].size(); ++j) result[i][j] += left[k][i] * ar[k][j];
  return result;
}

void expect_equal(const Dense& a, const Dense& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) EXPECT_NEAR(a[i][j], b[i][j], 1e-12) << i << " " << j;
}

struct Levels {
  std::shared_ptr<const NodeGraph> graph = test::grid_graph(5);
  std::shared_ptr<const NodeTransfer> first, second;

  Levels() {
    NodeMarks marks(graph->rows());
    for (int i = 0; i < graph->rows(); i += 4) marks.prescribed[i] = 1;
    first = std::make_shared<NodeTransfer>(coarsen(*graph, marks, {}).transfer);
    for (int i = 0; i < graph->rows(); ++i) marks.prescribed[i] = i < 30;
    second = std::make_shared<NodeTransfer>(coarsen(*graph, marks, {CoarseningKind::aggregation, true, true}).transfer);
  }
};

TEST(Galerkin, SquareProductsMatchDenseOnes) {
  const Levels levels;
  auto a = test::random_matrix<4, 4>(levels.graph, 1);
  const SaddleGalerkin<4> product(*levels.graph, levels.first, levels.first);
  auto coarse = product.make_coarse();
  const Dense p = dense(*levels.first, 4, 3);
  product.compute(a, coarse);
  expect_equal(dense(coarse, levels.first->coarse_nodes), triple(p, dense(a, 125), p));
  // New values on the same pattern, and another number of threads.
  a = test::random_matrix<4, 4>(levels.graph, 2);
  set_threads(3);
  product.compute(a, coarse);
  const auto threaded = coarse.values;
  expect_equal(dense(coarse, levels.first->coarse_nodes), triple(p, dense(a, 125), p));
  set_threads(1);
  product.compute(a, coarse);
  EXPECT_EQ(coarse.values, threaded);
  set_threads(0);
}

/// The coupling block of fluid rows and mesh columns: different transfers, rectangular blocks.
TEST(Galerkin, CouplingBlocksTakeDifferentTransfers) {
  const Levels levels;
  const auto a = test::random_matrix<4, 3>(levels.graph, 1);
  const GalerkinProduct<4, 3, 3, 3> product(*levels.graph, levels.first, levels.second);
  auto coarse = product.make_coarse();
  product.compute(a, coarse);
  expect_equal(dense(coarse, levels.second->coarse_nodes),
               triple(dense(*levels.first, 4, 3), dense(a, 125), dense(*levels.second, 3, 3)));
}

TEST(Galerkin, TransfersMatchDenseOnes) {
  const Levels levels;
  const auto& t = *levels.first;
  const Dense p = dense(t, 4, 3);
  const auto coarse = test::random_vector(t.coarse_nodes * 4), fine = test::random_vector(500, 8);
  auto prolongated = fine;
  prolongate_add<4, 3>(t, coarse, prolongated);
  std::vector<double> restricted(coarse.size());
  restrict_to<4, 3>(t, fine, restricted);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    double sum = fine[i];
    for (std::size_t c = 0; c < coarse.size(); ++c) sum += p[i][c] * coarse[c];
    EXPECT_NEAR(prolongated[i], sum, 1e-13);
  }
  for (std::size_t c = 0; c < coarse.size(); ++c) {
    double sum = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) sum += p[i][c] * fine[i];
    EXPECT_NEAR(restricted[c], sum, 1e-12);
  }
}

TEST(Galerkin, TransposedPositionsAndScaling) {
  const auto graph = test::grid_graph(4);
  const auto back = transposed_positions(*graph);
  for (int i = 0; i < graph->rows(); ++i)
    for (int at = graph->offsets[i]; at < graph->offsets[i + 1]; ++at)
      EXPECT_EQ(back[at], graph->find(graph->columns[at], i));
  auto a = test::random_matrix<3, 3>(graph, 5);
  const auto before = a;
  scale_scalar_entries(a, 2.5);
  for (std::size_t k = 0; k < a.values.size(); ++k)
    EXPECT_DOUBLE_EQ(a.values[k], before.values[k] * (k % 9 == 8 ? 2.5 : 1.0));
}

}  // namespace
