// The harmonic extension by factorisation and by iteration: residuals, agreement, components with conditions of their
// own, the number of threads, and what happens when the iteration is cut short.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "algebra/block_products.hpp"
#include "fem/held_components.hpp"
#include "host/threads.hpp"
#include "lattice_extension.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

using Problem = ExtensionProblem;

HarmonicExtensionOptions iterative() {
  HarmonicExtensionOptions options;
  options.iterative_from = 1;
  return options;
}
HarmonicExtensionOptions direct() {
  HarmonicExtensionOptions options;
  options.iterative_from = 1 << 30;
  return options;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

void expect_both_ways_agree(const Problem& problem) {
  HarmonicExtension<3> by_factors(problem.laplacian, problem.inner, direct()),
      by_iteration(problem.laplacian, problem.inner, iterative());
  auto first = problem.field, second = problem.field;
  by_factors.solve(problem.right, first);
  by_iteration.solve(problem.right, second);
  EXPECT_FALSE(by_factors.iterates());
  EXPECT_TRUE(by_iteration.iterates());
  EXPECT_GT(by_iteration.iterations(), 3);
  EXPECT_LT(by_iteration.iterations(), 30);
  EXPECT_LT(problem.residual(first), 1e-13);
  EXPECT_LT(problem.residual(second), 1e-10);
  EXPECT_LT(largest_difference(first, second), 1e-10);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (!problem.inner[i]) {
      EXPECT_EQ(second[i], problem.field[i]);
    }
}

TEST(HarmonicExtension, IterationAndFactorisationAgree) {
  expect_both_ways_agree(Problem(20));
}

TEST(HarmonicExtension, AComponentWithAMatrixOfItsOwn) {
  expect_both_ways_agree(Problem(14, 2.5));
}

/// Nodes of one face have frames, turned about the last component's axis, in which one component is sought and one given.
TEST(HarmonicExtension, FramesMixComponents) {
  Problem problem(14, 2.5);
  NodalFrames<3> frames;
  const Direction<3> normal{0.8, 0.6, 0};
  const auto held = hold<3>({normal});
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 14; ++j) {
      const int node = 14 * i + j;  // of the face where the first index is zero
      frames.turn(node, held.axes);
      for (int k = 0; k < 3; ++k) problem.inner[3 * node + k] = !held.held[k];
    }
  HarmonicExtension<3> by_factors(problem.laplacian, problem.inner, direct(), &frames),
      by_iteration(problem.laplacian, problem.inner, iterative(), &frames);
  auto in_single = direct();
  in_single.single_precision = true;
  HarmonicExtension<3> by_single_factors(problem.laplacian, problem.inner, in_single, &frames);
  auto first = problem.field, second = problem.field, third = problem.field;
  by_factors.solve(problem.right, first);
  by_iteration.solve(problem.right, second);
  by_single_factors.solve(problem.right, third);
  EXPECT_LT(largest_difference(first, third), 1e-10);
  EXPECT_FALSE(by_factors.iterates());
  EXPECT_TRUE(by_iteration.iterates());
  EXPECT_LT(by_iteration.iterations(), 30);
  EXPECT_LT(largest_difference(first, second), 1e-10);
  // In space: the rows of A field are the right-hand side's, but for what holds the normal component.
  auto solution = first, right = problem.right;
  frames.to_space<VectorLayout<3>>(solution);
  std::vector<double> rows(solution.size());
  multiply_components<3>(problem.laplacian, solution, rows);
  frames.to_frames<VectorLayout<3>>(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (problem.inner[i]) {
      EXPECT_NEAR(rows[i], right[i], 1e-12);
    } else {
      EXPECT_EQ(first[i], problem.field[i]);
    }
  }
}

TEST(HarmonicExtension, ComponentsMayBeGivenOneByOne) {
  Problem problem(14);
  Random random(3);
  for (char& inner : problem.inner)
    if (random() > 0.8) inner = 0;
  expect_both_ways_agree(problem);
}

/// Components that share a matrix, and one with a matrix of its own.
TEST(HarmonicExtension, FactorsInSinglePrecisionSolveToWhatIsDemanded) {
  const Problem problem(18, 2.5);
  auto options = direct();
  HarmonicExtension<3> exact(problem.laplacian, problem.inner, options);
  options.single_precision = true;
  HarmonicExtension<3> extension(problem.laplacian, problem.inner, options);
  EXPECT_LT(extension.memory_mib(), 0.6 * exact.memory_mib());
  auto reference = problem.field;
  exact.solve(problem.right, reference);
  for (const double tolerance : {1e-3, 1e-7, 1e-12}) {
    auto field = problem.field;
    extension.solve(problem.right, field, tolerance);
    EXPECT_LT(problem.residual(field), std::min(tolerance, 1e-4)) << tolerance;
    EXPECT_LT(largest_difference(field, reference), std::min(10 * tolerance, 1e-4)) << tolerance;
    EXPECT_EQ(problem.residual(field) > 1e-10, tolerance == 1e-3) << tolerance;
  }
}

TEST(HarmonicExtension, TheIterationStartsFromTheGivenField) {
  const Problem problem(14);
  HarmonicExtension<3> extension(problem.laplacian, problem.inner, iterative());
  auto field = problem.field;
  extension.solve(problem.right, field);
  const auto solution = field;
  extension.solve(problem.right, field);
  EXPECT_EQ(extension.iterations(), 0);
  EXPECT_EQ(field, solution);
}

TEST(HarmonicExtension, ALooseToleranceTakesFewerIterations) {
  const Problem problem(14);
  HarmonicExtension<3> extension(problem.laplacian, problem.inner, iterative());
  auto tight = problem.field, loose = problem.field;
  extension.solve(problem.right, tight);
  const int most = extension.iterations();
  extension.solve(problem.right, loose, 1e-3);
  EXPECT_LT(2 * extension.iterations(), most);
  EXPECT_GT(problem.residual(loose), problem.residual(tight));
}

TEST(HarmonicExtension, SameBitsForAnyNumberOfThreads) {
  const Problem problem(24);
  const int before = threads();
  std::vector<double> one = problem.field, two = problem.field;
  for (const auto& [count, field] : {std::pair(1, &one), std::pair(2, &two)}) {
    set_threads(count);
    HarmonicExtension<3> extension(problem.laplacian, problem.inner, iterative());
    extension.solve(problem.right, *field);
  }
  set_threads(before);
  EXPECT_EQ(one, two);
}

TEST(HarmonicExtension, AFactorisationFollowsWhenTheIterationIsCutShort) {
  const Problem problem(14);
  auto options = iterative();
  options.max_iterations = 2;
  HarmonicExtension<3> extension(problem.laplacian, problem.inner, options);
  auto field = problem.field;
  extension.solve(problem.right, field);
  EXPECT_FALSE(extension.iterates());
  EXPECT_LT(problem.residual(field), 1e-13);
}

TEST(HarmonicExtension, NewValuesOfTheOperatorAreTakenOver) {
  for (const auto& options : {direct(), iterative()}) {
    Problem problem(14);
    HarmonicExtension<3> extension(problem.laplacian, problem.inner, options);
    for (double& value : problem.laplacian.values) value *= 3;
    extension.update();
    auto field = problem.field;
    extension.solve(problem.right, field);
    EXPECT_LT(problem.residual(field), 1e-10);
  }
}

TEST(HarmonicExtension, NothingInside) {
  Problem problem(4);
  problem.inner.assign(problem.inner.size(), 0);
  for (const auto& options : {direct(), iterative()}) {
    HarmonicExtension<3> extension(problem.laplacian, problem.inner, options);
    auto field = problem.field;
    extension.solve(problem.right, field);
    EXPECT_EQ(field, problem.field);
  }
}

}  // namespace

}  // namespace fsi::test
