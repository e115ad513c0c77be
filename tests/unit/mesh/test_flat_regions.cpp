// Flat parts of closed surfaces: caps in every position, nothing else, with nodes off by a tenth of an edge.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "math/pi.hpp"
#include "mesh/flat_regions.hpp"
#include "mesh/point_math.hpp"

namespace fsi::test {

namespace {

struct Surface {
  std::vector<Point> nodes;
  std::vector<SurfaceTriangle> triangles;
};

/// A tube along z, radius 1 and length 4, of `around` nodes each round. Its lower end has a fan about a middle node, its
/// upper one, cut at an angle, triangles from rim to rim as programs for segmentation make them.
Surface tube(int around, double slope) {
  Surface surface;
  const double size = 2 * pi / around;
  const int rows = static_cast<int>(std::round(4 / size));
  for (int k = 0; k <= rows; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * (i + 0.5 * (k % 2)) / around, x = std::cos(angle), y = std::sin(angle);
      const double share = static_cast<double>(k) / rows;
      surface.nodes.push_back({x, y, share * (4 + slope * x)});
    }
  const auto node = [&](int k, int i) { return k * around + (i + around) % around; };
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < around; ++i) {
      const int odd = k % 2, a = node(k, i), b = node(k, i + 1), c = node(k + 1, i + odd), d = node(k + 1, i + odd - 1);
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  const int middle = static_cast<int>(surface.nodes.size());
  surface.nodes.push_back({0, 0, 0});
  for (int i = 0; i < around; ++i) surface.triangles.push_back({middle, node(0, i + 1), node(0, i)});
  for (int i = 1; i + 1 < around; ++i) surface.triangles.push_back({node(rows, 0), node(rows, i), node(rows, i + 1)});
  return surface;
}

/// A box of cubes [0, m] x [0, 1] x [0, 1] whose squares are halved, m = 1 for a cube, each side of `cells` squares.
Surface cube(int cells) {
  Surface surface;
  const auto add_side = [&](const Point& at, const Point& u, const Point& v) {
    const int first = static_cast<int>(surface.nodes.size());
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j) surface.nodes.push_back(at + (1.0 * i / cells) * u + (1.0 * j / cells) * v);
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const int a = first + i * (cells + 1) + j, b = a + cells + 1;
        surface.triangles.push_back({a, b, b + 1});
        surface.triangles.push_back({a, b + 1, a + 1});
      }
  };
  const Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{0, 0, 0};
  add_side(o, y, x), add_side(z, x, y), add_side(o, x, z), add_side(y, z, x), add_side(o, z, y), add_side(x, y, z);
  // One node a place.
  std::vector<int> first(surface.nodes.size());
  for (std::size_t n = 0; n < first.size(); ++n)
    for (std::size_t m = 0; m <= n; ++m)
      if (distance(surface.nodes[n], surface.nodes[m]) < 1e-9) {
        first[n] = static_cast<int>(m);
        break;
      }
  for (auto& triangle : surface.triangles)
    for (int& node : triangle) node = first[node];
  return surface;
}

/// Every coordinate moved by up to a tenth of the mean edge at the node.
Surface jittered(Surface surface, unsigned seed) {
  std::vector<double> length(surface.nodes.size(), 0), count(surface.nodes.size(), 0);
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k)
      for (const int node : {t[k], t[(k + 1) % 3]}) {
        length[node] += std::min(distance(surface.nodes[t[k]], surface.nodes[t[(k + 1) % 3]]), 0.5);
        ++count[node];
      }
  std::mt19937 numbers(seed);  // the same everywhere; distributions of the library need not be
  for (std::size_t n = 0; n < surface.nodes.size(); ++n)
    for (double& x : surface.nodes[n])
      x += count[n] > 0 ? 0.1 * length[n] / count[n] * (2 * (numbers() / 4294967296.0) - 1) : 0;
  return surface;
}

double degrees_apart(const Point& a, const Point& b) {
  return std::acos(std::min(1.0, dot(a, b) / (norm(a) * norm(b)))) * 180 / pi;
}

TEST(FlatRegions, AreTheCapsOfATube) {
  for (const int around : {10, 12, 16, 24})
    for (const double slope : {0.0, 0.5, 1.0}) {  // up to 45 degrees
      const Surface clean = tube(around, slope);
      for (unsigned seed = 0; seed < 6; ++seed) {
        const Surface surface = seed == 0 ? clean : jittered(clean, seed);
        auto found = flat_regions(surface.nodes, surface.triangles);
        ASSERT_EQ(found.size(), 2u) << around << " around, slope " << slope << ", seed " << seed;
        if (found[0].normal[2] > 0) std::swap(found[0], found[1]);
        const double off = seed == 0 ? 1e-6 : 8, area = 0.5 * around * std::sin(2 * pi / around);
        EXPECT_LT(degrees_apart(found[0].normal, {0, 0, -1}), off);
        EXPECT_LT(degrees_apart(found[1].normal, {-slope, 0, 1}), off);
        EXPECT_NEAR(found[0].area, area, seed == 0 ? 1e-9 : 0.15 * area);
        EXPECT_NEAR(found[1].area, area * std::hypot(1, slope), seed == 0 ? 1e-9 : 0.2 * area);
        EXPECT_LT(distance(found[0].centre, {0, 0, 0}), 0.1);
      }
    }
}

/// A closed cylinder whose side is one row of long triangles, with caps of a fan or of a zigzag strip from rim to rim. Any strip
/// of the side is as long as the tube and would be round enough up to three times its width.
Surface drum(int around, double length, bool fan) {
  Surface surface;
  for (const double z : {0.0, length})
    for (int i = 0; i < around; ++i)
      surface.nodes.push_back({2 * std::cos(2 * pi * i / around), 2 * std::sin(2 * pi * i / around), z});
  for (int i = 0; i < around; ++i) {
    const int j = (i + 1) % around;
    surface.triangles.push_back({i, j, around + j});
    surface.triangles.push_back({i, around + j, around + i});
  }
  const auto cap = [&](int a, int b, int c) {  // counter-clockwise from above
    surface.triangles.push_back({a, c, b});
    surface.triangles.push_back({around + a, around + b, around + c});
  };
  if (fan)
    for (int i = 1; i + 1 < around; ++i) cap(0, i, i + 1);
  else
    for (int low = 0, high = around - 1; low + 1 < high;) {
      cap(low, low + 1, high);
      if (++low + 1 < high) {
        cap(low, high - 1, high);
        --high;
      }
    }
  return surface;
}

TEST(FlatRegions, AreTheCapsOfACylinderOfLongTriangles) {
  for (const int around : {8, 10, 16, 32, 64})
    for (const double length : {3.0, 5.0, 7.0, 10.0, 14.0, 20.0})
      for (const bool fan : {true, false}) {
        const Surface surface = drum(around, length, fan);
        const auto found = flat_regions(surface.nodes, surface.triangles);
        ASSERT_EQ(found.size(), 2u) << around << " around, length " << length << (fan ? ", fans" : ", strips");
        for (const auto& part : found) {
          EXPECT_NEAR(part.area, 0.5 * 4 * around * std::sin(2 * pi / around), 1e-9);
          EXPECT_NEAR(std::abs(part.normal[2]), 1, 1e-9);
        }
      }
}

TEST(FlatRegions, AreTheSidesOfACube) {
  const Surface clean = cube(4);
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Surface surface = seed == 0 ? clean : jittered(clean, seed);
    EXPECT_EQ(flat_regions(surface.nodes, surface.triangles).size(), 6u) << seed;
  }
}

/// A sphere, a cube's sides blown up, has none however coarse it is.
TEST(FlatRegions, AreNotOnASphere) {
  for (const int cells : {2, 3, 6, 12}) {
    Surface clean = cube(cells);
    for (Point& x : clean.nodes) {
      const Point out = x - Point{0.5, 0.5, 0.5};
      x = (1 / norm(out)) * out;
    }
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Surface surface = seed == 0 ? clean : jittered(clean, seed);
      EXPECT_EQ(flat_regions(surface.nodes, surface.triangles).size(), 0u) << cells << " cells, seed " << seed;
    }
  }
}

}  // namespace

}  // namespace fsi::test
