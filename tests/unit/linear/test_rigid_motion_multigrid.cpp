// Coarse levels for elasticity as a correction around Jacobi steps.
#include <gtest/gtest.h>

#include <cmath>

#include "host/threads.hpp"
#include "lattice.hpp"
#include "linear/amg/rigid_motion_multigrid.hpp"

namespace fsi::test {

namespace {

/// Mean contraction of the residual over the second ten of twenty V-cycles with one damped Jacobi step before and
/// after.
double contraction(int m, bool coarse_levels, std::vector<float>* result = nullptr) {
  const Lattice lattice(m);
  RigidMotionMultigrid<3> multigrid;
  multigrid.set_up(lattice.matrix, lattice.points, {});
  EXPECT_GE(multigrid.levels(), 2);
  const RegisterBlocks<3, 3> a(lattice.matrix);
  const std::size_t nodes = lattice.points.size();
  std::vector<float> b(nodes * 4, 0.0f), x(b), r(b);
  for (std::size_t i = 0; i < nodes; ++i)
    for (int k = 0; k < 3; ++k) b[i * 4 + k] = static_cast<float>((i * 3 + k) * 37 % 101) - 50;
  const auto find_residual = [&] {
    a.multiply(x, r);
    double sum = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] = b[i] - r[i];
      sum += double(r[i]) * r[i];
    }
    return std::sqrt(sum);
  };
  const auto jacobi = [&] {
    for (std::size_t i = 0; i < nodes; ++i)
      for (int k = 0; k < 3; ++k)
        x[i * 4 + k] +=
            0.5f * r[i * 4 + k] / float(lattice.matrix.block(lattice.matrix.graph->find(int(i), int(i)))[k * 4]);
  };
  double first = find_residual();
  for (int cycle = 0; cycle < 20; ++cycle) {
    if (cycle == 10) first = find_residual();
    jacobi();
    find_residual();
    if (coarse_levels) {
      multigrid.correct(r, x);
      find_residual();
    }
    jacobi();
    find_residual();
  }
  if (result) *result = x;
  return std::pow(find_residual() / first, 0.1);
}

TEST(RigidMotionMultigrid, ContractsAboutIndependentlyOfSize) {
  const double small = contraction(8, true), large = contraction(14, true);
  EXPECT_LT(small, 0.85);
  EXPECT_LT(large, 0.85);
  EXPECT_GT(contraction(14, false), 0.95);
}

TEST(RigidMotionMultigrid, SameBitsForAnyNumberOfThreads) {
  const int before = threads();
  std::vector<float> one, two;
  set_threads(1);
  contraction(16, true, &one);
  set_threads(2);
  contraction(16, true, &two);
  set_threads(before);
  EXPECT_EQ(one, two);
}

TEST(RigidMotionMultigrid, NothingCouplesNothingIsCorrected) {
  auto graph = std::make_shared<NodeGraph>();
  std::vector<std::array<double, 3>> points(100);
  for (int i = 0; i <= 100; ++i) graph->offsets.push_back(i);
  for (int i = 0; i < 100; ++i) graph->columns.push_back(i);
  BlockMatrix<3, 3> a(graph);
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 3; ++k) a.block(i)[k * 4] = 1;
  RigidMotionMultigrid<3> multigrid;
  multigrid.set_up(a, points, {});
  EXPECT_EQ(multigrid.levels(), 1);
  const std::vector<float> r(400, 1.0f);
  std::vector<float> x(400, 2.0f);
  multigrid.correct(r, x);
  EXPECT_EQ(x, std::vector<float>(400, 2.0f));
}

}  // namespace

}  // namespace fsi::test
