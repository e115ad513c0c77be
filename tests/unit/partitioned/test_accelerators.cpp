#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "model_maps.hpp"
#include "partitioned/accelerators/affine_map.hpp"
#include "partitioned/accelerators/iqn_ils.hpp"
#include "partitioned/accelerators/iqn_imvj.hpp"
#include "partitioned/accelerators/newton_krylov.hpp"
#include "partitioned/accelerators/regularised_iqn.hpp"
#include "partitioned/accelerators/relaxation.hpp"
#include "partitioned/registry.hpp"

namespace fsi::test {

namespace {

QuasiNewtonOptions unfiltered(double mixing = 1) {
  QuasiNewtonOptions options;
  options.filter = 1e-12;
  options.mixing = mixing;
  return options;
}

std::vector<double> zero(const AddedMassMap& map) {
  return std::vector<double>(static_cast<std::size_t>(map.size), 0.0);
}

// Errors of mode g are multiplied by 1 - omega (1 + g): theory of Causin, Gerbeau and Nobile.
TEST(ConstantRelaxation, ContractsAsPredictedAndDivergesBeyondItsLimit) {
  const AddedMassMap map{1};  // g = 100
  for (const double omega : {0.005, 0.0099, 0.015}) {
    ConstantRelaxation relaxation(omega);
    auto x = zero(map);
    std::vector<double> history;
    corrections(relaxation, map, x, 1e-10, 10, &history);
    for (std::size_t k = 1; k < history.size(); ++k)
      EXPECT_NEAR(history[k] / history[k - 1], std::abs(1 - omega * 101), 1e-6);
  }
  ConstantRelaxation beyond(2.001 / 101);
  auto x = zero(map);
  EXPECT_EQ(corrections(beyond, map, x, 1e-10, 300), 300);
}

TEST(AitkenRelaxation, IsExactForOneMode) {
  const AddedMassMap map{1};
  AitkenRelaxation aitken(0.001, 0.05);
  auto x = zero(map);
  EXPECT_EQ(corrections(aitken, map, x, 1e-12), 2);
  EXPECT_NEAR(aitken.status().relaxation, 1.0 / 101, 1e-12);
}

TEST(AitkenRelaxation, StartsAStepWithItsLastFactorButNotAboveTheLimit) {
  const AddedMassMap map{1};
  AitkenRelaxation aitken(0.001, 0.005);
  auto x = zero(map);
  corrections(aitken, map, x, 1e-12);
  aitken.start();
  EXPECT_DOUBLE_EQ(aitken.status().relaxation, 0.005);
}

TEST(AitkenRelaxation, SurvivesResidualsThatDoNotChange) {
  AitkenRelaxation aitken(0.01, 0.05);
  aitken.start();
  std::vector<double> x{1, 2};
  for (int k = 0; k < 3; ++k) aitken.correct(x, {0.5, 0.5});
  EXPECT_TRUE(all_finite(x));
}

/// Both quasi-Newton accelerators.
template <class T>
class QuasiNewton : public testing::Test {};
using QuasiNewtonTypes = testing::Types<IqnIls, IqnImvj>;
TYPED_TEST_SUITE(QuasiNewton, QuasiNewtonTypes);

// One difference more in each pass, and after n of them the inverse Jacobian is known.
TYPED_TEST(QuasiNewton, SolvesALinearProblemInAsManyPassesAsItHasDimensions) {
  for (const double mixing : {1.0, 0.5})
    for (const int n : {1, 2, 5, 8}) {
      TypeParam accelerator(unfiltered(mixing));
      const AddedMassMap map{n};
      auto x = zero(map);
      EXPECT_LE(corrections(accelerator, map, x, 1e-8), n + 1) << n << " dimensions, mixing " << mixing;
    }
}

TYPED_TEST(QuasiNewton, KnowsALinearProblemInTheNextStep) {
  TypeParam accelerator(unfiltered());
  AddedMassMap map{6};
  auto x = zero(map);
  corrections(accelerator, map, x, 1e-8);
  for (int step = 1; step <= 3; ++step) {
    map.shift = step;
    EXPECT_LE(corrections(accelerator, map, x, 1e-7), 2) << "step " << step;
  }
}

TYPED_TEST(QuasiNewton, ConvergesOnANonlinearMapWithTheDefaults) {
  TypeParam accelerator{QuasiNewtonOptions{}};
  AddedMassMap map{30, 1.0};
  auto x = zero(map);
  EXPECT_LE(corrections(accelerator, map, x, 1e-8), 40);
  map.shift = 0.05;
  EXPECT_LE(corrections(accelerator, map, x, 1e-8), 25) << "with the differences of the last step";
}

TYPED_TEST(QuasiNewton, SurvivesZeroAndRepeatedDifferences) {
  TypeParam accelerator{QuasiNewtonOptions{}};
  accelerator.start();
  std::vector<double> x{1, 2, 3};
  accelerator.correct(x, {0.1, 0.2, 0.3});
  accelerator.correct(x, {0.1, 0.2, 0.3});  // zero difference of residuals
  EXPECT_TRUE(all_finite(x));
  for (int k = 2; k < 6; ++k) accelerator.correct(x, {0.1 * k, 0.2 * k, 0.3 * k});  // parallel ones
  EXPECT_TRUE(all_finite(x));
  EXPECT_LE(accelerator.status().columns, 1);
  accelerator.correct(x, {0, 0, 0});
  EXPECT_TRUE(all_finite(x));
  accelerator.accept(x, {0, 0, 0});
  accelerator.start();
  accelerator.correct(x, {0.1, 0.1, 0.1});
  EXPECT_TRUE(all_finite(x));
}

TYPED_TEST(QuasiNewton, AcceptsAStepThatTookNoCorrection) {
  TypeParam accelerator{QuasiNewtonOptions{}};
  std::vector<double> x{1, 2};
  for (int step = 0; step < 3; ++step) {
    accelerator.start();
    accelerator.accept(x, {1e-9, 0});
  }
  accelerator.start();
  accelerator.correct(x, {0.1, 0});
  EXPECT_DOUBLE_EQ(x[0], 1 + 0.01 * 0.1) << "plain relaxation while nothing is known";
}

TYPED_TEST(QuasiNewton, GoesOnBitForBitFromItsMemory) {
  const AddedMassMap map{12, 10.0};
  TypeParam accelerator{QuasiNewtonOptions{}}, restarted{QuasiNewtonOptions{}};
  auto x = zero(map);
  corrections(accelerator, map, x, 1e-6);
  WrittenArchive archive = archive_of(accelerator);
  restarted.keep(archive.turn());
  const AddedMassMap next{12, 10.0, 0.3};
  auto y = x;
  corrections(accelerator, next, x, 1e-6);
  corrections(restarted, next, y, 1e-6);
  EXPECT_EQ(x, y);
  const WrittenArchive a = archive_of(accelerator), b = archive_of(restarted);
  EXPECT_EQ(a.arrays, b.arrays);
  EXPECT_EQ(a.numbers, b.numbers);
}

TYPED_TEST(QuasiNewton, KeepsItsMemoryBounded) {
  QuasiNewtonOptions options;
  options.columns = 10;
  TypeParam accelerator(options);
  AddedMassMap map{8, 0.2};
  auto x = zero(map);
  for (int step = 0; step < 6; ++step) {
    map.shift = 0.2 * step;
    EXPECT_LT(corrections(accelerator, map, x, 1e-6), 300);
    std::size_t numbers = 0;
    const WrittenArchive archive = archive_of(accelerator);
    for (const auto& [name, array] : archive.arrays) numbers += array.size();
    EXPECT_LE(numbers, 2u * 10 * 8 + 10);
  }
}

TEST(IqnIls, ForgetsStepsThatAreTooOld) {
  QuasiNewtonOptions options = unfiltered();
  options.reused_steps = 0;
  IqnIls accelerator(options);
  AddedMassMap map{4};
  auto x = zero(map);
  corrections(accelerator, map, x, 1e-8);
  map.shift = 1;
  EXPECT_GE(corrections(accelerator, map, x, 1e-8), 4) << "as if there had been no step before";
}

TEST(IqnIls, KeepsWhatItKnowsThroughAChange) {
  const AddedMassMap map{8};
  const auto again = [&](bool changes, bool longer = false) {
    IqnIls accelerator(unfiltered());
    auto x = zero(map);
    corrections(accelerator, map, x, 1e-8);
    if (changes) accelerator.change(longer);
    x = zero(map);
    return corrections(accelerator, map, x, 1e-7);
  };
  EXPECT_LE(again(true), again(false) + 1) << "as a map instead of columns";
  EXPECT_LT(again(true), 4);
  EXPECT_GT(again(true, true), 4) << "begins anew";
}

TEST(IqnIls, AnAbandonedStepTeachesNothing) {
  const AddedMassMap map{8};
  IqnIls accelerator(unfiltered());
  auto x = zero(map);
  corrections(accelerator, map, x, 1e-8);
  accelerator.start();
  for (int k = 0; k < 3; ++k) {
    auto r = map.residual(x);
    for (double& value : r) value *= -1e3;
    accelerator.correct(x, r);
  }
  const auto ages = [&] { return archive_of(accelerator).arrays.at("iqn_ils.age"); };
  EXPECT_EQ(ages().front(), 0);
  accelerator.abandon();
  ASSERT_FALSE(ages().empty());
  for (const double age : ages()) EXPECT_GT(age, 0);
}

/// Corrections for residuals that carry an error: a tenth of what the last change of x did, times a cosine, as a sub-problem
/// leaves it that is solved by one iteration; `limit` if they do not get there.
int corrections_with_errors(Accelerator& accelerator, const AddedMassMap& map, std::vector<double>& x, int limit) {
  accelerator.start();
  std::vector<double> last = map.residual(x);
  double first = 0;
  for (int k = 0; k < limit; ++k) {
    const std::vector<double> exact = map.residual(x);
    std::vector<double> r = exact;
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] += 0.1 * std::cos(7.0 * static_cast<double>(i) + k) * (exact[i] - last[i]);
    last = exact;
    if (k == 0) first = norm(r);
    if (norm(r) <= 1e-8 * first) {
      accelerator.accept(x, r);
      return k;
    }
    accelerator.correct(x, r);
  }
  return limit;
}

TEST(RegularisedIqn, ConvergesWithErrorsInItsColumns) {
  QuasiNewtonOptions options;
  options.mixing = 0.5;
  RegularisedIqn regularised(options);
  AddedMassMap map{20};
  auto x = zero(map);
  const int first = corrections_with_errors(regularised, map, x, 200);
  EXPECT_LT(first, 60);
  map.shift = 0.05;
  EXPECT_LT(corrections_with_errors(regularised, map, x, 200), first) << "with the columns of the last step";
}

TEST(RegularisedIqn, SurvivesZeroAndRepeatedDifferences) {
  RegularisedIqn accelerator{QuasiNewtonOptions{}};
  accelerator.start();
  std::vector<double> x{1, 2, 3};
  accelerator.correct(x, {0.1, 0.2, 0.3});
  accelerator.correct(x, {0.1, 0.2, 0.3});                                          // zero difference of residuals
  for (int k = 2; k < 6; ++k) accelerator.correct(x, {0.1 * k, 0.2 * k, 0.3 * k});  // parallel ones
  accelerator.correct(x, {0, 0, 0});
  EXPECT_TRUE(all_finite(x));
}

TEST(RegularisedIqn, ForgetsOldStepsAndAbandonedOnes) {
  const AddedMassMap map{8};
  QuasiNewtonOptions options;
  options.reused_steps = 2;
  options.columns = 5;
  RegularisedIqn accelerator(options);
  auto x = zero(map);
  corrections(accelerator, map, x, 1e-8);
  const auto ages = [&] { return archive_of(accelerator).arrays.at("regularised_iqn.age"); };
  EXPECT_EQ(ages().size(), 5u) << "the limit";
  accelerator.start();
  for (int k = 0; k < 3; ++k) accelerator.correct(x, map.residual(x));
  EXPECT_EQ(ages().back(), 0);
  accelerator.abandon();
  ASSERT_FALSE(ages().empty());
  EXPECT_EQ(ages().back(), 1);
  for (int step = 0; step < 2; ++step) accelerator.start();
  EXPECT_TRUE(ages().empty()) << "older than two steps";
}

TEST(RegularisedIqn, GoesOnBitForBitFromItsMemory) {
  const AddedMassMap map{12, 10.0};
  const QuasiNewtonOptions options = unfiltered(0.5);
  RegularisedIqn accelerator(options), restarted(options);
  auto x = zero(map);
  ASSERT_LT(corrections(accelerator, map, x, 1e-6), 200);
  WrittenArchive archive = archive_of(accelerator);
  restarted.keep(archive.turn());
  const AddedMassMap next{12, 10.0, 0.3};
  auto y = x;
  corrections(accelerator, next, x, 1e-6);
  corrections(restarted, next, y, 1e-6);
  EXPECT_EQ(x, y);
  EXPECT_EQ(archive_of(accelerator).arrays, archive_of(restarted).arrays);
}

TEST(NewtonKrylov, NeedsABaseAndADirectionPerDimensionOnALinearProblem) {
  for (const int n : {1, 3, 6}) {
    NewtonKrylov method(unfiltered());
    const AddedMassMap map{n};
    auto x = zero(map);
    // Each Newton step builds at most n directions; its forcing leaves a tenth at first, far less at last.
    EXPECT_LE(corrections(method, map, x, 1e-8), 4 * (n + 1)) << n;
  }
}

TEST(NewtonKrylov, ConvergesOnANonlinearMap) {
  NewtonKrylov method(QuasiNewtonOptions{});
  const AddedMassMap map{20, 50.0};
  auto x = zero(map);
  EXPECT_LE(corrections(method, map, x, 1e-9), 100);
}

TEST(NewtonKrylov, KnowsALinearProblemInTheNextStep) {
  NewtonKrylov method(unfiltered());
  AddedMassMap map{6};
  auto x = zero(map);
  corrections(method, map, x, 1e-8);
  map.shift = 1;
  EXPECT_LE(corrections(method, map, x, 1e-8), 3) << "one product and a base point, or two";
}

TEST(NewtonKrylov, GoesOnBitForBitFromItsMemory) {
  const AddedMassMap map{12, 10.0}, next{12, 10.0, 0.3};
  NewtonKrylov method(QuasiNewtonOptions{}), restarted(QuasiNewtonOptions{});
  auto x = zero(map);
  corrections(method, map, x, 1e-6);
  WrittenArchive archive = archive_of(method);
  restarted.keep(archive.turn());
  auto y = x;
  EXPECT_EQ(corrections(method, next, x, 1e-6), corrections(restarted, next, y, 1e-6));
  EXPECT_EQ(x, y);
}

TEST(NewtonKrylov, SurvivesAZeroResidualAndAPassCutShort) {
  NewtonKrylov method(QuasiNewtonOptions{});
  const AddedMassMap map{5};
  auto x = zero(map);
  method.start();
  method.correct(x, std::vector<double>(5, 0.0));
  EXPECT_EQ(x, zero(map));
  method.start();
  const auto base = x;
  method.correct(x, map.residual(x));
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = base[i] + 0.25 * (x[i] - base[i]);
  for (int k = 0; k < 60 && norm(map.residual(x)) > 1e-9; ++k) method.correct(x, map.residual(x));
  EXPECT_LE(norm(map.residual(x)), 1e-9);
}

/// Corrections of a linear system until |r| <= tolerance.
int linear_corrections(AffineMap& method, const AddedMassMap& map, std::vector<double> x, double tolerance) {
  std::vector<double> r = map.residual(x);
  int count = 0;
  while (norm(r) > tolerance && count < 100) {
    const std::vector<double> dx = method.correction(r);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx[i];
    r = map.residual(x);
    method.learn(r, 0);
    ++count;
  }
  return count;
}

TEST(AffineMap, NeedsACorrectionPerDimensionAndOneMore) {
  for (const int n : {1, 3, 8}) {
    AffineMap method(50, 0);
    const AddedMassMap map{n};
    EXPECT_LE(linear_corrections(method, map, zero(map), 1e-9), n + 1) << n;
  }
}

TEST(AffineMap, KnowsTheSlopeInTheNextSystem) {
  AffineMap method(50, 0);
  AddedMassMap map{8};
  linear_corrections(method, map, zero(map), 1e-10);
  map.shift = 1;
  EXPECT_LE(linear_corrections(method, map, zero(map), 1e-8), 2);
}

// Of another slope the pairs are no more than a guess, but a good one where it is much alike.
TEST(AffineMap, GuessesTheNextSlopeByTheLast) {
  AffineMap method(50, 0), fresh(50, 0);
  const AddedMassMap map{12, 1e-3};
  linear_corrections(method, map, zero(map), 1e-10);
  method.renew();
  EXPECT_EQ(method.columns() > 0, true);
  EXPECT_LT(linear_corrections(method, map, zero(map), 1e-4), linear_corrections(fresh, map, zero(map), 1e-4));
  method.clear();
  EXPECT_EQ(method.columns(), 0);
}

// What is off by rounding in one small residual is off for good in the pair made of it: without mending, a part of each
// later residual would stay.
TEST(AffineMap, MendsAPairThatIsOff) {
  AffineMap method(50, 0);
  AddedMassMap map{8};
  std::vector<double> x = zero(map), r = map.residual(x);
  for (int k = 0; k < 8; ++k) {
    const std::vector<double> dx = method.correction(r);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx[i];
    r = map.residual(x);
    std::vector<double> read = r;
    if (k == 3)
      for (double& value : read) value *= 3;
    method.learn(read, 0);
  }
  ASSERT_EQ(method.columns(), 8);
  map.shift = 1;
  linear_corrections(method, map, zero(map), 1e-6);
  map.shift = 2;
  EXPECT_LE(linear_corrections(method, map, zero(map), 1e-6), 4);
}

TEST(AffineMap, KeepsTheLatestPairs) {
  AffineMap method(3, 0);
  const AddedMassMap map{12};
  linear_corrections(method, map, zero(map), 1e-6);
  EXPECT_EQ(method.columns(), 3);
}

TEST(AffineMap, GoesOnBitForBitFromItsMemory) {
  AffineMap method(5, 1e-2), restarted(5, 1e-2);
  AddedMassMap map{12};
  linear_corrections(method, map, zero(map), 1e-6);
  WrittenArchive archive;
  method.keep(archive, "map");
  restarted.keep(archive.turn(), "map");
  const std::vector<double> r = map.residual(zero(map));
  EXPECT_EQ(method.correction(r), restarted.correction(r));
  map.shift = 0.3;
  EXPECT_EQ(linear_corrections(method, map, zero(map), 1e-8), linear_corrections(restarted, map, zero(map), 1e-8));
  EXPECT_EQ(method.correction(r), restarted.correction(r));
}

TEST(CouplingSchemes, EveryNameOfTheCaseReaderHasARow) {
  for (const auto& name : coupling_scheme_names()) {
    const auto& scheme = coupling_scheme(name);
    EXPECT_EQ(scheme.name, name);
    if (name != "block-newton") {
      EXPECT_NE(scheme.make_accelerator({}, {}), nullptr);
    }
    EXPECT_NE(std::string(scheme.advice), "");
  }
  EXPECT_THROW(coupling_scheme("aitkin"), InputError);
}

}  // namespace

}  // namespace fsi::test
