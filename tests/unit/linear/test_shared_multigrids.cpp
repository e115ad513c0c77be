// Multigrids, GMRES and products of sparse rows on several processes: the same as one process computes. Run by 2 and 3.
#include <gtest/gtest.h>

#include <cmath>

#include "csr_laplacian.hpp"
#include "lattice.hpp"
#include "linear/amg/rigid_motion_multigrid.hpp"
#include "linear/amg/scalar_multigrid.hpp"
#include "linear/amg/shared_rows.hpp"
#include "linear/krylov/gmres.hpp"
#include "shared_matrix.hpp"

namespace fsi::test {

namespace {

SparseRows rows_of(const CsrMatrix<double>& a) {
  return {1, a.offsets, a.indices, a.values};
}

TEST(SharedRows, GatheredAreTheWholeMatrix) {
  const auto whole = csr_laplacian(4, 0.5);
  const SharedMatrix shared(everyone(), whole);
  const auto gathered = gather_rows(rows_of(shared.matrix), shared.graph.share);
  EXPECT_EQ(gathered.offsets, whole.offsets);
  EXPECT_EQ(gathered.columns, whole.indices);
  EXPECT_EQ(gathered.values, whole.values);
}

/// A A by rows of copies, and A^T A by sums over processes: A is symmetric.
TEST(SharedRows, ProductsAreThoseOfTheWhole) {
  auto whole = csr_laplacian(4, 0.5);
  for (std::size_t at = 0; at < whole.values.size(); ++at)  // whole numbers, symmetric, all different in a row
    for (int row = 0; row < whole.rows(); ++row)
      if (static_cast<int>(at) >= whole.offsets[row] && static_cast<int>(at) < whole.offsets[row + 1])
        whole.values[at] = 1 + (row + whole.indices[at]) % 7;
  const auto expected = product(whole, whole);
  const SharedMatrix shared(everyone(), whole);
  const ShareOfNumbers& share = shared.graph.share;
  ShareOfNumbers columns = share;
  auto all = with_rows_of_copies(rows_of(shared.matrix), share, columns);
  const CsrMatrix<double> square =
      product(shared.matrix, {columns.items(), std::move(all.offsets), std::move(all.columns), std::move(all.values)});
  EXPECT_EQ(gather_rows(rows_of(square), columns).values, expected.values);
  columns = share;
  const auto by_sums = sum_of_rows(rows_of(product(transposed(shared.matrix), shared.matrix)), columns);
  const auto gathered = gather_rows(by_sums, columns);
  EXPECT_EQ(gathered.columns, expected.indices);
  EXPECT_EQ(gathered.values, expected.values);
}

/// The contraction of the residual in the last of some cycles, over all processes.
double contraction(const CsrMatrix<double>& whole, const Communicator& processes, int* levels = nullptr) {
  const SharedMatrix shared(processes, whole);
  const ShareOfNumbers& share = shared.graph.share;
  ScalarMultigrid multigrid;
  ScalarMultigrid::Options options;
  options.post_smoothing = true;
  multigrid.set_up(shared.matrix, share, options);
  if (levels) *levels = multigrid.levels();
  const int own = share.own;
  std::vector<float> b(own), r(own), e(own);
  std::vector<double> x(share.items(), 0.0), product(own);
  for (int i = 0; i < own; ++i) b[i] = static_cast<float>(share.number(i) * 37 % 101) - 50;
  double norm = 0, before = 0;
  for (int cycle = 0; cycle < 8; ++cycle) {
    share.exchange.update(x);
    multiply(shared.matrix, x, product);
    double sum = 0;
    for (int i = 0; i < own; ++i) {
      r[i] = static_cast<float>(b[i] - product[i]);
      sum += double(r[i]) * r[i];
    }
    before = norm;
    norm = std::sqrt(processes.sum(sum));
    multigrid.cycle(r, e);
    for (int i = 0; i < own; ++i) x[i] += e[i];
  }
  return norm / before;
}

TEST(SharedScalarMultigrid, ContractsAsThatOfOneProcess) {
  const auto whole = csr_laplacian(20);
  int levels = 0;
  const double shared = contraction(whole, everyone(), &levels), alone = contraction(whole, Communicator::alone());
  EXPECT_GE(levels, 3);
  EXPECT_LT(shared, 1.25 * alone + 0.02);
}

TEST(SharedScalarMultigrid, SmallMatricesAreInverted) {
  const auto whole = csr_laplacian(5);
  const SharedMatrix shared(everyone(), whole);
  ScalarMultigrid multigrid;
  multigrid.set_up(shared.matrix, shared.graph.share, {});
  EXPECT_EQ(multigrid.levels(), 1);
  std::vector<double> exact(shared.graph.share.items()), b(shared.graph.share.own);
  for (int i = 0; i < shared.graph.share.items(); ++i) exact[i] = std::sin(double(shared.graph.share.number(i)));
  multiply(shared.matrix, exact, b);
  std::vector<float> x(b.size());
  multigrid.cycle({b.begin(), b.end()}, x);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], exact[i], 1e-5);
}

/// Rows that couple with no others: nothing is coarsened, and a process without rows takes part.
TEST(SharedScalarMultigrid, MatricesThatDoNotCoupleAreSmoothedOnly) {
  const int own = everyone().is_first() ? 1000 : 0;
  CsrMatrix<double> diagonal;
  diagonal.columns = own;
  for (int row = 0; row < own; ++row) {
    diagonal.indices.push_back(row);
    diagonal.values.push_back(2);
    diagonal.offsets.push_back(row + 1);
  }
  ScalarMultigrid multigrid;
  multigrid.set_up(diagonal, ShareOfNumbers(everyone(), own, {}), {});
  std::vector<float> x(own);
  multigrid.cycle(std::vector<float>(own, 4.0f), x);
  EXPECT_EQ(x, std::vector<float>(own, 2.0f));
}

/// Residual over the first after cycles of Jacobi steps around the coarse correction, over all processes.
double left_of_lattice(const Lattice& lattice, const Communicator& processes) {
  const SharedGraph graph(processes, lattice.matrix.graph->offsets, lattice.matrix.graph->columns);
  auto nodes = std::make_shared<NodeGraph>();
  nodes->offsets = graph.offsets;
  nodes->columns = graph.columns;
  BlockMatrix<3, 3> a(nodes);
  for (std::size_t at = 0; at < graph.positions.size(); ++at)
    std::copy_n(lattice.matrix.block(graph.positions[at]), 9, a.block(static_cast<int>(at)));
  const int own = graph.share.own;
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < own; ++i) points.push_back(lattice.points[graph.share.number(i)]);
  RigidMotionMultigrid<3> multigrid;
  RigidMotionMultigrid<3>::Options options;
  options.coarsest_nodes = 10;  // more levels
  multigrid.set_up(a, graph.share, points, options);
  EXPECT_GE(multigrid.levels(), 3);
  const RegisterBlocks<3, 3> product(a);
  std::vector<float> b(static_cast<std::size_t>(own) * 4, 0.0f), r(b);
  std::vector<float> x(static_cast<std::size_t>(graph.share.items()) * 4, 0.0f);
  for (int i = 0; i < own; ++i)
    for (int k = 0; k < 3; ++k) b[i * 4 + k] = static_cast<float>((graph.share.number(i) * 3 + k) * 37 % 101) - 50;
  const auto find_residual = [&] {
    graph.share.exchange.update(x, 4);
    product.multiply(x, r);
    double sum = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] = b[i] - r[i];
      sum += double(r[i]) * r[i];
    }
    return std::sqrt(processes.sum(sum));
  };
  const auto jacobi = [&] {
    for (int i = 0; i < own; ++i)
      for (int k = 0; k < 3; ++k) x[i * 4 + k] += 0.5f * r[i * 4 + k] / float(a.block(nodes->find(i, i))[k * 4]);
  };
  const double first = find_residual();
  for (int cycle = 0; cycle < 20; ++cycle) {
    jacobi();
    find_residual();
    multigrid.correct(r, x);
    find_residual();
    jacobi();
    find_residual();
  }
  return find_residual() / first;
}

TEST(SharedRigidMotionMultigrid, ContractsAsThatOfOneProcess) {
  const Lattice lattice(10);
  const double shared = std::pow(left_of_lattice(lattice, everyone()), 0.05),
               alone = std::pow(left_of_lattice(lattice, Communicator::alone()), 0.05);
  EXPECT_LT(alone, 0.9);
  EXPECT_LT(shared, alone + 0.03);
}

TEST(SharedGmres, SolvesAsOneProcess) {
  const auto whole = csr_laplacian(6, 0.1);
  const auto iterations_of = [&](const Communicator& processes) {
    const SharedMatrix shared(processes, whole);
    const ShareOfNumbers& share = shared.graph.share;
    const auto a = converted<float>(shared.matrix);
    std::vector<float> exact(share.items()), b(share.items(), 0.0f), x;
    for (int i = 0; i < share.items(); ++i) exact[i] = std::cos(float(share.number(i)));
    multiply(a, exact, b);
    SingleGmres gmres(processes);
    const auto report = gmres.solve_from_zero(
        [&](const auto& v, auto& z, auto& y) {
          z = v;
          share.exchange.update(z);
          multiply(a, z, y);
        },
        b, x, 1e-4, 100);
    EXPECT_TRUE(report.converged);
    for (int i = 0; i < share.items(); ++i) EXPECT_NEAR(x[i], exact[i], 2e-3);
    return report.iterations;
  };
  EXPECT_NEAR(iterations_of(everyone()), iterations_of(Communicator::alone()), 1);
}

}  // namespace

}  // namespace fsi::test
