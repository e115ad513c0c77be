// Oscillating flow on openings: Bessel functions on circles, hyperbolic ones on segments, discrete solutions elsewhere.

#include <gtest/gtest.h>

#include <complex>

#include "fem/elements.hpp"
#include "fluid/opening_profile.hpp"
#include "fluid/womersley_inflow.hpp"
#include "opening_meshes.hpp"
#include "support/bessel_series.hpp"
#include "support/pi.hpp"

namespace fsi::test {

namespace {

constexpr double density = 1.06, viscosity = 3.5e-3;

/// One mode: samples of a cosine so close that their corners do not count.
PeriodicFlow cosine(double period, double mean, double amplitude) {
  PeriodicFlow flow{period, {}};
  constexpr int samples = 4000;
  for (int i = 0; i < samples; ++i)
    flow.points.emplace_back(period * i / samples, mean + amplitude * std::cos(2 * pi * i / samples));
  return flow;
}

/// Womersley's profile of unit flow [Womersley1955], by the power series of Bessel functions.
Complex womersley(double radius, double alpha, double r) {
  const Complex l = alpha / radius * std::polar(1.0, 0.75 * pi);
  const Bessel rim(l * radius), at(l * r);
  const Complex flow = pi * radius * radius * (1.0 - 2.0 * rim.j1 / (l * radius * rim.j0));
  return (1.0 - at.j0 / rim.j0) / flow;
}

/// Against the closed form at four times of the period, largest error over the largest velocity.
double pipe_error(int n, double period) {
  constexpr double radius = 1.4;
  const auto opening = line_opening<P2P1AxisymmetricTriangle>({0, 0, 0}, {radius, 0, 0}, n, false, true);
  const auto inflow = womersley_inflow(opening, cosine(period, 2, 5), density, viscosity);
  EXPECT_EQ(inflow.modes(), 1);
  EXPECT_EQ(inflow.instead(), "");
  const double w = 2 * pi / period, alpha = radius * std::sqrt(w * density / viscosity);
  double error = 0, most = 0;
  std::vector<double> velocity(2 * opening.nodes.size(), 3.0);
  for (int i = 0; i < 4; ++i) {
    const double time = period * (7 + 0.25 * i);
    inflow.set(time, velocity);
    EXPECT_NEAR(discrete_inflow(opening, velocity), inflow.flow().at(time), 1e-12);
    for (std::size_t a = 0; a < opening.nodes.size(); ++a) {
      const double r = opening.nodes[a][0];
      const double exact = 2 * 2 / (pi * radius * radius) * (1 - r * r / (radius * radius)) +
                           5 * (womersley(radius, alpha, r) * std::polar(1.0, w * time)).real();
      EXPECT_EQ(velocity[2 * a], 0);
      error = std::max(error, std::abs(velocity[2 * a + 1] - exact));
      most = std::max(most, std::abs(exact));
    }
  }
  return error / most;
}

TEST(WomersleyInflow, InAPipeIsWomersleysFlowWhateverTheFrequency) {
  // Womersley numbers 0.02, 2.2, 22: the scaling to the discrete flow is what is left of the error.
  EXPECT_LT(pipe_error(6, 8e6), 1e-6);
  EXPECT_LT(pipe_error(12, 800), 1e-4);
  EXPECT_LT(pipe_error(48, 8), 1e-4);
  EXPECT_GT(std::log2(pipe_error(6, 800) / pipe_error(12, 800)), 2.9);
}

TEST(WomersleyInflow, InAChannelIsThatOfParallelPlates) {
  const auto opening = line_opening<P2P1PlaneTriangle>({0, 0, 0}, {0, -2, 0}, 40, true, true);
  constexpr double period = 20, half = 1;
  const auto inflow = womersley_inflow(opening, cosine(period, 0, 1), density, viscosity);
  std::vector<double> velocity(2 * opening.nodes.size());
  const Complex l = std::sqrt(Complex(0, 2 * pi / period * density / viscosity));
  const Complex flow = 2 * half * (1.0 - std::tanh(l * half) / (l * half));
  for (double time : {0.0, 6.0}) {
    inflow.set(time, velocity);
    for (std::size_t a = 0; a < opening.nodes.size(); ++a) {
      const Complex w = (1.0 - std::cosh(l * (opening.nodes[a][1] + 1)) / std::cosh(l * half)) / flow;
      EXPECT_NEAR(velocity[2 * a], (w * std::polar(1.0, 2 * pi / period * time)).real(), 2e-5);
    }
  }
}

/// The discrete solution on a disk taken for any shape, against Bessel functions: u(0) of modes at Womersley number 6.
template <class Element>
double disk_error(int m) {
  const auto opening =
      flat_opening<Element>(disk(1, 5 * m, 16 * m), everywhere, [](const Point& x) { return (1 / norm(x)) * x; });
  const auto nodes = facet_nodes(opening.facets);
  const auto w = developed_flow(opening, nodes, Complex(0, 36));
  const Complex l = 6.0 * std::polar(1.0, 0.75 * pi);
  const Complex exact = (1.0 - 1.0 / Bessel(l).j0) / Complex(0, 36);
  return std::abs(w[0] - exact) / std::abs(exact);
}
TEST(WomersleyInflow, DiscreteProfileConvergesToBesselFunctions) {
  EXPECT_NEAR(std::log2(disk_error<P1Tetrahedron>(1) / disk_error<P1Tetrahedron>(2)), 2, 0.35);
  EXPECT_GT(std::log2(disk_error<P2P1Tetrahedron>(1) / disk_error<P2P1Tetrahedron>(2)), 2.8);
  EXPECT_LT(disk_error<P2P1Tetrahedron>(2), 1e-3);
}

TEST(WomersleyInflow, FlowIsThatAskedForAtAnyTimeAndOnAnyOpening) {
  // A heart beat's shape, with corners: a systole and a small backflow.
  const PeriodicFlow beat{800, {{0, 3}, {60, 21}, {140, 30}, {260, 12}, {320, -4}, {380, 5}, {600, 4}}};
  const auto duct = flat_opening<P1Tetrahedron>(rectangle(2, 1, 8, 4), everywhere);
  const auto round = flat_opening<P2P1Tetrahedron>(disk(1.4, 4, 16), everywhere);
  const auto on_duct = womersley_inflow(duct, beat, density, viscosity);
  const auto on_disk = womersley_inflow(round, beat, density, viscosity);
  EXPECT_EQ(on_duct.instead(),
            "the surface in is no flat circle: the flow that is fully developed on its own facets is let in, the "
            "discrete solution of "
            "-Laplace w = 1");
  EXPECT_EQ(on_disk.instead(), "");
  EXPECT_GT(on_disk.modes(), 5);
  EXPECT_LT(on_disk.modes(), 64);
  std::vector<double> u(3 * duct.nodes.size(), 0.0), v(3 * round.nodes.size(), 0.0);
  for (double time : {0.0, 33.0, 60.0, 290.0, 799.0, 8290.0}) {
    on_duct.set(time, u);
    on_disk.set(time, v);
    EXPECT_NEAR(discrete_inflow(duct, u), beat.at(time), 1e-12);
    EXPECT_NEAR(discrete_inflow(round, v), beat.at(time), 1e-12);
    on_disk.set(time, -17.5, v);
    EXPECT_NEAR(discrete_inflow(round, v), -17.5, 1e-12);
  }
}

TEST(WomersleyInflow, AConstantRateIsTheParabola) {
  const auto opening = flat_opening<P1Tetrahedron>(disk(1.4, 4, 16), everywhere);
  const auto inflow = womersley_inflow(opening, {800, {{0, 3}}}, density, viscosity);
  EXPECT_EQ(inflow.modes(), 0);
  std::vector<double> velocity(3 * opening.nodes.size());
  inflow.set(100, velocity);
  const auto parabola = parabolic_inflow(opening).velocity;
  for (std::size_t i = 0; i < velocity.size(); ++i) EXPECT_NEAR(velocity[i], 3 * parabola[i], 1e-14);
}

}  // namespace

}  // namespace fsi::test
