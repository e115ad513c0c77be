// Numbers without unit give wrong units away, and name those that would explain them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "run/plausibility.hpp"

namespace fsi::test {

namespace {

/// Of a flow in a tube of blood: rho = 1.06 mg/mm^3, mu = 4e-3 kPa ms.
DerivedNumbers tube(double diameter, double flow, double period = 800) {
  constexpr double pi = 3.14159265358979323846, rho = 1.06, mu = 4e-3;
  OpeningFlow opening;
  opening.surface = "inlet";
  opening.diameter = diameter;
  opening.velocity = flow / (pi * diameter * diameter / 4);
  opening.reynolds = rho * opening.velocity * diameter / mu;
  opening.womersley = diameter / 2 * std::sqrt(2 * pi * rho / (period * mu));
  DerivedNumbers numbers;
  numbers.flows.push_back(opening);
  return numbers;
}

std::string warning_of(const DerivedNumbers& numbers) {
  const auto warnings = implausible_numbers(numbers);
  return warnings.empty() ? "" : warnings.front();
}

void expect_named(const std::string& warning, const std::string& unit) {
  EXPECT_NE(warning.find(unit), std::string::npos) << "'" << warning << "' without " << unit;
}

TEST(Plausibility, OfVesselsSaysNothing) {
  EXPECT_EQ(warning_of(tube(25, 400)), "") << "an aorta in exercise";
  EXPECT_EQ(warning_of(tube(2.86, 1)), "");
  EXPECT_EQ(warning_of(tube(0.01, 1e-7)), "") << "a capillary of 1.3 mm/s";
}

TEST(Plausibility, NamesAMeshInCentimetres) {
  const std::string said = warning_of(tube(2.5, 400));  // 81 m/s, Reynolds number 54,000
  expect_named(said, "up to 81.5 m/s in the mean, Reynolds number 5.4e+04");
  expect_named(said, "the mesh in cm");
  expect_named(warning_of(tube(0.025, 400)), "the mesh in m");
}

TEST(Plausibility, NamesUnitsOfFlowsAndTimes) {
  expect_named(warning_of(tube(25, 5000)), "flows in ml/min");
  expect_named(warning_of(tube(2.86, 1000)), "flows in mm^3/s");
  expect_named(warning_of(tube(25, 4e-4)), "flows in m^3/s");
  expect_named(warning_of(tube(25, 80, 0.8)), "times in s");
}

TEST(Plausibility, NamesPressuresWhereTheyDriveTheFlow) {
  DerivedNumbers numbers = tube(1.2, 1);
  OpeningFlow& flow = numbers.flows.front();
  flow.drive = {100, 100, 800, 1.06, 4e-3};  // 100 mmHg taken for kPa: viscosity allows least
  flow.velocity = driven_velocity(*flow.drive, flow.diameter);
  EXPECT_NEAR(flow.velocity, 11.25, 1e-12);
  flow.reynolds = 1.06 * flow.velocity * 1.2 / 4e-3;
  const std::string said = warning_of(numbers);
  expect_named(said, "at most about 11.2 m/s in the mean, Reynolds number 3.58e+03");
  expect_named(said, "pressures in mmHg");
  EXPECT_EQ(said.find("flows in"), std::string::npos) << said;
}

TEST(Plausibility, AsksTheWall) {
  DerivedNumbers numbers = tube(25, 400);
  numbers.wave_speed = 5;
  numbers.load = 16;
  numbers.strain = numbers.load / (2 * 1.06 * 25);  // 0.30
  EXPECT_EQ(warning_of(numbers), "");
  numbers.load = 120;
  numbers.strain = numbers.load / (2 * 1.06 * 25);  // 2.3
  expect_named(warning_of(numbers), "pressures in mmHg");
  numbers.stiffens = true;
  EXPECT_EQ(warning_of(numbers), "");
  DerivedNumbers soft = tube(25, 400);
  soft.wave_speed = 0.16;  // moduli a thousand times too small
  expect_named(warning_of(soft), "times as fast as pressure waves");
  expect_named(warning_of(soft), "moduli in MPa");
}

}  // namespace

}  // namespace fsi::test
