// Centre lines against straight axes and circles, the harmonic coordinate against closed forms.

#include "sampling/centre_line.hpp"

#include <gtest/gtest.h>

#include <array>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"
#include "sampling/harmonic_coordinate.hpp"
#include "sampling/smooth_curve.hpp"
#include "support/pi.hpp"
#include "support/vessels.hpp"

namespace fsi::test {
namespace {

TEST(SmoothCurve, ThroughACircleItErrsByTheFourthPowerInsideAndKeepsItsLength) {
  double before = 0;
  for (const int pieces : {10, 20, 40}) {
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i) points.push_back(on_bend(5, 7.5 * i / pieces));
    const SmoothCurve curve(points);
    EXPECT_EQ(curve.at(0), points.front());
    EXPECT_EQ(curve.at(curve.length()), points.back());
    // Off the circle, away from the ends whose slopes come from one side.
    double worst = 0;
    for (double part = 0.3; part <= 0.7; part += 0.013)
      worst = std::max(worst, std::abs(distance(curve.at(part * curve.length()), {5, 0, 0}) - 5));
    EXPECT_NEAR(curve.length(), 7.5, 0.05 / (pieces * pieces));
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / worst), 4, 0.4) << pieces;
    }
    before = worst;
  }
}

TEST(HarmonicCoordinate, IsLinearAlongAStraightTube) {
  const auto tube = straight_vessel<1>(3, 2, 6);
  const auto h = harmonic_coordinate<3>(tube.part.nodes, vertices_of_cells(tube.part), facet_nodes(tube.inlet),
                                        facet_nodes(tube.outlet));
  for (std::size_t a = 0; a < h.size(); ++a) EXPECT_NEAR(h[a], tube.part.nodes[a][2] / 3, 1e-9);
}

/// Between two spheres a cone's harmonic coordinate is (1/r1 - 1/r) / (1/r1 - 1/r2), r from its tip.
double cone_error(int across, int along) {
  auto tube = straight_vessel<1>(1, across, along);
  const double near = 4, far = 2;  // a tube that tapers to half its radius
  for (Point& x : tube.part.nodes) {
    const double away = near + (far - near) * x[2], angle = 0.4 * std::hypot(x[0], x[1]);
    const double round = std::atan2(x[1], x[0]);
    x = {away * std::sin(angle) * std::cos(round), away * std::sin(angle) * std::sin(round), -away * std::cos(angle)};
  }
  const auto h = harmonic_coordinate<3>(tube.part.nodes, vertices_of_cells(tube.part), facet_nodes(tube.inlet),
                                        facet_nodes(tube.outlet));
  double square = 0;
  for (std::size_t a = 0; a < h.size(); ++a)
    square += std::pow(h[a] - (1 / near - 1 / norm(tube.part.nodes[a])) / (1 / near - 1 / far), 2);
  return std::sqrt(square / static_cast<double>(h.size()));
}

TEST(HarmonicCoordinate, OfATaperedTubeConvergesToTheClosedForm) {
  const double coarse = cone_error(2, 4), fine = cone_error(4, 8);
  std::printf("harmonic coordinate of a cone: off by %.2e and %.2e (root mean square)\n", coarse, fine);
  EXPECT_LT(coarse, 0.02);
  EXPECT_GT(std::log2(coarse / fine), 1.6);
}

template <int Order>
void expect_axis(double tolerance) {
  auto tube = straight_vessel<Order>(4, 2, 6);
  // Anywhere, in any direction: x becomes y, y becomes z, z becomes x.
  for (Point& x : tube.part.nodes) x = {x[2] + 7, x[0] - 2, x[1] + 1};
  const auto line = centre_line<3, Order>(tube.part, tube.inlet, tube.outlet, 9);
  ASSERT_EQ(line.at.size(), 9u);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(line.s[i], 0.5 * i, tolerance);
    EXPECT_LT(distance(line.at[i], {7 + 0.5 * i, -2, 1}), tolerance);
  }
  // The other way round.
  const auto back = centre_line<3, Order>(tube.part, tube.outlet, tube.inlet, 3);
  EXPECT_LT(distance(back.at[0], {11, -2, 1}), tolerance);
}

TEST(CentreLine, OfAStraightTubeIsItsAxis) {
  expect_axis<1>(1e-7);
  expect_axis<2>(1e-7);
}

template <int Order>
double torus_error(int across, int along, double& length) {
  constexpr double bend = 5, arc = 5 * pi / 2;
  auto tube = straight_vessel<Order>(arc, across, along);
  bend_about(bend, tube.part);
  const auto line = centre_line<3, Order>(tube.part, tube.inlet, tube.outlet, 50);
  length = line.s.back();
  double worst = 0;
  for (std::size_t i = 0; i < line.at.size(); ++i)
    worst = std::max(worst, distance(line.at[i], on_bend(bend, line.s[i])));
  return worst;
}

TEST(CentreLine, OfATorusConvergesToItsCircle) {
  double length = 0;
  const double coarse = torus_error<1>(2, 8, length), middle = torus_error<1>(4, 16, length);
  std::printf("centre line of a torus, linear cells: off by %.2e and %.2e mm\n", coarse, middle);
  EXPECT_LT(coarse, 0.15);
  EXPECT_GT(std::log2(coarse / middle), 1.6);
  EXPECT_NEAR(length, 5 * pi / 2, 0.05);
  const double quadratic = torus_error<2>(3, 12, length);
  std::printf("quadratic cells: %.2e mm\n", quadratic);
  EXPECT_LT(quadratic, coarse);
}

TEST(CentreLine, BetweenPlanesOfSymmetryIsThatOfTheWholeTube) {
  for (const int degrees : {180, 90, 60}) {  // one plane; two at right angles; two, one of them oblique
    const auto mesh = tube_mesh(4, 2, 6, degrees);
    const auto tube = fluid_of(mesh);
    const auto line =
        centre_line<3, 1>(tube.part, tube.inlet, tube.outlet, 9, false, of_part(mirror_planes(mesh), tube.part));
    for (int i = 0; i < 9; ++i) {
      const Point& x = line.at[i];
      EXPECT_NEAR(x[1], 0, 1e-12) << degrees;
      EXPECT_NEAR(x[2], 0.5 * i, 1e-7) << degrees;
      if (degrees < 180) {
        EXPECT_NEAR(x[0], 0, 1e-12) << degrees;
      }
    }
  }
  // A bend that its own plane cuts into halves.
  constexpr double bend = 5, arc = 5 * pi / 2;
  std::array<CurvePoints, 2> lines;
  for (const int part : {0, 1}) {
    const auto mesh = tube_mesh(arc, 3, 12, part == 0 ? 360 : 180);
    auto tube = fluid_of(mesh);
    bend_about(bend, tube.part);
    lines[part] =
        centre_line<3, 1>(tube.part, tube.inlet, tube.outlet, 20, false, of_part(mirror_planes(mesh), tube.part));
  }
  for (int i = 0; i < 20; ++i) EXPECT_LT(distance(lines[0].at[i], lines[1].at[i]), 1e-3) << i;
}

TEST(CentreLine, OfATubeInTheHalfPlaneLiesOnItsAxis) {
  ArteryShape shape;
  shape.inner_radius = 1;
  shape.length = 2;
  ArteryCells cells;
  cells.lumen = 3;
  cells.media = cells.adventitia = 1;
  cells.axial = 6;
  const auto tube = fluid_of(generate_artery_section(shape, cells));
  const auto turned = centre_line<2, 1>(tube.part, tube.inlet, tube.outlet, 5, true);
  for (int i = 0; i < 5; ++i) EXPECT_LT(distance(turned.at[i], {0, 0, 0.5 * i}), 1e-7);
  const auto plane = centre_line<2, 1>(tube.part, tube.inlet, tube.outlet, 5);
  for (int i = 0; i < 5; ++i) EXPECT_LT(distance(plane.at[i], {0.5, 0, 0.5 * i}), 1e-7);
}

TEST(CentreLine, HasNoneWhereOpeningsAreNotConnected) {
  auto tube = straight_vessel<1>(4, 2, 6);
  // Without the cells in the middle.
  std::vector<Submesh<3>::Cell> kept;
  for (const auto& cell : tube.part.cells) {
    double z = 0;
    for (const int node : cell) z += tube.part.nodes[node][2] / 4;
    if (std::abs(z - 2) > 0.6) kept.push_back(cell);
  }
  tube.part.cells = kept;
  EXPECT_THROW((centre_line<3, 1>(tube.part, tube.inlet, tube.outlet, 5)), ConvergenceError);
}

}  // namespace
}  // namespace fsi::test
