// A matrix whose rows are shared out unevenly, solved by all processes together and by the first of them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "linear/direct/central_factorisation.hpp"

namespace fsi::test {

namespace {

/// Rows of process r: 5, 0, 3, 5, 0, ... An unsymmetric tridiagonal matrix whose corners couple the first and the last
/// process. Its diagonal is the sum of two numbers.
struct Problem {
  const Communicator& processes = Communicator::world();
  std::int64_t rows = processes.rank() % 3 == 0 ? 5 : (processes.rank() % 3 == 1 ? 0 : 3);
  std::int64_t first = processes.sum_before(rows), whole = processes.sum(rows);
  double diagonal = 3, more = 0.5, left = -1, right = -2;

  GatheredMatrix::Builder terms() const {
    GatheredMatrix::Builder builder(whole);
    for (std::int64_t i = first; i < first + rows; ++i) {
      builder.add(i, i, &diagonal, 1);
      builder.add(i, (i + 1) % whole, &right, 1);
      builder.add(i, (i + whole - 1) % whole, &left, 2);
      builder.add(i, i, &more, static_cast<double>(i));
    }
    return builder;
  }
  double solution(std::int64_t i) const { return std::sin(static_cast<double>(i)); }
  std::vector<double> b() const {
    std::vector<double> b;
    for (std::int64_t i = first; i < first + rows; ++i)
      b.push_back((diagonal + more * static_cast<double>(i)) * solution(i) + right * solution((i + 1) % whole) +
                  2 * left * solution((i + whole - 1) % whole));
    return b;
  }
  void expect_solved_by(const CentralFactorisation& factors) const {
    std::vector<double> x;
    factors.solve(b(), x);
    ASSERT_EQ(static_cast<std::int64_t>(x.size()), whole);
    for (std::int64_t i = 0; i < whole; ++i) EXPECT_NEAR(x[i], solution(i), 1e-14) << i;
  }
};

TEST(CentralFactorisation, SolvesWithTheNumbersOfTheLastUpdate) {
  Problem problem;
  CentralFactorisation factors(problem.processes, problem.terms());
  EXPECT_FALSE(factors.factorised());
  factors.update();
  EXPECT_TRUE(factors.factorised());
  problem.expect_solved_by(factors);
  problem.diagonal = 7;
  problem.left = 0.25;
  factors.update();
  problem.expect_solved_by(factors);
  EXPECT_GE(factors.memory_mib(), 0);
}

TEST(CentralFactorisation, SingularityIsAnErrorAtAllProcesses) {
  Problem problem;
  CentralFactorisation factors(problem.processes, problem.terms());
  for (const double wrong : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    problem.diagonal = problem.more = problem.left = problem.right = wrong;
    EXPECT_THROW(factors.update(), ConvergenceError);
    EXPECT_FALSE(factors.factorised());
  }
  problem.diagonal = 3;
  problem.more = 1;
  problem.left = -1;
  problem.right = 0.25;
  factors.update();
  problem.expect_solved_by(factors);
}

}  // namespace

}  // namespace fsi::test
