// Openings that are no single flat opening: what is apart, and what leans away.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "math/pi.hpp"
#include "mesh/point_math.hpp"
#include "mesh/surface_pieces.hpp"

namespace fsi::test {

namespace {

using Facet = std::array<int, 3>;

/// Adds a fan of eight triangles of radius 2, normal +z. \return its area
double add_disk(const Point& at, std::vector<Point>& nodes, std::vector<Facet>& facets) {
  const int first = static_cast<int>(nodes.size());
  nodes.push_back(at);
  for (int i = 0; i < 8; ++i) nodes.push_back(at + Point{2 * std::cos(pi * i / 4), 2 * std::sin(pi * i / 4), 0});
  for (int i = 0; i < 8; ++i) facets.push_back({first, first + 1 + i, first + 1 + (i + 1) % 8});
  return 8 * 0.5 * 4 * std::sin(pi / 4);
}

TEST(SurfacePieces, OfTwoDisksAndOfOne) {
  std::vector<Point> nodes;
  std::vector<Facet> facets;
  const double area = add_disk({0, 0, 0}, nodes, facets);
  EXPECT_TRUE(pieces_of<3>(nodes, facets).whole());
  EXPECT_EQ(said_of<3>(pieces_of<3>(nodes, facets)), "");
  add_disk({10, 0, 1}, nodes, facets);
  facets.pop_back();  // the second is smaller
  const auto found = pieces_of<3>(nodes, facets);
  ASSERT_EQ(found.pieces.size(), 2u);
  EXPECT_TRUE(found.leaning.empty());
  EXPECT_NEAR(found.pieces[0].size, area, 1e-12);
  EXPECT_NEAR(found.pieces[1].size, area * 7 / 8, 1e-12);
  EXPECT_LT(distance(found.pieces[0].centre, {0, 0, 0}), 1e-12);
  const auto said = said_of<3>(found);
  EXPECT_EQ(said.substr(0, 54), "is in 2 pieces: 11.3 mm^2 about (0, 0, 0) mm, 9.9 mm^2") << said;
}

TEST(SurfacePieces, OfADiskWithATriangleOfTheSide) {
  std::vector<Point> nodes;
  std::vector<Facet> facets;
  add_disk({0, 0, 0}, nodes, facets);
  nodes.push_back({2, 1, -1});
  facets.push_back({1, static_cast<int>(nodes.size()) - 1, 2});
  const auto found = pieces_of<3>(nodes, facets);
  EXPECT_EQ(found.pieces.size(), 1u);  // joined at an edge
  ASSERT_EQ(found.leaning.size(), 1u);
  EXPECT_EQ(found.leaning[0].facets, std::vector<std::size_t>{8});
  EXPECT_NE(said_of<3>(found).find("has 1 of its 9 triangles leaning away from its plane"), std::string::npos);
}

/// Half a sphere bends by up to 90 degrees all round and has facets that lean by more than 60, a cap of 50 degrees has none; a
/// whole tube's side has no plane.
TEST(SurfacePieces, CurvedOpeningsMayBend) {
  for (const double widest : {0.8, 50 * pi / 180}) {
    std::vector<Point> nodes{{0, 0, 1}};
    std::vector<Facet> facets;
    const auto at = [](double polar, int i) {
      return Point{std::sin(polar) * std::cos(pi * i / 6), std::sin(polar) * std::sin(pi * i / 6), std::cos(polar)};
    };
    for (int i = 0; i < 12; ++i) nodes.push_back(at(widest / 2, i));
    for (int i = 0; i < 12; ++i) nodes.push_back(at(widest, i));
    for (int i = 0; i < 12; ++i) {
      const int j = (i + 1) % 12;
      facets.push_back({0, 1 + i, 1 + j});
      facets.push_back({1 + i, 13 + i, 13 + j});
      facets.push_back({1 + i, 13 + j, 1 + j});
    }
    EXPECT_TRUE(pieces_of<3>(nodes, facets).whole());
  }
}

/// Of the plane z = 0 and of meridian sections.
TEST(SurfacePieces, OfEdges) {
  for (const int up : {1, 2}) {
    std::vector<Point> nodes(6, Point{0, 0, 0});
    for (int i = 0; i < 3; ++i) nodes[i][up] = i;      // x = 0, from 0 to 2
    for (int i = 3; i < 5; ++i) nodes[i] = {9, 0, 0};  // 7 away from the rest
    nodes[4][up] = 1;
    nodes[5][0] = 0.5;
    nodes[5][up] = 2;
    const std::vector<std::array<int, 2>> both{{0, 1}, {1, 2}, {3, 4}};
    const auto apart = pieces_of<2>(nodes, both);
    ASSERT_EQ(apart.pieces.size(), 2u);
    EXPECT_NEAR(apart.pieces[0].size, 2, 1e-15);
    EXPECT_TRUE(apart.leaning.empty());
    const std::vector<std::array<int, 2>> bent{{0, 1}, {1, 2}, {2, 5}};
    const auto one = pieces_of<2>(nodes, bent);
    EXPECT_EQ(one.pieces.size(), 1u);
    ASSERT_EQ(one.leaning.size(), 1u);
    EXPECT_EQ(one.leaning[0].facets, std::vector<std::size_t>{2});
  }
}

}  // namespace

}  // namespace fsi::test
