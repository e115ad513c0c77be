#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include "nonlinear/newton.hpp"

namespace fsi::test {

namespace {

/// A scalar equation f(x) = 0 that keeps count of what is asked of it.
class Scalar : public NewtonProblem {
 public:
  using Function = std::function<double(double)>;
  Scalar(Function f, Function slope, double start) : x(start), f_(std::move(f)), slope_(std::move(slope)) {}

  double evaluate() override {
    ++evaluations;
    residual_ = f_(x);
    return std::abs(residual_);
  }
  void linearise() override {
    ++linearisations;
    jacobian_ = slope_(x);
    linearised_ = true;
  }
  bool linearised() const override { return linearised_; }
  void keep(double jacobian) {
    jacobian_ = jacobian;
    linearised_ = true;
  }
  double solve(double) override {
    increment_ = -residual_ / jacobian_;
    return std::abs(increment_);
  }
  void move(double step) override { x += step * increment_; }
  double size() const override { return std::abs(x); }
  double relative_increment() const override {
    return std::abs(increment_) / std::max(std::abs(x - before), 0.01 * std::abs(x));
  }
  double rounding() override {
    ++questions_of_rounding;
    return std::numeric_limits<double>::epsilon() * std::abs(jacobian_ * x);
  }

  double x;
  double before = 0;  // the last solution
  int evaluations = 0, linearisations = 0, questions_of_rounding = 0;

 private:
  Function f_, slope_;
  double residual_ = 0, jacobian_ = 0, increment_ = 0;
  bool linearised_ = false;
};

Scalar square_root_of_two(double start = 2) {
  return {[](double x) { return x * x - 2; }, [](double x) { return 2 * x; }, start};
}

NewtonOptions full_newton() {
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.tolerance = 1e-14;
  return options;
}

TEST(Newton, TellsAStraightWayFromOneThatMayLeadAnywhere) {
  auto near = square_root_of_two();
  EXPECT_FALSE(newton(near, full_newton()).strayed);
  auto far = Scalar([](double x) { return std::expm1(x); }, [](double x) { return std::exp(x); }, 3);
  EXPECT_TRUE(newton(far, full_newton()).strayed);  // increments of 0.95, 0.87, 0.70: a walk
  auto cut = Scalar([](double x) { return std::atan(x); }, [](double x) { return 1 / (1 + x * x); }, 3);
  const auto report = newton(cut, full_newton());
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(report.strayed);
}

// A kept Jacobian that leaves a part t of the error makes an increment of 1 - t of it, a new one that of t: below the last where
// t < 1/2, though more than half of it from t = 1/3 on.
TEST(Newton, GoesStraightFromAKeptJacobianThatContractsByHalf) {
  for (const double left : {0.4, 0.65}) {
    Scalar problem([](double x) { return 3 * x - 6; }, [](double) { return 3.0; }, 10);
    problem.keep(3 / (1 - left));
    NewtonOptions options;
    options.keep_contraction = 0.2;
    const auto report = newton(problem, options);
    EXPECT_TRUE(report.converged);
    ASSERT_GE(report.count(), 2);
    EXPECT_FALSE(report.iterations[0].linearised);
    EXPECT_TRUE(report.iterations[1].linearised);
    EXPECT_NEAR(report.iterations[1].increment / report.iterations[0].increment, left / (1 - left), 1e-12);
    EXPECT_EQ(report.strayed, left > 0.5) << left;
  }
}

// Newton for x^2 = 2: e_(k+1) = e_k^2 / (2 x_k), so residual_(k+1) = increment_(k+1)^2 exactly.
TEST(Newton, ConvergesQuadratically) {
  auto problem = square_root_of_two();
  const auto report = newton(problem, full_newton());
  ASSERT_TRUE(report.converged);
  EXPECT_TRUE(report.failure.empty());
  EXPECT_NEAR(problem.x, std::sqrt(2.0), 4e-16);
  EXPECT_EQ(report.first_residual, 2.0);
  ASSERT_GE(report.count(), 4);
  EXPECT_DOUBLE_EQ(report.iterations[0].increment, 0.5);
  EXPECT_DOUBLE_EQ(report.iterations[0].residual, 0.25);
  for (int k = 1; k < 4; ++k) {
    const double increment = report.iterations[k].increment;
    EXPECT_NEAR(report.iterations[k].residual, increment * increment, 1e-15);
    EXPECT_NEAR(increment, report.iterations[k - 1].increment * report.iterations[k - 1].increment / (2 * problem.x),
                0.2 * increment + 1e-15);
    EXPECT_EQ(report.iterations[k].step, 1.0);
    EXPECT_TRUE(report.iterations[k].linearised);
  }
  EXPECT_EQ(problem.linearisations, report.count());
}

TEST(Newton, SolvesALinearProblemInOneStepAndNotesItInTheNext) {
  Scalar problem([](double x) { return 3 * x - 6; }, [](double) { return 3.0; }, 10);
  const auto report = newton(problem, {});
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(problem.x, 2, 1e-15);
  EXPECT_LE(report.count(), 2);
  EXPECT_EQ(problem.linearisations, 1);
}

TEST(Newton, StartAtTheSolutionIsConverged) {
  Scalar problem([](double x) { return 3 * x - 6; }, [](double) { return 3.0; }, 2);
  const auto report = newton(problem, {});
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_EQ(problem.x, 2);
}

// A start that is the solution to rounding, as the extrapolation of a steady state is: the residual cannot fall any
// more.
TEST(Newton, StartAtTheSolutionToRoundingIsConverged) {
  for (const double start : {1.4142135623730949, 1.4142135623730951, 1.4142135623730954, 1.4142135623730947}) {
    auto problem = square_root_of_two(start);
    const auto report = newton(problem, {});
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_NEAR(problem.x, std::sqrt(2.0), 1e-15);
  }
}

// The question costs as much as products with the Jacobian: iterations that contract as kept Jacobians do do without.
TEST(Newton, AsksForRoundingWhereTheResidualMayHaveComeDownToIt) {
  NewtonOptions options;
  options.tolerance = 1e-6;
  Scalar kept([](double x) { return x + 0.1 * x * x - 1; }, [](double x) { return 1 + 0.2 * x; }, 0.5);
  ASSERT_TRUE(newton(kept, options).converged);
  EXPECT_GT(kept.evaluations, 3);
  EXPECT_EQ(kept.questions_of_rounding, 0);
  Scalar linear([](double x) { return 3 * x - 1; }, [](double) { return 3.0; },
                2);  // solved at once, and that is known
  const auto report = newton(linear, options);
  ASSERT_TRUE(report.converged);
  EXPECT_EQ(report.count(), 1);
  EXPECT_EQ(linear.questions_of_rounding, 1);
}

TEST(Newton, KeepsAJacobianWhileItContractsAndRenewsItWhenNot) {
  NewtonOptions options;
  options.tolerance = 1e-10;
  options.keep_contraction = 0.2;
  options.keep_iterations = 100;
  // Nearly linear: the first Jacobian contracts by about 0.02 an iteration and serves to the end.
  Scalar easy([](double x) { return x + 0.01 * x * x - 1; }, [](double x) { return 1 + 0.02 * x; }, 0);
  const auto kept = newton(easy, options);
  ASSERT_TRUE(kept.converged);
  EXPECT_GT(kept.count(), 2);
  EXPECT_EQ(easy.linearisations, 1);
  for (int k = 1; k < kept.count(); ++k) EXPECT_FALSE(kept.iterations[k].linearised);

  // From far away on a cubic it does not: every renewal answers to a contraction worse than 0.2, and to nothing else.
  Scalar hard([](double x) { return x * x * x - 1; }, [](double x) { return 3 * x * x; }, 3);
  const auto renewed = newton(hard, options);
  ASSERT_TRUE(renewed.converged);
  EXPECT_GT(hard.linearisations, 1);
  EXPECT_NEAR(hard.x, 1, 1e-9);
  double before = renewed.first_residual;
  for (int k = 0; k + 1 < renewed.count(); ++k) {
    const double contraction = renewed.iterations[k].residual / before;
    EXPECT_EQ(renewed.iterations[k + 1].linearised, contraction > options.keep_contraction) << k;
    before = renewed.iterations[k].residual;
  }
}

TEST(Newton, RenewsAKeptJacobianAfterSoManyIterations) {
  NewtonOptions options;
  options.tolerance = 1e-10;
  options.keep_contraction = 0.4;
  options.keep_iterations = 3;
  // A slope of 1.25 instead of 1 contracts by 0.2 an iteration, whether it is made anew or kept.
  Scalar problem([](double x) { return x - 1; }, [](double) { return 1.25; }, 0);
  const auto report = newton(problem, options);
  ASSERT_TRUE(report.converged);
  ASSERT_GT(report.count(), 6);
  for (int k = 0; k < report.count(); ++k) EXPECT_EQ(report.iterations[k].linearised, k % 3 == 0) << k;
}

TEST(Newton, UsesTheJacobianOfAnEarlierCall) {
  auto problem = square_root_of_two(1.5);
  ASSERT_TRUE(newton(problem, {}).converged);
  const int before = problem.linearisations;
  problem.x += 0.01;
  const auto again = newton(problem, {});
  EXPECT_TRUE(again.converged);
  EXPECT_FALSE(again.iterations.front().linearised);
  EXPECT_EQ(problem.linearisations, before);
  EXPECT_NEAR(problem.x, std::sqrt(2.0), 1e-8);
}

// arctan from 1.5: the full step overshoots for ever (|x| > 1.3917), halved ones converge.
TEST(Newton, BacktracksWhenAFullStepRaisesTheResidual) {
  Scalar problem([](double x) { return std::atan(x); }, [](double x) { return 1 / (1 + x * x); }, 3);
  const auto report = newton(problem, full_newton());
  ASSERT_TRUE(report.converged) << report.failure;
  EXPECT_NEAR(problem.x, 0, 1e-12);
  EXPECT_LT(report.iterations.front().step, 1);
  double before = report.first_residual;
  for (const auto& iteration : report.iterations) {
    EXPECT_LE(iteration.residual, before);
    before = iteration.residual;
  }
}

/// Rosenbrock's valley as two equations, stiffness (y - x^2) = 0 and 1 - x = 0: along its floor the first residual grows
/// with the square of each step, however good.
class Valley : public NewtonProblem {
 public:
  explicit Valley(bool measures) : measures_(measures) {}
  double evaluate() override {
    first_ = stiffness * (y - x * x);
    second_ = 1 - x;
    return std::hypot(first_, second_);
  }
  void linearise() override { slope_ = -2 * x; }
  bool linearised() const override { return false; }
  double solve(double) override {
    std::tie(dx_, dy_) = answer();
    return std::hypot(dx_, dy_);
  }
  double distance(double tolerance) override {
    if (!measures_) return NewtonProblem::distance(tolerance);
    const auto [dx, dy] = answer();
    return std::hypot(dx, dy);
  }
  void move(double step) override {
    x += step * dx_;
    y += step * dy_;
  }
  double size() const override { return std::hypot(x, y); }

  double x = -1.2, y = 1;

 private:
  static constexpr double stiffness = 1e4;
  std::tuple<double, double> answer() const {
    const double dx = second_;  // 1 - x - dx = 0
    return {dx, -first_ / stiffness - slope_ * dx};
  }

  bool measures_;
  double first_ = 0, second_ = 0, slope_ = 0, dx_ = 0, dy_ = 0;
};

TEST(Newton, TakesStepsThatComeCloserThoughTheResidualGrows) {
  Valley with(true), without(false);
  const NewtonReport report = newton(with, full_newton()), crawling = newton(without, full_newton());
  ASSERT_TRUE(report.converged);
  EXPECT_NEAR(with.x, 1, 1e-12);
  EXPECT_NEAR(with.y, 1, 1e-12);
  EXPECT_LE(report.count(), 6);
  EXPECT_GT(crawling.count(), 3 * report.count());
  EXPECT_GT(report.iterations.front().residual, 2 * report.first_residual);
}

// log has no value left of 0: like an element that a full step inverts.
TEST(Newton, BacktracksFromWhereTheResidualDoesNotExist) {
  Scalar problem([](double x) { return std::log(x); }, [](double x) { return 1 / x; }, 4);
  const auto report = newton(problem, full_newton());
  ASSERT_TRUE(report.converged) << report.failure;
  EXPECT_NEAR(problem.x, 1, 1e-14);
  EXPECT_LT(report.iterations.front().step, 1);
}

TEST(Newton, AnOldJacobianThatPointsTheWrongWayIsRenewedNotGivenUp) {
  Scalar problem([](double x) { return x * x - 2; }, [](double x) { return 2 * x; }, -1.5);
  ASSERT_TRUE(newton(problem, {}).converged);  // leaves a negative slope behind
  problem.x = 2;
  const auto report = newton(problem, {});
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_NEAR(problem.x, std::sqrt(2.0), 1e-8);
}

TEST(Newton, IterationLimitIsAFailure) {
  auto options = full_newton();
  options.max_iterations = 3;
  auto problem = square_root_of_two(100);
  const auto report = newton(problem, options);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.count(), 3);
  EXPECT_NE(report.failure.find("limit"), std::string::npos);
}

TEST(Newton, ResidualWithoutARootIsAFailureAndTheIterateStays) {
  Scalar problem([](double x) { return x * x + 1; }, [](double x) { return 2 * x; }, 1e-3);
  const auto report = newton(problem, full_newton());
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.find("residual"), std::string::npos);
  EXPECT_NEAR(problem.x, 1e-3, 1e-12) << "no step was taken";
}

TEST(Newton, UndefinedStartAndUndefinedIncrementAreFailures) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scalar start([=](double) { return nan; }, [](double) { return 1.0; }, 0);
  const auto at_start = newton(start, {});
  EXPECT_FALSE(at_start.converged);
  EXPECT_EQ(at_start.count(), 0);
  EXPECT_NE(at_start.failure.find("start"), std::string::npos);

  Scalar increment([](double x) { return x - 1; }, [](double) { return 0.0; }, 0);
  const auto at_solve = newton(increment, {});
  EXPECT_FALSE(at_solve.converged);
  EXPECT_NE(at_solve.failure.find("not finite"), std::string::npos);
  EXPECT_EQ(increment.x, 0);
}

TEST(Newton, ResidualToleranceIsAFurtherDemand) {
  NewtonOptions loose;
  loose.tolerance = 0.9;  // the second increment would do
  auto first = square_root_of_two(), second = square_root_of_two();
  const auto by_increment = newton(first, loose);
  loose.residual_tolerance = 1e-9;
  const auto by_both = newton(second, loose);
  ASSERT_TRUE(by_increment.converged && by_both.converged);
  EXPECT_GT(by_increment.iterations.back().residual, 2e-9);
  EXPECT_LE(by_both.iterations.back().residual, 2e-9);
}

TEST(Newton, AnObserverSeesEachNewSystem) {
  NewtonOptions options = full_newton();
  auto problem = square_root_of_two();
  std::vector<int> seen;
  std::vector<double> iterates;
  options.observe_system = [&](int iteration) {
    seen.push_back(iteration);
    iterates.push_back(problem.x);
  };
  const auto report = newton(problem, options);
  ASSERT_TRUE(report.converged);
  ASSERT_EQ(static_cast<int>(seen.size()), report.count());
  for (int k = 0; k < report.count(); ++k) EXPECT_EQ(seen[k], k + 1);
  EXPECT_EQ(iterates[0], 2);
  EXPECT_EQ(iterates[1], 1.5);  // before the second step is taken
}

TEST(Newton, ReferenceReplacesTheFirstIncrement) {
  NewtonOptions options = full_newton();
  options.tolerance = 1e-3;
  options.reference = 1e3;  // the first increment, 0.5, is already below a thousandth of it
  auto problem = square_root_of_two();
  EXPECT_EQ(newton(problem, options).count(), 1);
}

/// |x - sqrt(2)| relative to the change from `before`.
double error_of(const Scalar& problem) {
  return std::abs(problem.x - std::sqrt(2.0)) / std::abs(problem.x - problem.before);
}

// x^2 = 2, the last solution being 1. A chord's errors fall by 1 - sqrt(2) / 1.4 = 0.010 each from 1.4; those of
// Newton's method from 2 are 0.586, 0.0858, 0.00245 and 2.1e-6, so that the ratio of its last two increments, 0.03, would
// tell an error 35 times as large.
TEST(Newton, EstimatesTheErrorThatItsLastIncrementLeft) {
  for (const auto& [mode, start, count] :
       {std::tuple{NewtonMode::kept, 1.4, 2}, std::tuple{NewtonMode::full, 2.0, 3}}) {
    auto problem = square_root_of_two(start);
    problem.before = 1;
    NewtonOptions options;
    options.mode = mode;
    options.tolerance = 0.1;
    const auto report = newton(problem, options);
    ASSERT_TRUE(report.converged);
    ASSERT_EQ(report.count(), count);
    EXPECT_NEAR(report.error / error_of(problem), 1, 0.1);
  }
}

// The chord's errors from 1.4, relative to the change of 0.414: 3.4e-4, 3.5e-6, 3.6e-8. A first increment is not believed to
// leave less than a tenth. From a start that is good already it does, where the rule that compares it with itself asks for a
// second.
TEST(Newton, StopsByTheEstimatedError) {
  for (const auto& [start, tolerance, count] :
       {std::tuple{1.4, 1e-3, 2}, std::tuple{1.4, 1e-4, 2}, std::tuple{1.4, 1e-6, 3}, std::tuple{1.41421, 1e-3, 1}}) {
    auto problem = square_root_of_two(start);
    problem.before = 1;
    NewtonOptions options;
    options.tolerance = 1e-300;
    options.error_tolerance = tolerance;
    const auto report = newton(problem, options);
    ASSERT_TRUE(report.converged);
    EXPECT_EQ(report.count(), count) << start << " " << tolerance;
    EXPECT_LE(error_of(problem), tolerance);
  }
  auto problem = square_root_of_two(1.41421);
  NewtonOptions by_increment;
  by_increment.tolerance = 1e-3;
  EXPECT_EQ(newton(problem, by_increment).count(), 2);
}

// The same iterations to the same error, the last residual left out; and all of them where others need its rows, where nothing
// is known of what an increment leaves, and where the residual itself is asked to be small.
TEST(Newton, LeavesTheLastResidualOutWhereTheErrorIsKnownWithoutIt) {
  const auto solve = [](NewtonOptions options, double kept, Scalar& problem) {
    problem.before = 1;
    problem.keep(kept);
    options.tolerance = 1e-300;
    options.error_tolerance = 1e-3;
    return newton(problem, options);
  };
  NewtonOptions with, without, small;
  without.last_residual = small.last_residual = false;
  small.residual_tolerance = 1e-2;
  auto all = square_root_of_two(1.3), fewer = all, demanding = all;
  const auto evaluated = solve(with, 3.2, all), left_out = solve(without, 3.2, fewer),
             asked = solve(small, 3.2, demanding);
  ASSERT_TRUE(evaluated.converged && left_out.converged && asked.converged);
  ASSERT_GT(left_out.count(), 1);
  EXPECT_EQ(left_out.linearisations(), 0);
  EXPECT_EQ(left_out.count(), evaluated.count());
  EXPECT_EQ(fewer.evaluations, all.evaluations - 1);
  EXPECT_EQ(fewer.x, all.x);
  EXPECT_TRUE(std::isnan(left_out.iterations.back().residual));
  EXPECT_FALSE(std::isnan(left_out.iterations.front().residual));
  EXPECT_LE(error_of(fewer), left_out.error);
  EXPECT_LE(left_out.error, 1e-3);
  EXPECT_FALSE(std::isnan(asked.iterations.back().residual));

  auto near = square_root_of_two(1.41421);
  const auto first = solve(without, 2.8, near);  // one increment is enough
  EXPECT_EQ(first.count(), 1);
  EXPECT_FALSE(std::isnan(first.iterations.back().residual));
}

/// Whose last solution nobody knows.
class Statics : public Scalar {
 public:
  using Scalar::Scalar;
  double relative_increment() const override { return std::numeric_limits<double>::infinity(); }
};

TEST(Newton, TheIncrementDecidesWhereNobodyKnowsWhatTheSolutionChanges) {
  Statics problem([](double x) { return x * x - 2; }, [](double x) { return 2 * x; }, 1.4);
  NewtonOptions options;
  options.tolerance = 1e-3;
  options.error_tolerance = 1e-12;
  const auto report = newton(problem, options);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.count(), 3);
}

TEST(Newton, EstimatesNoErrorWhereOnlyRoundingIsLeft) {
  auto problem = square_root_of_two();
  problem.before = 1;
  EXPECT_LT(newton(problem, full_newton()).error, 1e-14);
}

}  // namespace

}  // namespace fsi::test
