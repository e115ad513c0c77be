#include <gtest/gtest.h>

#include <cmath>

#include "mesh_motion/nearest_point.hpp"
#include "mesh_motion/stiffening.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

/// Two triangles in the (r, z) plane, areas 1/2 and 3/2 mm^2, centroids (1/3, 1/3) and (4/3, 2/3).
Submesh<2> two_triangles() {
  Submesh<2> part;
  part.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {3, 0, 1}};
  part.cells = {{0, 1, 2}, {1, 3, 2}};
  return part;
}

TEST(MeshStiffness, IsNothingForTheHarmonicMotion) {
  EXPECT_TRUE(mesh_stiffness(two_triangles(), {0}, {}).empty());
  EXPECT_TRUE(mesh_stiffness(two_triangles(), {0}, {MeshMotionMethod::stiffened, 0, 0}).empty());
  EXPECT_TRUE(mesh_stiffness(two_triangles(), {0}, {MeshMotionMethod::nonlinear_elastic, 0, 0}).empty());
}

TEST(MeshStiffness, GrowsAsElementsShrink) {
  const auto k = mesh_stiffness(two_triangles(), {}, {MeshMotionMethod::stiffened, 2, 1});
  ASSERT_EQ(k.size(), 2u);
  EXPECT_NEAR(k[0], 4, 1e-14);        // (1 / (1/2))^2
  EXPECT_NEAR(k[1], 4.0 / 9, 1e-14);  // (1 / (3/2))^2
}

TEST(MeshStiffness, GrowsTowardsTheInterface) {
  const auto k = mesh_stiffness(two_triangles(), {0, 1}, {MeshMotionMethod::nonlinear_elastic, 0, 3});
  const double first = std::sqrt(2.0) / 3, second = std::hypot(1.0 / 3, 2.0 / 3), mean = (first + second) / 2;
  ASSERT_EQ(k.size(), 2u);
  EXPECT_NEAR(k[0], std::pow(mean / first, 3), 1e-13);
  EXPECT_NEAR(k[1], std::pow(mean / second, 3), 1e-13);
}

TEST(MeshStiffness, BothFactorsMultiply) {
  const auto part = two_triangles();
  const auto size = mesh_stiffness(part, {2}, {MeshMotionMethod::stiffened, 1.5, 0});
  const auto distance = mesh_stiffness(part, {2}, {MeshMotionMethod::stiffened, 0, 0.5});
  const auto both = mesh_stiffness(part, {2}, {MeshMotionMethod::stiffened, 1.5, 0.5});
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(both[c], size[c] * distance[c], 1e-14 * both[c]);
}

TEST(NearestPoint, FindsWhatTryingAllFinds) {
  Random random(1);
  std::vector<Point> points;
  for (int i = 0; i < 500; ++i) points.push_back({random(), 0.1 * random(), i % 7 == 0 ? 0.25 : random()});
  const NearestPoint nearest(points);
  for (int i = 0; i < 300; ++i) {
    const Point from{2 * random(), random(), random()};
    double smallest = INFINITY;
    for (const auto& point : points) smallest = std::min(smallest, distance(from, point));
    EXPECT_EQ(nearest.distance(from), smallest);
  }
}

}  // namespace

}  // namespace fsi::test
