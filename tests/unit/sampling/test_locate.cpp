// Points in the cells of a part: exact for linear fields, none outside.

#include <gtest/gtest.h>

#include <random>

#include "mesh/point_math.hpp"
#include "sampling/point_sampling.hpp"
#include "support/vessels.hpp"

namespace fsi::test {
namespace {

constexpr double bend_radius = 5;

double linear(const Point& x) {
  return 2 + 3 * x[0] - x[1] + 0.5 * x[2];
}

template <int Order>
void expect_exact() {
  auto tube = straight_vessel<Order>(6, 2, 8);
  bend_about(bend_radius, tube.part);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> one(0, 1);
  std::vector<Point> points;
  for (int i = 0; i < 200; ++i) {
    // 12 edges around come no nearer than cos 15 degrees to the axis.
    const double radius = 0.9 * one(random), angle = 6.28 * one(random), s = 6 * one(random);
    const double off = bend_radius - radius * std::cos(angle);
    points.push_back(
        {bend_radius - off * std::cos(s / bend_radius), radius * std::sin(angle), off * std::sin(s / bend_radius)});
  }
  int found = 0;
  const auto samples = locate_in_cells(tube.part, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& sample = samples[i];
    if (!sample) continue;
    ++found;
    double value = 0, vertices = 0;
    for (std::size_t a = 0; a < sample->weights.size(); ++a)
      value += sample->weights[a] * linear(tube.part.nodes[sample->nodes[a]]);
    for (const double weight : sample->scalar_weights) vertices += weight;
    EXPECT_NEAR(value, linear(points[i]), 1e-11);
    EXPECT_NEAR(vertices, 1, 1e-14);
  }
  // Bent with straight cells, a tube of 8 cuts off a little of the outside.
  EXPECT_GE(found, Order == 2 ? 200 : 180);
}

TEST(LocateInCells, LinearFieldsAreExact) {
  expect_exact<1>();
  expect_exact<2>();
}

TEST(LocateInCells, FacesBelongToThePartAndWhatIsOutsideDoesNot) {
  const auto tube = straight_vessel<1>(4, 2, 5);
  const auto found = locate_in_cells(
      tube.part, {{0, 0, 0}, {0, 0, 4}, {1, 0, 2}, {0, 0, -1e-4}, {0.99, 0.13, 2}, {1.05, 0, 2}, {0, 0, 400}});
  EXPECT_TRUE(found[0] && found[1] && found[2]);
  EXPECT_FALSE(found[3]);
  EXPECT_FALSE(found[4]);  // within the circle of the wall, but not within its edges
  EXPECT_FALSE(found[5]);
  EXPECT_FALSE(found[6]);
  for (const double weight : found[1]->weights) EXPECT_GE(weight, 0);
}

TEST(LocateInCells, PointsOffThePlaneOfTrianglesAreInNone) {
  ArteryShape shape;
  const auto part = submesh(generate_artery_section(shape, {3, 1, 1}), {0});
  const auto found = locate_in_cells(part, {{0.1, 0, 1}, {0.1, 0.01, 1}, {-0.1, 0, 1}});
  EXPECT_TRUE(found[0]);
  EXPECT_FALSE(found[1]);
  EXPECT_FALSE(found[2]);
}

}  // namespace
}  // namespace fsi::test
