#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"
#include "sampling/point_sampling.hpp"
#include "sampling/wall_sampling.hpp"
#include "unit/mesh/meshes.hpp"

namespace fsi {
namespace {

double interpolated(const TetrahedralMesh& mesh, const PointSample& sample) {
  double value = 0;
  for (int i = 0; i < 4; ++i) value += sample.weights[i] * test::linear(mesh.nodes[sample.nodes[i]]);
  return value;
}

TEST(AxisFrame, MeasuresFromAnyAxis) {
  const AxisFrame frame({{1, 2, 3}, {0, 5, 0}});
  const Point x{1 + 2, 2 + 7, 3};
  EXPECT_DOUBLE_EQ(frame.axial(x), 7);
  EXPECT_DOUBLE_EQ(frame.radius(x), 2);
  const Point away = frame.radial(frame.angle(x));
  EXPECT_NEAR(distance(away, {1, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(dot(cross(frame.first, frame.second), frame.along), 1, 1e-15);
}

TEST(AxisFrame, RefusesADirectionOfLengthZero) {
  EXPECT_THROW(AxisFrame({{0, 0, 0}, {0, 0, 0}}), InputError);
}

TEST(Sampling, ReproducesLinearFunctionsInTheFluid) {
  const auto mesh = test::short_artery();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(-0.9, 0.9), along(0, 3);
  std::vector<Point> points;
  for (int i = 0; i < 300; ++i) points.push_back({across(random), across(random), along(random)});
  const auto samples = sample_in_cells(mesh, 0, points);
  ASSERT_EQ(samples.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(interpolated(mesh, samples[i]), test::linear(points[i]), 1e-12);
}

TEST(Sampling, ReproducesLinearFunctionsOnTheWholeCentreLine) {
  const auto mesh = test::coarse_artery();
  const Axis axis;
  EXPECT_DOUBLE_EQ(axial_position(mesh.nodes, *mesh.facets("inlet"), axis), 0);
  EXPECT_DOUBLE_EQ(axial_position(mesh.nodes, *mesh.facets("outlet"), axis), 18);
  const auto positions = evenly_spaced(0, 18, 181);
  EXPECT_EQ(positions.front(), 0);
  EXPECT_DOUBLE_EQ(positions[1], 0.1);
  EXPECT_EQ(positions.back(), 18);
  const auto samples = sample_in_cells(mesh, 0, points_on_axis(axis, positions));
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_NEAR(interpolated(mesh, samples[i]), test::linear({0, 0, positions[i]}), 1e-12);
}

TEST(Sampling, PutsPointsJustOutsideIntoTheNearestCell) {
  const auto mesh = test::short_artery();
  // On the round wall between two nodes: outside the faceted fluid by 1.43 (1 - cos 15 deg) = 0.049 mm.
  const Point x{1.43 * std::cos(M_PI / 12), 1.43 * std::sin(M_PI / 12), 1.1};
  const auto sample = sample_in_cells(mesh, 0, {x}).front();
  double sum = 0;
  Point image{0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    EXPECT_GE(sample.weights[i], 0);
    sum += sample.weights[i];
    image = image + sample.weights[i] * mesh.nodes[sample.nodes[i]];
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_LT(distance(image, x), 0.1);
}

TEST(Sampling, RefusesPointsFarOutside) {
  const auto mesh = test::short_artery();
  EXPECT_THROW(sample_in_cells(mesh, 0, {{5, 0, 1}}), InputError);
  EXPECT_THROW(sample_in_cells(mesh, 0, {{0, 0, -2}}), InputError);
}

TEST(WallSampling, IsExactForFunctionsLinearInAngleAndAxis) {
  const auto mesh = test::coarse_artery();
  const auto interface = interface_facets(mesh, 0, {1, 2});
  const auto positions = evenly_spaced(0, 18, 37);
  const auto samples = wall_samples(mesh.nodes, interface, Axis{}, positions, 16);
  ASSERT_EQ(samples.size(), positions.size() * 16);
  const AxisFrame frame(Axis{});
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int k = 0; k < 16; ++k) {
      const auto& sample = samples[16 * i + k];
      double z = 0, turn = 0;
      for (int n = 0; n < 3; ++n) {
        z += sample.weights[n] * mesh.nodes[sample.nodes[n]][2];
        const double angle = frame.angle(mesh.nodes[sample.nodes[n]]) - 2 * M_PI * k / 16;
        turn += sample.weights[n] * (angle - 2 * M_PI * std::round(angle / (2 * M_PI)));
      }
      EXPECT_NEAR(z, positions[i], 1e-12);
      EXPECT_NEAR(turn, 0, 1e-12);
      EXPECT_NEAR(sample.direction[0], std::cos(2 * M_PI * k / 16), 1e-15);
    }
}

TEST(WallSampling, MeanRadialDisplacementOfAnInflatedTube) {
  const auto mesh = test::coarse_artery();
  const auto samples = wall_samples(mesh.nodes, interface_facets(mesh, 0, {1, 2}), Axis{}, {9.05}, 16);
  double radial = 0;
  for (const auto& sample : samples)
    for (int n = 0; n < 3; ++n) {
      const Point& x = mesh.nodes[sample.nodes[n]];
      const Point inflated = (0.1 / std::hypot(x[0], x[1])) * Point{x[0], x[1], 0};
      radial += sample.weights[n] * dot(inflated, sample.direction) / 16;
    }
  EXPECT_NEAR(radial, 0.1, 0.1 * 0.03);  // nodes 30 deg apart: 1 - cos 15 deg at most
}

TEST(WallSampling, RefusesPositionsOffTheTube) {
  const auto mesh = test::short_artery();
  const auto interface = interface_facets(mesh, 0, {1, 2});
  EXPECT_THROW(wall_samples(mesh.nodes, interface, Axis{}, {12.0}), InputError);
  EXPECT_THROW(wall_samples(mesh.nodes, std::vector<TetrahedralMesh::Facet>{}, Axis{}, {1.0}), InputError);
}

}  // namespace
}  // namespace fsi
