// Surfaces of lumens: curvature, radius, smoothing, volume, rims, remeshing.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "mesh/point_distance.hpp"
#include "mesh/point_math.hpp"
#include "mesher/curved_columns.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/surface/boundary_layers.hpp"
#include "mesher/surface/curvature.hpp"
#include "mesher/surface/local_radius.hpp"
#include "mesher/surface/remeshing.hpp"
#include "mesher/surface/smooth_edges.hpp"
#include "mesher/surface/sound_surface.hpp"
#include "mesher/surface/taubin_smoothing.hpp"
#include "mesher/surface/triangle_surface.hpp"
#include "mesher/surface/wall_thickness.hpp"

namespace fsi::test {

namespace {

constexpr double pi = 3.14159265358979323846;

/// A surface over a grid of (around, along), closed around; place(u, v) with u in radians, v from 0 to 1.
template <class Place>
TriangleSurface turned(int around, int along, Place place, bool closed_along = false) {
  TriangleSurface surface;
  const int rows = closed_along ? along : along + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i)
      surface.nodes.push_back(place(2 * pi * (i + 0.5 * (j % 2)) / around, static_cast<double>(j) / along));
  const auto node = [&](int i, int j) { return (j % rows) * around + i % around; };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int shift = j % 2;  // rows are shifted by half an edge: triangles are nearly equilateral
      const int a = node(i, j), b = node(i + 1, j), c = node(i + shift, j + 1), d = node(i + shift + around - 1, j + 1);
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  return surface;
}

TriangleSurface tube(double radius, double length, int around = 24, int along = 24) {
  return turned(around, along, [=](double u, double v) {
    return Point{radius * std::cos(u), radius * std::sin(u), length * v};
  });
}

TriangleSurface torus(double large, double small) {
  return turned(
      48, 24,
      [=](double u, double v) {
        const double w = -2 * pi * v;
        return Point{(large + small * std::cos(w)) * std::cos(u), -(large + small * std::cos(w)) * std::sin(u),
                     small * std::sin(w)};
      },
      true);
}

// Edges of a quarter of the radius leave 6 %, those of half of it would leave four times as much.
TEST(Curvature, OfATubeIsThatOfItsSection) {
  const auto surface = tube(2, 6);
  const auto curvature = largest_curvature(surface, 0);
  for (std::size_t i = 0; i < curvature.size(); ++i) EXPECT_NEAR(curvature[i], 0.5, 0.04) << i;
}

TEST(Curvature, OfATorusIsThatOfItsTube) {
  for (const double k : largest_curvature(torus(5, 1), 0)) EXPECT_NEAR(k, 1, 0.09);
}

// Halving the edges takes the error down by four.
TEST(Curvature, ConvergesWithTheSquareOfTheEdges) {
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    const auto surface = tube(2, 6, 16 << level, 16 << level);
    errors[level] = 0;
    for (const double k : largest_curvature(surface, 0)) errors[level] = std::max(errors[level], std::abs(k - 0.5));
  }
  EXPECT_GT(errors[0] / errors[1], 3);
}

TEST(Curvature, ShortensEdgesWhereTheSurfaceBends) {
  // A waist of radius 0.5 in a tube of radius 1, sharply bent along the axis.
  const auto surface = turned(40, 60, [](double u, double v) {
    const double z = 6 * v, r = 1 - 0.5 * std::exp(-std::pow((z - 3) / 0.5, 2));
    return Point{r * std::cos(u), r * std::sin(u), z};
  });
  std::vector<double> edges(surface.nodes.size(), 0.4);
  shorten_by_curvature(surface, 10, 0.05, edges);
  double waist = 1, end = 1;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_GE(edges[i], 0.05);
    EXPECT_LE(edges[i], 0.4);
    if (std::abs(surface.nodes[i][2] - 3) < 0.1) waist = std::min(waist, edges[i]);
    if (surface.nodes[i][2] > 5.5) end = std::min(end, edges[i]);
  }
  EXPECT_LT(waist, 0.1);
  EXPECT_NEAR(end, 0.2, 0.02) << "2 R / 10, that of the tube";
  std::vector<double> bounded(surface.nodes.size(), 0.4);
  shorten_by_curvature(surface, 10, 0.3, bounded);
  EXPECT_EQ(*std::min_element(bounded.begin(), bounded.end()), 0.3);
}

/// Places on a tube that no symmetry helps: rows and columns are off by up to a sixth of the edges.
template <class Place>
TriangleSurface uneven(int around, int along, Place place) {
  return turned(around, along, [&](double u, double v) {
    const double inside = v > 1e-9 && v < 1 - 1e-9 ? 1.0 : 0.0;
    return place(u + 0.16 * 2 * pi / around * std::sin(37 * u + 11 * v),
                 v + inside * 0.16 / along * std::sin(23 * v + 5 * u));
  });
}

SmoothEdges curved(const TriangleSurface& surface) {
  return smooth_edges(surface.nodes, surface.triangles, offset_normals(surface.nodes, surface.triangles, 0));
}

// Max's normals are up to 2 degrees off here, and the middles 0.3 % of the radius.
TEST(SmoothEdges, LieOnATubeOfTwelveEdges) {
  const auto surface = uneven(12, 8, [](double u, double v) { return Point{2 * std::cos(u), 2 * std::sin(u), 8 * v}; });
  const auto smooth = curved(surface);
  EXPECT_EQ(smooth.curves.size(), smooth.edges);
  EXPECT_EQ(smooth.sharp, 0U);
  for (const auto& [edge, middle] : smooth.curves) {
    EXPECT_NEAR(std::hypot(middle[0], middle[1]), 2, 1e-9);
    const Point &a = surface.nodes[edge.first], &b = surface.nodes[edge.second];
    EXPECT_NEAR(middle[2], 0.5 * (a[2] + b[2]), 1e-9);  // rims stay in their planes
  }
  EXPECT_NEAR(smooth.farthest, 2 * (1 - std::cos(pi / 12)), 0.03);
}

TEST(SmoothEdges, LieOnASphere) {
  const auto surface = uneven(12, 6, [](double u, double v) {
    const double w = pi * (0.2 + 0.6 * v);
    return Point{3 * std::sin(w) * std::sin(u), 3 * std::sin(w) * std::cos(u), 3 * std::cos(w)};
  });
  std::set<int> rims;
  for (const auto& rim : rims_of(surface)) rims.insert(rim.begin(), rim.end());
  for (const auto& [edge, middle] : curved(surface).curves)
    if (rims.count(edge.first) + rims.count(edge.second) < 2) {
      EXPECT_NEAR(norm(middle), 3, 1e-9);
    }
}

/// A torus of tube radius 1, R = `middle`.
TriangleSurface torus_of(double middle, int refined) {
  return turned(
      24 << refined, 12 << refined,
      [middle](double u, double v) {
        const double w = -2 * pi * v, r = middle + std::cos(w);
        return Point{r * std::cos(u), -r * std::sin(u), std::sin(w)};
      },
      true);
}

double off_torus(double middle, const Point& x) {
  return std::abs(std::hypot(std::hypot(x[0], x[1]) - middle, x[2]) - 1);
}

/// Largest distance of middles from the torus: of straight edges, of those curved by the torus' own normals, of those that
/// smooth_edges() curves.
std::array<double, 3> largest_off_torus(double middle, int refined) {
  const auto surface = torus_of(middle, refined);
  const auto smooth = curved(surface);
  EXPECT_TRUE(smooth.not_fitted.empty());
  EXPECT_EQ(smooth.curves.size(), smooth.edges);
  const auto normal_at = [middle](const Point& x) {
    const double r = std::hypot(x[0], x[1]);
    return Point{x[0] * (1 - middle / r), x[1] * (1 - middle / r), x[2]};
  };
  std::array<double, 3> off{};
  for (const auto& [edge, found] : smooth.curves) {
    const Point &a = surface.nodes[edge.first], &b = surface.nodes[edge.second], half = 0.5 * (a + b);
    const Point one = normal_at(a), other = normal_at(b), sum = one + other;
    const double length = norm(sum);
    const Point exact = half + (dot(b - a, other - one) / (2 * (2 + length) * length)) * sum;
    off[0] = std::max(off[0], off_torus(middle, half));
    off[1] = std::max(off[1], off_torus(middle, exact));
    off[2] = std::max(off[2], off_torus(middle, found));
  }
  return off;
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

// Of nodes' normals that are given the sagitta is of the fourth order, and the fit's normals are of the third, which is the same
// of middles. Straight edges are of the second.
TEST(SmoothEdges, AreOfTheFourthOrder) {
  const auto coarse = largest_off_torus(4, 0), fine = largest_off_torus(4, 1);
  EXPECT_NEAR(order(coarse[0], fine[0]), 2, 0.05);
  EXPECT_NEAR(order(coarse[1], fine[1]), 4, 0.05);
  EXPECT_NEAR(order(coarse[2], fine[2]), 4, 0.05);
  EXPECT_LT(fine[2], 3 * fine[1]);  // by a fit to the nodes in place of the torus' own normals
}

// At its innermost circle this torus has the curvatures 1 and -1, of which none is the larger.
TEST(SmoothEdges, HaveNormalsWhereNoCurvatureIsTheLarger) {
  EXPECT_NEAR(order(largest_off_torus(2, 1)[2], largest_off_torus(2, 2)[2]), 4, 0.1);
}

// Four nodes do not determine a quadric.
TEST(SmoothEdges, SayWhereNormalsAreThoseOfFacets) {
  const TriangleSurface sheet{{{0, 0, 0}, {1, 0, 0.1}, {1, 1, 0}, {0, 1, 0.1}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto smooth = smooth_edges(sheet.nodes, sheet.triangles, {});
  ASSERT_EQ(smooth.not_fitted.size(), 4U);
  EXPECT_EQ(smooth.not_fitted.front(), sheet.nodes.front());
  EXPECT_NE(to_text(smooth).find("4 nodes, the first at (0, 0, 0) mm"), std::string::npos) << to_text(smooth);
}

// A half tube and a flat strip that goes on from each of its ends, in a fold of 90 degrees on one side.
TEST(SmoothEdges, StayStraightInFoldsAndOnFlatSides) {
  constexpr int arc = 6, strip = 3, along = 4, columns = arc + 2 * strip + 1;
  TriangleSurface surface;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < columns; ++i) {
      const double z = 0.5 * j, angle = pi * (i - strip) / arc;
      if (i < strip)
        surface.nodes.push_back({1 + 0.5 * (strip - i), 0, z});  // square to the tube
      else if (i <= strip + arc)
        surface.nodes.push_back({std::cos(angle), std::sin(angle), z});
      else
        surface.nodes.push_back({-1, -0.5 * (i - strip - arc), z});  // tangential
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  const auto smooth = smooth_edges(surface.nodes, surface.triangles, {});
  EXPECT_EQ(smooth.sharp, static_cast<std::size_t>(along));
  EXPECT_TRUE(smooth.not_fitted.empty());
  for (const auto& [edge, middle] : smooth.curves) {
    const int a = edge.first % columns, b = edge.second % columns;
    if (std::max(a, b) <= strip) {
      EXPECT_NEAR(middle[1], 0, 1e-12);
    }
    if (std::min(a, b) >= strip && std::max(a, b) <= strip + arc - 3) {
      EXPECT_NEAR(std::hypot(middle[0], middle[1]), 1, 1e-11) << a << ' ' << b;
    }
  }
}

TEST(LocalRadius, OfATubeIsItsRadius) {
  for (const double r : local_radius(tube(1.5, 9, 24, 40), 0)) EXPECT_NEAR(r, 1.5, 0.05);
}

/// A square of 10 mm at z = 0, looking upwards.
TriangleSurface plate() {
  constexpr int n = 6;
  TriangleSurface surface;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) surface.nodes.push_back({10.0 * i / (n - 1), 10.0 * j / (n - 1), 0});
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i;
      surface.triangles.push_back({a, a + 1, a + n + 1});
      surface.triangles.push_back({a, a + n + 1, a + n});
    }
  return surface;
}

TEST(LocalRadius, OfAPlaneIsInfinite) {
  const auto flat = plate();
  for (const double r : local_radius(flat, 3)) EXPECT_EQ(r, std::numeric_limits<double>::infinity());
  EXPECT_EQ(thickness_slip(flat, std::vector<double>(flat.nodes.size(), 0.3)), "");
  // Points above it: as far away as points on it may be.
  ThicknessTable table{"wall.csv", {{2, 2, 5}, {8, 8, 5}}, {0.3, 0.3}};
  for (const double t : thickness_at(flat, table, 0)) EXPECT_NEAR(t, 0.3, 1e-14);
  for (Point& x : table.places) x[2] = 500;
  EXPECT_THROW(thickness_at(flat, table, 0), InputError);
}

TEST(WallThickness, WarnsOfThinAndOfThickWalls) {
  const auto surface = tube(1.5, 9);
  const auto said_of = [&](double thickness) {
    return thickness_slip(surface, std::vector<double>(surface.nodes.size(), thickness));
  };
  EXPECT_EQ(said_of(0.3), "");
  EXPECT_EQ(said_of(0.015).rfind("half of the wall is thinner than 0.01 of the lumen's radius, as no vessel's is", 0),
            0u)
      << said_of(0.015);
  EXPECT_EQ(said_of(7.5).rfind("half of the wall is thicker than 5 of the lumen's radius, as no vessel's is", 0), 0u)
      << said_of(7.5);
}

TEST(WallThickness, UnitsThatContradictTheHeaderAreRefusedByTheirOption) {
  const ThicknessTable known{"wall.csv", {{1, 0, 0}}, {0.3}, "cm", "mm"};
  const auto refused = [&](const ThicknessUnits& units) {
    auto table = known;
    try {
      bring_to_mm(table, units);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string remedy = "; leave it out, or correct the header";
  EXPECT_EQ(refused({"mm", "m"}),
            "wall.csv: --thickness-points-unit: m is not what the header of the file says, cm" + remedy);
  EXPECT_EQ(refused({"um", ""}), "wall.csv: --thickness-unit: um is not what the header of the file says, mm" + remedy);
  EXPECT_EQ(refused({"mm", ""}), "accepted") << "the header says the unit of the places";
  EXPECT_EQ(refused({"mm", "cm"}), "accepted");
  ThicknessTable bare{"wall.csv", {{1, 0, 0}}, {0.3}};
  bring_to_mm(bare, {"cm", ""});
  EXPECT_DOUBLE_EQ(bare.places[0][0], 10);
  EXPECT_DOUBLE_EQ(bare.values[0], 3);
}

TEST(TriangleSurface, KnowsItsRimsAndVolume) {
  const auto open = tube(1, 5);
  ASSERT_EQ(rims_of(open).size(), 2u);
  EXPECT_EQ(rims_of(open)[0].size(), 24u);
  const double area = 0.5 * 24 * std::sin(2 * pi / 24);  // of a section
  EXPECT_NEAR(enclosed_volume(open), 5 * area, 0.01 * 5 * area);
  const auto plane = plane_of(open.nodes, rims_of(open)[0]);
  EXPECT_NEAR(plane.area, area, 1e-12);
  EXPECT_LT(plane.off_plane, 1e-12);
  EXPECT_EQ(rims_of(torus(5, 1)).size(), 0u);
  EXPECT_NEAR(enclosed_volume(torus(5, 1)), 10 * pi * pi, 0.03 * 10 * pi * pi);
}

TEST(TaubinSmoothing, TakesRoughnessAndKeepsTheVolume) {
  auto rough = torus(5, 1);
  const auto smooth = rough;
  for (std::size_t i = 0; i < rough.nodes.size(); ++i)
    for (int d = 0; d < 3; ++d) rough.nodes[i][d] += 0.03 * std::sin(12.9898 * static_cast<double>(7 * i + d) + d);
  const double before = enclosed_volume(rough);
  const auto off = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < rough.nodes.size(); ++i) sum += distance(rough.nodes[i], smooth.nodes[i]);
    return sum / static_cast<double>(rough.nodes.size());
  };
  const double roughness = off();
  taubin_smooth(rough, 20);
  EXPECT_LT(off(), 0.6 * roughness);
  EXPECT_NEAR(enclosed_volume(rough) / before, 1, 0.01);
}

TEST(Remeshing, MakesEdgesOfTheLengthAskedFor) {
  const auto made = remeshed(tube(1, 5), 0.4, "tube.stl");
  EXPECT_NEAR(mean_edge(made), 0.4, 0.08);
  EXPECT_NEAR(enclosed_volume(made) / enclosed_volume(tube(1, 5)), 1, 0.03);
  EXPECT_EQ(rims_of(made).size(), 2u);
}

TEST(Remeshing, FollowsLengthsThatVary) {
  const auto surface = tube(1, 8, 32, 60);
  std::vector<double> edges;
  for (const Point& x : surface.nodes) edges.push_back(0.15 + 0.04 * x[2]);
  const auto made = remeshed(surface, edges, "tube.stl");
  double fine = 0, coarse = 0;
  int fines = 0, coarses = 0;
  for (const auto& t : made.triangles)
    for (int k = 0; k < 3; ++k) {
      const Point &a = made.nodes[t[k]], &b = made.nodes[t[(k + 1) % 3]];
      if (a[2] < 1) fine += distance(a, b), ++fines;
      if (a[2] > 7) coarse += distance(a, b), ++coarses;
    }
  EXPECT_GT(coarse / coarses, 1.6 * fine / fines);
}

TEST(SoundSurface, TurnsTrianglesThatLookInwards) {
  auto inverted = torus(5, 1);
  for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
  EXPECT_LT(enclosed_volume(inverted), 0);
  const auto sound = sound_surface(std::move(inverted), false, "torus.stl");
  EXPECT_GT(enclosed_volume(sound.surface), 0);
  EXPECT_FALSE(sound.done.empty());
}

TEST(WallThickness, RefusesAHoleWithItsPlace) {
  const auto surface = tube(1, 5);
  ThicknessTable table{"t.csv", {}, {}};
  for (const Point& x : surface.nodes)
    if (x[2] < 2) {
      table.places.push_back(x);
      table.values.push_back(0.1);
    }
  try {
    thickness_at(surface, table, 0);
    FAIL() << "a hole";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("has a hole at"), std::string::npos) << error.what();
  }
}

/// Layers inside a tube of radius 1 and its wall's curves, its own circles'.
struct LayersOfATube {
  TetrahedralMesh mesh;
  Levels levels;
  EdgeCurves curves;

  LayersOfATube() {
    const auto wall = turned(12, 4, [](double u, double v) { return Point{std::cos(u), std::sin(u), 2 * v}; });
    BoundaryLayers layers;
    layers.count = 3;
    layers.first = 0.02;
    const auto inner = moved_inwards(wall, layers);
    mesh.nodes = inner.nodes;
    mesh.regions = {"fluid"};
    levels = grow_layers(mesh, wall, inner, layers);
    for (const auto& [a, b, c] : wall.triangles)
      for (const auto& [one, other] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const Point half = 0.5 * (wall.nodes[one] + wall.nodes[other]);
        const double r = std::hypot(half[0], half[1]);
        curves[std::minmax(levels.nodes.back().at(one), levels.nodes.back().at(other))] = {half[0] / r, half[1] / r,
                                                                                           half[2]};
      }
  }
  double radius(const Point& x) const { return std::hypot(x[0], x[1]); }
};

TEST(CurvedColumns, OfATubeAreConcentric) {
  const LayersOfATube tube;
  const auto all = with_columns(tube.mesh, tube.levels, tube.curves);
  std::size_t found = 0;
  for (const auto& level : tube.levels.nodes) {
    std::set<int> nodes;
    for (const auto& [bottom, node] : level) nodes.insert(node);
    for (const auto& [edge, middle] : all)
      if (nodes.count(edge.first) + nodes.count(edge.second) == 2) {
        EXPECT_NEAR(tube.radius(middle), tube.radius(tube.mesh.nodes[edge.first]), 1e-12);
        EXPECT_NEAR(middle[2], 0.5 * (tube.mesh.nodes[edge.first][2] + tube.mesh.nodes[edge.second][2]), 1e-12);
        ++found;
      }
  }
  EXPECT_EQ(found, 4 * tube.curves.size());
  EXPECT_TRUE(folded_cells(with_curves(tube.mesh, all)).empty());
}

TEST(CurvedColumns, AreStraightAsAWholeWhereTheyFold) {
  LayersOfATube tube;
  auto& [edge, middle] = *std::next(tube.curves.begin(), 20);
  const Point wrong = middle = middle + 0.4 * (tube.mesh.nodes[edge.second] - tube.mesh.nodes[edge.first]);
  const auto kept = tube.curves.size();
  const auto straightened = straighten_folded_columns(tube.mesh, tube.levels, tube.curves);
  EXPECT_NE(std::find(straightened.begin(), straightened.end(), wrong), straightened.end());
  EXPECT_EQ(tube.curves.size() + straightened.size(), kept);
  EXPECT_LT(straightened.size(), 12U) << "around that edge alone";
  EXPECT_TRUE(folded_cells(with_curves(tube.mesh, with_columns(tube.mesh, tube.levels, tube.curves))).empty());
}

/// The layers' inner end was at 0.71 of their thickness on the rim of an opening that is cut at 45 degrees.
TEST(BoundaryLayers, AreAsThickAtSlantedOpenings) {
  const auto wall = turned(24, 24, [](double u, double v) {
    return Point{std::cos(u), std::sin(u), v * (6 + std::cos(u))};
  });
  BoundaryLayers layers;
  layers.count = 2;
  layers.first = 0.1;
  layers.growth = 1.5;
  const auto inner = moved_inwards(wall, layers);
  for (const Point& x : inner.nodes) {
    double least = 1e300;
    for (const auto& [a, b, c] : wall.triangles)
      least = std::min(least, distance_to_triangle(x, wall.nodes[a], wall.nodes[b], wall.nodes[c]));
    EXPECT_NEAR(least, 0.25, 1e-3);
  }
}

}  // namespace

}  // namespace fsi::test
