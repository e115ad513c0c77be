#include "observers/ringing_remedy.hpp"

#include <gtest/gtest.h>

#include "time/time_schemes.hpp"

namespace fsi::test {

namespace {

/// 31 Pa after a pulse of 1,334 Pa, whose steps were solved to this part of what they changed.
Ringing after_the_pulse(double solver_error, const std::string& scheme = "midpoint") {
  return {0.031, 0.78, 1.334, solver_error, false, prototype(scheme)->against_ringing()};
}

Case in_time() {
  Case setup;
  setup.time = TimeData{};
  return setup;
}

TEST(RingingRemedy, BlamesTheTimeSchemeWhereTheSolverLeavesTooLittle) {
  EXPECT_EQ(
      said_of(after_the_pulse(1e-6), in_time()),
      "the pressure alternates from step to step, by 31 Pa at t = 0.78 ms: the time scheme does not damp what its "
      "steps cannot resolve; give a larger time.damping");
  EXPECT_NE(said_of(after_the_pulse(0, "generalised-alpha"), in_time()).find("; give a smaller time.spectral_radius"),
            std::string::npos);
}

TEST(RingingRemedy, NamesTheSolversToleranceFirstWhereItCanBeTheCause) {
  Case setup = in_time();
  setup.newton.tolerance = 0.3;
  EXPECT_EQ(said_of(after_the_pulse(0.02), setup),
            "the pressure alternates from step to step, by 31 Pa at t = 0.78 ms: what the solver leaves of a step, "
            "0.02 times what that changes, can be the cause; give newton.tolerance = 3e-03, and if the "
            "pressure still "
            "alternates, the time scheme does not damp what its steps cannot resolve: give a larger time.damping");
  setup.newton.error_tolerance = 0.05;
  EXPECT_NE(said_of(after_the_pulse(0.02), setup).find("; give newton.error_tolerance = 5e-04, and if"),
            std::string::npos);
}

TEST(RingingRemedy, NamesTheCouplingsToleranceInThePartitionedDriver) {
  Case setup = in_time();
  setup.partitioned.tolerance = 0.01;
  Ringing ringing = after_the_pulse(0.1);
  ringing.coupled = true;
  EXPECT_NE(said_of(ringing, setup).find("; give partitioned.tolerance = 1e-04, and if"), std::string::npos);
  setup.partitioned.tolerance_of = ToleranceOf::displacement;
  EXPECT_NE(said_of(ringing, setup).find("; give partitioned.tolerance_of = \"pressure\", and if"), std::string::npos);
}

}  // namespace

}  // namespace fsi::test
