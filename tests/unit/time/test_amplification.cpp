// What the time schemes of second order do to free motions of any frequency (docs/theory.md, sections 8.5 to 8.8).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "marching.hpp"
#include "time/bdf2.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

/// d'' = -w^2 d of a wall of one node, from d = 1 and d' = 0.
class Oscillator {
 public:
  Oscillator(const TimeIntegrator& scheme, double frequency)
      : scheme_(scheme), square_(frequency * frequency), state_(started(scheme, {{}, {}, {1, 0}}, 1)) {
    if (!state_.velocity_rate.empty()) state_.velocity_rate[0] = -square_;  // of schemes that keep it
  }

  void step(double length) {
    march_step(scheme_, state_, state_.time + length, {}, [&](State& state, const StepData& data) {
      const StepRates& r = data.rates;
      state.now.wall[0] = -r.acceleration_history[0] / (r.acceleration_factor + square_);
    });
  }
  double displacement() const { return state_.before[0].wall[0]; }
  /// Relative to the first.
  double energy() const {
    return std::pow(displacement(), 2) + state_.wall_velocity[0] * state_.wall_velocity[0] / square_;
  }

 private:
  const TimeIntegrator& scheme_;
  double square_;
  State state_;
};

/// u' = -l u of a fluid of one node with l without bound: u = 0 in each balance. Levels from one step on.
std::vector<double> stiffest_decay(const TimeIntegrator& scheme, int steps, double length) {
  State state = started(scheme, {{}, {1, 0}, {}}, 0);
  std::vector<double> levels;
  for (int i = 0; i < steps; ++i) {
    march_step(scheme, state, state.time + length, {}, [](State& at, const StepData&) { at.now.fluid[0] = 0; });
    levels.push_back(state.before[0].fluid[0]);
  }
  return levels;
}

TEST(Amplification, MidpointRuleAlternatesAtInfiniteFrequencyAndItsShiftDampsThat) {
  const double rate = 0.4, step = 0.125, theta = 0.5 + rate * step;
  const auto levels = stiffest_decay(ShiftedMidpoint<1>(rate), 160, step);
  for (std::size_t i = 0; i < levels.size(); ++i)
    EXPECT_NEAR(levels[i], std::pow(-(1 - theta) / theta, i + 1.0), 1e-13) << i;
  // exp(-4 damping t) up to terms in dt^2
  EXPECT_NEAR(std::log(std::abs(levels.back())), -4 * rate * 160 * step, 0.01 * 4 * rate * 160 * step);
  for (double u : stiffest_decay(ShiftedMidpoint<1>(0), 5, step)) EXPECT_EQ(std::abs(u), 1);
}

// Long steps: theta is at most one, backward Euler's.
TEST(Amplification, MidpointRuleWithLongStepsIsBackwardEuler) {
  const ShiftedMidpoint<1> scheme(0.4);
  Oscillator oscillator(scheme, 1);
  oscillator.step(5);
  EXPECT_NEAR(oscillator.displacement(), 1.0 / 26, 1e-15);  // d + 25 d = 1
  EXPECT_EQ(stiffest_decay(scheme, 1, 5)[0], 0);
}

TEST(Amplification, BackwardDifferencesForgetTheStiffestInAStep) {
  for (double u : stiffest_decay(Bdf2<1>(), 4, 0.1)) EXPECT_EQ(u, 0);
  for (double u : stiffest_decay(TrBdf2<1>(), 4, 0.1)) EXPECT_EQ(u, 0);
}

TEST(Amplification, GeneralisedAlphaMultipliesTheStiffestByMinusRho) {
  for (double rho : {0.0, 0.5, 0.8}) {
    const auto levels = stiffest_decay(GeneralisedAlpha<1>(rho), 6, 0.1);
    for (std::size_t i = 0; i < levels.size(); ++i) EXPECT_NEAR(levels[i], std::pow(-rho, i + 1.0), 1e-15) << rho;
  }
}

TEST(Amplification, MidpointRuleKeepsTheEnergyWhateverTheStepsAndItsShiftTakesAFormulasShare) {
  const ShiftedMidpoint<1> scheme(0), shifted(0.4);
  Oscillator keeps(scheme, 3), loses(shifted, 3);
  double left = 1;
  for (int i = 0; i < 100; ++i) {
    const double step = i % 2 ? 0.3 : 0.1, theta = 0.5 + 0.4 * step, phase = 9 * step * step;
    keeps.step(step);
    loses.step(step);
    left *= (1 + (1 - theta) * (1 - theta) * phase) / (1 + theta * theta * phase);
    EXPECT_NEAR(keeps.energy(), 1, 1e-13);
    EXPECT_NEAR(loses.energy(), left, 1e-13);
  }
}

class FreeMotion : public testing::TestWithParam<int> {
 protected:
  static std::shared_ptr<const TimeIntegrator> scheme() {
    if (GetParam() == 0) return std::make_shared<ShiftedMidpoint<1>>(0.4);
    if (GetParam() == 1) return std::make_shared<Bdf2<1>>();
    if (GetParam() == 2) return std::make_shared<TrBdf2<1>>();
    return std::make_shared<GeneralisedAlpha<1>>(0.5);
  }
};
INSTANTIATE_TEST_SUITE_P(Schemes, FreeMotion, testing::Range(0, 4));

// A-stability: no frequency grows with any step. The multistep schemes may pass the first energy in the first steps.
TEST_P(FreeMotion, OfNoFrequencyGrows) {
  for (double frequency : {0.01, 0.1, 0.3, 1.0, 2.0, 5.0, 20.0, 1e3, 1e5}) {
    const auto integrator = scheme();
    Oscillator oscillator(*integrator, frequency);
    std::vector<double> energies;
    for (int i = 0; i < 200; ++i) {
      oscillator.step(1);
      energies.push_back(oscillator.energy());
    }
    const auto later = energies.begin() + 100;
    EXPECT_LE(*std::max_element(later, energies.end()), *std::max_element(energies.begin(), later)) << frequency;
    EXPECT_LE(energies.back(), 1) << frequency;
    if (frequency >= 5) {
      EXPECT_LT(energies.back(), 1e-6) << frequency;
    }
  }
}

// Energy that the scheme takes from a motion that is resolved: the fraction lost to a given time falls with the square
// of the step (shifted midpoint rule) or its cube.
TEST_P(FreeMotion, OfAResolvedFrequencyLosesEnergyOfItsOrder) {
  const auto lost = [&](int steps) {
    const auto integrator = scheme();
    Oscillator oscillator(*integrator, 2);
    for (int i = 0; i < steps; ++i) oscillator.step(6.0 / steps);
    return std::abs(1 - oscillator.energy());
  };
  const double order = std::log2(lost(480) / lost(960));
  EXPECT_GT(order, 1.9) << lost(480);
  EXPECT_LT(lost(960), 1e-3);
}

}  // namespace

}  // namespace fsi::test
