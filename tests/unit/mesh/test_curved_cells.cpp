#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "mesh/curved_cells.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"

namespace fsi {
namespace {

/// The right-angled reference triangle with one mid-edge node moved along its edge: det J = 1 + 4 shift (l0 - l1).
std::array<Point, 6> triangle_with_shift(double shift) {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5 + shift, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}}};
}

TEST(CurvedCells, StraightCellsHaveOneJacobian) {
  const auto triangle = cell_jacobian<2>(triangle_with_shift(0));
  EXPECT_TRUE(triangle.positive);
  EXPECT_DOUBLE_EQ(triangle.least, 1);
  EXPECT_DOUBLE_EQ(triangle.mean, 1);
}

TEST(CurvedCells, TriangleInTheMeridianPlane) {
  auto x = triangle_with_shift(0.1);
  for (auto& point : x) std::swap(point[1], point[2]);
  const auto jacobian = cell_jacobian<2>(x);
  EXPECT_TRUE(jacobian.positive);
  EXPECT_NEAR(jacobian.least, 0.6, 1e-14);
  EXPECT_NEAR(jacobian.mean, 1, 1e-14);
}

TEST(CurvedCells, MidEdgeNodeMayMoveAQuarterOfTheEdge) {
  EXPECT_TRUE(cell_jacobian<2>(triangle_with_shift(0.2499)).positive);
  const auto bad = cell_jacobian<2>(triangle_with_shift(0.2501));
  EXPECT_FALSE(bad.positive);
  EXPECT_NEAR(bad.least, 1 - 4 * 0.2501, 1e-14);
  EXPECT_NEAR(distance(bad.where, {1, 0, 0}), 0, 1e-14);
}

TEST(CurvedCells, FindsANegativeValueInsideWhereTheVerticesArePositive) {
  // The edges from vertex 2 moved inwards and past each other half way up: positive at the vertices only.
  std::array<Point, 6> x = triangle_with_shift(0);
  x[4] = {0.15, 0.45, 0};
  x[5] = {0.25, 0.45, 0};
  const auto bad = cell_jacobian<2>(x);
  EXPECT_FALSE(bad.positive);
  EXPECT_LE(bad.least, 0);
}

/// Values of det J at the points of a fine lattice, by differences of the shape functions' exact slopes.
template <int Dim>
double sampled_minimum(const std::array<Point, nodes_of_simplex(Dim, 2)>& x, int n) {
  double least = std::numeric_limits<double>::infinity();
  const auto at = [&](const std::array<double, Dim + 1>& l) {
    std::array<Point, Dim + 1> slope;
    for (int i = 0; i <= Dim; ++i) slope[i] = (4 * l[i] - 1) * x[i];
    for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
      slope[a] = slope[a] + 4 * l[b] * x[Dim + 1 + e];
      slope[b] = slope[b] + 4 * l[a] * x[Dim + 1 + e];
    }
    if constexpr (Dim == 3)
      least = std::min(least, dot(slope[1] - slope[0], cross(slope[2] - slope[0], slope[3] - slope[0])));
    else
      least = std::min(least, planar_cross(slope[1] - slope[0], slope[2] - slope[0]));
  };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      if constexpr (Dim == 3)
        for (int k = 0; i + j + k <= n; ++k)
          at({i / double(n), j / double(n), k / double(n), (n - i - j - k) / double(n)});
      else
        at({i / double(n), j / double(n), (n - i - j) / double(n)});
    }
  return least;
}

/// Random cells from mildly curved to folded: the verdict is that of a fine lattice of samples.
template <int Dim>
void compare_with_samples(const std::array<Point, Dim + 1>& corners, double curving, int cells) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> move(-curving, curving);
  int good = 0, bad = 0;
  for (int trial = 0; trial < cells; ++trial) {
    std::array<Point, nodes_of_simplex(Dim, 2)> x{};
    std::copy(corners.begin(), corners.end(), x.begin());
    for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
      x[Dim + 1 + e] = 0.5 * (x[a] + x[b]);
      for (int d = 0; d < Dim; ++d) x[Dim + 1 + e][d] += move(random);
    }
    const auto jacobian = cell_jacobian<Dim>(x);
    const double sampled = sampled_minimum<Dim>(x, 24);
    if (jacobian.positive) {
      EXPECT_GT(sampled, 0) << trial;
      EXPECT_LT(jacobian.least, sampled + 0.011 * jacobian.mean) << trial;
      EXPECT_GT(jacobian.least, sampled - 0.02 * jacobian.mean) << trial;  // the lattice may miss it by a little
      ++good;
    } else {
      EXPECT_LT(sampled, 0.02 * std::abs(jacobian.mean)) << trial;
      ++bad;
    }
  }
  EXPECT_GT(good, cells / 10);
  EXPECT_GT(bad, cells / 10);
}

TEST(CurvedCells, TrianglesAgreeWithSamples) {
  compare_with_samples<2>({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, 0.2, 200);
}

TEST(CurvedCells, TetrahedraAgreeWithSamples) {
  compare_with_samples<3>({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0.16, 100);
}

}  // namespace
}  // namespace fsi
