#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "sampling/point_sampling.hpp"
#include "sampling/wall_sampling.hpp"
#include "support/meshes.hpp"
#include "unit/mesh/meshes.hpp"

namespace fsi {
namespace {

/// The short artery with mid-edge nodes on the cylinders, those between two cylinders half way.
SimplexMesh<3, 2> curved_artery() {
  auto mesh = with_mid_edge_nodes(test::short_artery());
  const auto radius = [&](int node) { return std::hypot(mesh.nodes[node][0], mesh.nodes[node][1]); };
  for (const auto& cell : mesh.cells)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [a, b] = SimplexEdges<3>::vertices[e];
      if (std::min(radius(cell[a]), radius(cell[b])) < 1.42) continue;
      const double stretch = 0.5 * (radius(cell[a]) + radius(cell[b])) / radius(cell[4 + e]);
      Point& x = mesh.nodes[cell[4 + e]];
      x = {x[0] * stretch, x[1] * stretch, x[2]};
    }
  return mesh;
}

/// About a quarter of a disk in the plane z = 0, or with `meridian` in the plane y = 0: one triangle, one edge round.
SimplexMesh<2, 2> round_triangle(bool meridian) {
  const double c = std::sqrt(0.5);
  SimplexMesh<2, 2> mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {c, c, 0}, {0, 0.5, 0}};
  if (meridian)
    for (auto& x : mesh.nodes) std::swap(x[1], x[2]);
  mesh.cells = {{0, 1, 2, 3, 4, 5}};
  mesh.cell_region = {0};
  mesh.regions = {"fluid"};
  return mesh;
}

double quadratic(const Point& x) {
  return 0.4 + x[0] - 2 * x[1] * x[2] + 0.7 * x[0] * x[0] - 1.3 * x[2] * x[2];
}

template <class Function, class Sample>
double interpolated(const std::vector<Point>& nodes, const Sample& sample, const Function& function) {
  double value = 0;
  for (std::size_t i = 0; i < sample.nodes.size(); ++i) value += sample.weights[i] * function(nodes[sample.nodes[i]]);
  return value;
}

TEST(CurvedSampling, QuadraticFunctionsInStraightCells) {
  const auto mesh = with_mid_edge_nodes(test::short_artery());
  std::vector<Point> points;
  for (int i = 0; i < 50; ++i) points.push_back({0.7 * std::cos(i), 0.8 * std::sin(i), 0.06 * i});
  const auto samples = sample_in_cells(mesh, 0, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(interpolated(mesh.nodes, samples[i], quadratic), quadratic(points[i]), 1e-12);
    double linear = 0;
    for (int v = 0; v < 4; ++v) linear += samples[i].scalar_weights[v] * test::linear(mesh.nodes[samples[i].nodes[v]]);
    EXPECT_NEAR(linear, test::linear(points[i]), 1e-12);
  }
}

TEST(CurvedSampling, LinearFunctionsUpToTheRoundWall) {
  const auto mesh = curved_artery();
  std::vector<Point> points;
  for (int i = 0; i < 200; ++i) {
    const double r = i % 2 == 0 ? 1.4295 : 1.41;  // outside the straight cells between their vertices
    points.push_back({r * std::cos(0.37 * i), r * std::sin(0.37 * i), 0.015 * i});
  }
  const auto samples = sample_in_cells(mesh, 0, points);
  int held = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point image{0, 0, 0};
    for (std::size_t n = 0; n < 10; ++n) image = image + samples[i].weights[n] * mesh.nodes[samples[i].nodes[n]];
    held += distance(image, points[i]) < 1e-12;
    EXPECT_LT(distance(image, points[i]), 2e-3);  // parabolas are not circles
  }
  EXPECT_GT(held, 150);
}

TEST(CurvedSampling, QuadraticInReferenceCoordinatesOfCurvedCells) {
  const auto mesh = curved_artery();
  for (const auto& region : measure_quality(mesh).regions) ASSERT_GT(region.min_jacobian, 0.3) << region.name;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.01, 1);
  for (std::size_t c = 0; c < mesh.cells.size(); c += 7) {
    std::array<double, 4> l;
    double sum = 0;
    for (double& value : l) sum += value = uniform(random);
    for (double& value : l) value /= sum;
    std::array<double, 10> shape;
    for (int i = 0; i < 4; ++i) shape[i] = l[i] * (2 * l[i] - 1);
    for (int e = 0; e < 6; ++e)
      shape[4 + e] = 4 * l[SimplexEdges<3>::vertices[e][0]] * l[SimplexEdges<3>::vertices[e][1]];
    Point x{0, 0, 0};
    for (int i = 0; i < 10; ++i) x = x + shape[i] * mesh.nodes[mesh.cells[c][i]];
    const auto sample = sample_in_cells(mesh, mesh.cell_region[c], {x}).front();
    ASSERT_EQ(sample.nodes, std::vector<int>(mesh.cells[c].begin(), mesh.cells[c].end()));
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(sample.weights[i], shape[i], 1e-11);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(sample.scalar_weights[i], l[i], 1e-11);
  }
}

TEST(CurvedSampling, TrianglesOfBothPlanes) {
  for (const bool meridian : {false, true}) {
    const auto mesh = round_triangle(meridian);
    const Point inside = meridian ? Point{0.6, 0, 0.6} : Point{0.6, 0.6, 0};  // outside the straight triangle
    const auto sample = sample_in_cells(mesh, 0, {inside}).front();
    ASSERT_EQ(sample.nodes.size(), 6u);
    EXPECT_EQ(sample.scalar_weights.size(), 3u);
    EXPECT_NEAR(interpolated(mesh.nodes, sample, test::linear), test::linear(inside), 1e-12);
    EXPECT_THROW(sample_in_cells(mesh, 0, {{3, 0, 0}}), InputError);
  }
}

TEST(CurvedSampling, LinearTriangles) {
  const auto mesh = test::irregular_ring(4);
  const std::vector<Point> points{{1, 0, 0}, {1.3, 0, 0.4}, {2, 0, 1}, {1.77, 0, 0.93}};
  const auto samples = sample_in_cells(mesh, -1, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(interpolated(mesh.nodes, samples[i], test::linear), test::linear(points[i]), 1e-12);
}

TEST(CurvedWallSampling, QuadraticFunctionsOfAngleAndAxis) {
  const auto mesh = curved_artery();
  const auto surface = interface_facets(mesh, 0, {1, 2});
  const AxisFrame frame(Axis{});
  const auto samples = wall_samples(mesh.nodes, surface, Axis{}, {0.4, 1.23, 3.0}, 16);
  ASSERT_EQ(samples.size(), 48u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double angle = 2 * M_PI * (i % 16) / 16, z = i < 16 ? 0.4 : i < 32 ? 1.23 : 3.0;
    const double value = interpolated(mesh.nodes, samples[i], [&](const Point& x) {
      double turn = frame.angle(x) - angle;
      turn -= 2 * M_PI * std::round(turn / (2 * M_PI));
      return turn * turn + 3 * turn + turn * x[2] + x[2] * x[2];
    });
    EXPECT_NEAR(value, z * z, 1e-11);
  }
}

/// Facets of a part of the unit cylinder, 0 < z < 2. Every second column is cut the other way, so that planes between
/// columns mirror it.
struct Strip {
  std::vector<Point> nodes;
  std::vector<std::array<int, 3>> facets;
  Strip(double first, double span, int around, bool closed) {
    const int columns = closed ? around : around + 1;
    for (int i = 0; i < columns; ++i)
      for (int k = 0; k < 3; ++k) {
        const double angle = first + span * i / around;
        nodes.push_back({std::cos(angle), std::sin(angle), static_cast<double>(k)});
      }
    for (int i = 0; i < around; ++i)
      for (int k = 0; k < 2; ++k) {
        const int j = (i + 1) % columns;
        const int a = 3 * i + k, b = 3 * j + k, c = 3 * j + k + 1, d = 3 * i + k + 1;
        if (i % 2 == 0)
          facets.insert(facets.end(), {{a, b, c}, {a, c, d}});
        else
          facets.insert(facets.end(), {{a, b, d}, {b, c, d}});
      }
  }
  /// Mean radial displacement of a tube that is squeezed: symmetric to the planes x = 0 and y = 0.
  double mean_radial(double z) const {
    const auto samples = wall_samples(nodes, facets, Axis{}, {z});
    double sum = 0;
    for (const auto& sample : samples)
      for (std::size_t i = 0; i < 3; ++i) {
        const Point& x = nodes[sample.nodes[i]];
        const Point u{x[0] * (0.1 + 0.3 * x[1] * x[1]), x[1] * (0.2 - 0.1 * x[0] * x[0]), 0};
        sum += sample.weights[i] * dot(u, sample.direction);
      }
    return sum / static_cast<double>(samples.size());
  }
};

TEST(CurvedWallSampling, SectorsHaveTheMeanOfTheWholeTube) {
  const Strip whole(0, 2 * M_PI, 24, true), quarter(0, M_PI / 2, 6, false), half(0, M_PI, 12, false),
      last_quarter(1.5 * M_PI, M_PI / 2, 6, false), across(M_PI / 2, M_PI, 12, false);
  const double mean = whole.mean_radial(0.6);
  EXPECT_NEAR(quarter.mean_radial(0.6), mean, 1e-12);
  EXPECT_NEAR(half.mean_radial(0.6), mean, 1e-12);
  EXPECT_NEAR(last_quarter.mean_radial(0.6), mean, 1e-12);
  EXPECT_NEAR(across.mean_radial(0.6), mean, 1e-12);
}

TEST(CurvedWallSampling, AnySectorIsSampledWithinIt) {
  const Strip sector(0.3, 1.0, 8, false);
  const auto samples = wall_samples(sector.nodes, sector.facets, Axis{}, {1.5}, 16);
  for (int k = 0; k < 16; ++k) {
    const double angle = 0.3 + (k + 0.5) / 16;
    EXPECT_NEAR(samples[k].direction[0], std::cos(angle), 1e-12);
    EXPECT_NEAR(samples[k].direction[1], std::sin(angle), 1e-12);
  }
}

TEST(CurvedWallSampling, MeridiansOfAxisymmetricMeshes) {
  const std::vector<Point> nodes{{1, 0, 0}, {1, 0, 1}, {1.2, 0, 3}, {1.02, 0, 0.4}, {1.05, 0, 2.2}};
  const std::vector<std::array<int, 2>> straight{{0, 1}, {1, 2}};
  const auto linear = wall_samples<2>(nodes, straight, Axis{}, {0, 0.25, 2, 3});
  ASSERT_EQ(linear.size(), 4u);
  const double positions[] = {0, 0.25, 2, 3};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(linear[i].direction, (Point{1, 0, 0}));
    EXPECT_NEAR(interpolated(nodes, linear[i], [](const Point& x) { return x[2]; }), positions[i], 1e-14);
  }
  const std::vector<std::array<int, 3>> curved{{0, 1, 3}, {1, 2, 4}};
  const auto quadratic_edges = wall_samples<2>(nodes, curved, Axis{}, {0, 0.25, 2, 3});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(quadratic_edges[i].nodes.size(), 3u);
    EXPECT_NEAR(interpolated(nodes, quadratic_edges[i], [](const Point& x) { return x[2]; }), positions[i], 1e-13);
    EXPECT_NEAR(interpolated(nodes, quadratic_edges[i], [](const Point&) { return 1.0; }), 1, 1e-14);
  }
  EXPECT_THROW(wall_samples<2>(nodes, curved, Axis{}, {9.0}), InputError);
}

}  // namespace
}  // namespace fsi
