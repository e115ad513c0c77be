// What is iterated and what factorised, and what follows a failure.
#include <gtest/gtest.h>

#include "linear/policy/attempts.hpp"
#include "linear/policy/solver_policy.hpp"

namespace fsi::test {

namespace {

struct Limit {
  SolvedSystem system;
  int dimension;
  std::int64_t factorised_below;
};

class SizesOfSystems : public ::testing::TestWithParam<Limit> {};

TEST_P(SizesOfSystems, DecideWithTheirReason) {
  const auto [system, dimension, limit] = GetParam();
  const SolverPolicy policy(system, dimension);
  EXPECT_EQ(policy.factorises_below(), limit);
  const SolverDecision small = policy.decide(limit - 1), large = policy.decide(limit);
  EXPECT_FALSE(small.iterates);
  EXPECT_TRUE(large.iterates);
  EXPECT_EQ(small.reason.find("factorised: " + std::to_string(limit - 1)), 0u) << small.reason;
  EXPECT_EQ(large.reason.find("iterated: " + std::to_string(limit)), 0u) << large.reason;
}

INSTANTIATE_TEST_SUITE_P(SolverPolicy, SizesOfSystems,
                         ::testing::Values(Limit{SolvedSystem::jacobian, 2, 200000},
                                           Limit{SolvedSystem::jacobian, 3, 2000},
                                           Limit{SolvedSystem::harmonic_mesh_motion, 2, 200000},
                                           Limit{SolvedSystem::harmonic_mesh_motion, 3, 30000},
                                           Limit{SolvedSystem::tangent_mesh_motion, 2, 50000},
                                           Limit{SolvedSystem::tangent_mesh_motion, 3, 6000},
                                           Limit{SolvedSystem::shared_mesh_motion, 2, 200000},
                                           Limit{SolvedSystem::shared_mesh_motion, 3, 2000},
                                           Limit{SolvedSystem::shared_schur_complement, 2, 20000},
                                           Limit{SolvedSystem::shared_schur_complement, 3, 2000}));

TEST(SolverPolicy, FactorisesTheSchurComplementInThePlaneOnly) {
  EXPECT_FALSE(SolverPolicy(SolvedSystem::schur_complement, 2).decide(10'000'000).iterates);
  EXPECT_TRUE(SolverPolicy(SolvedSystem::schur_complement, 3).decide(1).iterates);
}

TEST(SolverPolicy, TheCaseComesBeforeTheTableAndOptionsOfTheIterationBeforeBoth) {
  const SolverPolicy demanded(SolvedSystem::jacobian, 3, {500});
  EXPECT_FALSE(demanded.decide(499).iterates);
  EXPECT_TRUE(demanded.decide(500).iterates);
  EXPECT_EQ(demanded.decide(499).reason, "factorised: 499 unknowns, the limit is 500 as the case demands");
  const SolverPolicy optioned(SolvedSystem::jacobian, 3, {500, true});
  EXPECT_EQ(optioned.factorises_below(), 0);
  EXPECT_TRUE(optioned.decide(10).iterates);
  EXPECT_EQ(optioned.decide(10).reason, "iterated: the case has options of the iteration");
  const SolverPolicy shared(SolvedSystem::jacobian, 3, {{}, false, 4});
  EXPECT_EQ(shared.decide(10).reason, "factorised at the first process: 10 unknowns, the limit is 2000");
}

TEST(SolverPolicy, TheWallDecidesAboutLargerJacobiansOfThePlane) {
  const SolverPolicy plane(SolvedSystem::jacobian, 2), space(SolvedSystem::jacobian, 3);
  EXPECT_FALSE(plane.wall_decides(9999));
  EXPECT_TRUE(plane.wall_decides(10000));
  EXPECT_TRUE(plane.wall_decides(199999));
  EXPECT_FALSE(plane.wall_decides(200000));
  EXPECT_FALSE(space.wall_decides(10000));
  EXPECT_FALSE(SolverPolicy(SolvedSystem::jacobian, 2, {200000}).wall_decides(10000)) << "the case has decided";
  EXPECT_FALSE(SolverPolicy(SolvedSystem::jacobian, 2, {{}, true}).wall_decides(10000));
  EXPECT_FALSE(SolverPolicy(SolvedSystem::harmonic_mesh_motion, 2).wall_decides(10000));
  EXPECT_TRUE(plane.decide_by_wall(3.9).iterates);
  EXPECT_FALSE(plane.decide_by_wall(4).iterates);
  EXPECT_EQ(plane.decide_by_wall(9).reason, "factorised: the wall's stiffness is 9 times its inertia, the limit is 4");
  EXPECT_NE(SolverPolicy::rule_of_wall().find("below 4 times"), std::string::npos);
}

TEST(SolverPolicy, AnIterationOfAJacobianIsStrengthenedOnce) {
  EXPECT_EQ(SolverPolicy(SolvedSystem::jacobian, 3).strengthenings(), 1);
  EXPECT_EQ(SolverPolicy(SolvedSystem::tangent_mesh_motion, 3).strengthenings(), 0);
}

/// Attempts of which the first `failures` fail; `log` gets a letter for each call.
Attempts failing(int failures, int strengthenings, std::string& log, bool with_rescue = true) {
  Attempts attempts{[failures, &log]() mutable {
                      log += 'a';
                      return failures-- <= 0;
                    },
                    [&log] { log += 's'; },
                    strengthenings,
                    {}};
  if (with_rescue)
    attempts.rescue = [&log] {
      log += 'r';
      return true;
    };
  return attempts;
}

TEST(Attempts, AreStrengthenedAndThenRescued) {
  const auto calls = [](int failures, int strengthenings) {
    std::string log;
    EXPECT_TRUE(failing(failures, strengthenings, log).run());
    return log;
  };
  EXPECT_EQ(calls(0, 2), "a");
  EXPECT_EQ(calls(1, 2), "asa");
  EXPECT_EQ(calls(9, 2), "asasar");
  EXPECT_EQ(calls(9, 0), "ar");
}

TEST(Attempts, WithoutARescueFail) {
  std::string log;
  EXPECT_FALSE(failing(9, 1, log, false).run());
  EXPECT_EQ(log, "asa");
}

}  // namespace

}  // namespace fsi::test
