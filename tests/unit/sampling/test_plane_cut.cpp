// Flow, mean pressure and area of planes through tubes, against closed forms.

#include "sampling/plane_cut.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "fem/nodal_layout.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "support/pi.hpp"
#include "support/vessels.hpp"

namespace fsi::test {
namespace {

using Field = std::function<double(const Point&)>;
using VectorField = std::function<Point(const Point&)>;

template <int Dim>
std::vector<double> flow_array(const PartNodes& part, const VectorField& u, const Field& p,
                               const std::array<int, Dim>& axes) {
  std::vector<double> fluid(MixedLayout<Dim>::size(part.node_count()));
  for (int a = 0; a < part.node_count(); ++a) {
    const Point velocity = u(part.nodes[a]);
    for (int k = 0; k < Dim; ++k) fluid[MixedLayout<Dim>::vector(a, k)] = velocity[axes[k]];
    fluid[MixedLayout<Dim>::scalar(a)] = p(part.nodes[a]);
  }
  return fluid;
}
constexpr std::array<int, 3> space{0, 1, 2};

double area_of(const std::vector<Point>& nodes, const std::vector<std::array<int, 3>>& facets) {
  double sum = 0;
  for (const auto& f : facets) sum += norm(triangle_area_vector(nodes[f[0]], nodes[f[1]], nodes[f[2]]));
  return sum;
}

const Field sloping = [](const Point& x) { return 3 + 2 * x[2] - x[0]; };

TEST(PlaneCut, UniformFlowThroughObliquePlanesIsThatOfTheInlet) {
  const auto tube = straight_vessel<1>(4, 2, 5);
  const double inlet = area_of(tube.part.nodes, tube.inlet);
  const auto fluid = flow_array<3>(
      tube.part,
      [](const Point&) {
        return Point{0, 0, 2};
      },
      sloping, space);
  for (const Point& normal : {Point{0, 0, 1}, Point{0.3, 0.2, 1}, Point{1, 0, 1}}) {
    const auto cut = plane_cut(tube.part, {0.1, 0, 1.93}, normal, false);
    ASSERT_TRUE(cut);
    const auto row = cut->look({}, fluid);
    EXPECT_NEAR(row.flow, 2 * inlet, 1e-12);
    EXPECT_NEAR(row.area * normal[2] / norm(normal), inlet, 1e-12);  // projected along the tube
    const auto back = plane_cut(tube.part, {0.1, 0, 1.93}, -1 * normal, false)->look({}, fluid);
    EXPECT_NEAR(back.flow, -2 * inlet, 1e-12);
    EXPECT_NEAR(back.area, row.area, 1e-12);
  }
  // Of a linear pressure the mean is its value at the centroid, which lies on the axis.
  EXPECT_NEAR(plane_cut(tube.part, {0, 0, 1.93}, {0, 0, 1}, false)->look({}, fluid).pressure, 3 + 2 * 1.93, 1e-12);
}

TEST(PlaneCut, OnAFaceOrBetweenCellsCountsEveryFacetOnce) {
  const auto tube = straight_vessel<1>(4, 2, 4);  // layers of nodes at z = 0, 1, 2, 3, 4
  const auto fluid = flow_array<3>(
      tube.part,
      [](const Point&) {
        return Point{0, 0, 1};
      },
      sloping, space);
  const double inlet = area_of(tube.part.nodes, tube.inlet);
  for (const double z : {0.0, 1.0, 2.0, 4.0})
    for (const double sign : {-1.0, 1.0}) {
      const auto cut = plane_cut(tube.part, {0, 0, z}, {0, 0, sign}, false);
      ASSERT_TRUE(cut) << z;
      EXPECT_NEAR(cut->look({}, fluid).flow, sign * inlet, 1e-12) << z;
      EXPECT_NEAR(cut->look({}, fluid).pressure, 3 + 2 * z, 1e-11) << z;
    }
  EXPECT_FALSE(plane_cut(tube.part, {0, 0, 4.1}, {0, 0, 1}, false));
}

// Mesh generators place nodes to some 1e-12 of a length: of the nodes of an edge in the plane some then lie off it by more
// than what counts as on it, and the quadratic between them is on the other side where they are not.
TEST(PlaneCut, NextToNodesThatLieNearlyInItMissesNothing) {
  auto tube = straight_vessel<2>(4, 2, 4);
  const double inlet = plane_cut(tube.part, {0, 0, 0.5}, {0, 0, 1}, false)
                           ->look({}, std::vector<double>(MixedLayout<3>::size(tube.part.node_count())))
                           .area;
  std::mt19937 numbers(3);
  std::uniform_int_distribution<int> off(-2, 2);
  for (Point& x : tube.part.nodes) x[2] += 3.1e-12 * off(numbers);
  const auto fluid = flow_array<3>(
      tube.part,
      [](const Point&) {
        return Point{0, 0, 1};
      },
      sloping, space);
  for (const double z : {1.0, 2.0, 3.0})
    for (const double sign : {-1.0, 1.0}) {
      const auto row = plane_cut(tube.part, {0, 0, z}, {0, 0, sign}, false)->look({}, fluid);
      EXPECT_NEAR(row.area, inlet, 1e-6) << z;
      EXPECT_NEAR(row.flow, sign * inlet, 1e-6) << z;
    }
}

TEST(PlaneCut, FollowsAMeshThatMoves) {
  const auto tube = straight_vessel<1>(4, 2, 5);
  const auto fluid = flow_array<3>(
      tube.part,
      [](const Point&) {
        return Point{0, 0, 1};
      },
      sloping, space);
  const double inlet = area_of(tube.part.nodes, tube.inlet);
  // Wider by a tenth, and moved along z by 0.3 mm: the plane stands still.
  std::vector<double> mesh(VectorLayout<3>::size(tube.part.node_count()));
  for (int a = 0; a < tube.part.node_count(); ++a) {
    for (int k = 0; k < 2; ++k) mesh[VectorLayout<3>::vector(a, k)] = 0.1 * tube.part.nodes[a][k];
    mesh[VectorLayout<3>::vector(a, 2)] = 0.3;
  }
  const auto row = plane_cut(tube.part, {0, 0, 1.9}, {0, 0, 1}, false)->look(mesh, fluid);
  EXPECT_NEAR(row.flow, 1.21 * inlet, 1e-12);
  EXPECT_NEAR(row.area, 1.21 * inlet, 1e-12);
  EXPECT_NEAR(row.pressure, 3 + 2 * 1.6, 1e-12);
}

TEST(PlaneCut, TakesThePieceNearestToItsOrigin) {
  constexpr double bend = 5;
  auto tube = straight_vessel<1>(bend * pi, 2, 24);  // a U
  bend_about(bend, tube.part);
  // Along the bent axis at 1 mm/ms.
  const auto fluid = flow_array<3>(
      tube.part,
      [](const Point& x) {
        const double angle = std::atan2(x[2], bend - x[0]);
        return Point{std::sin(angle), 0, std::cos(angle)};
      },
      sloping, space);
  const auto first = plane_cut(tube.part, {0, 0, 0.5}, {0, 0, 1}, false)->look({}, fluid);
  const auto second = plane_cut(tube.part, {2 * bend, 0, 0.5}, {0, 0, 1}, false)->look({}, fluid);
  EXPECT_NEAR(first.area, pi, 0.25);
  EXPECT_NEAR(first.flow, pi, 0.3);
  EXPECT_NEAR(second.flow, -first.flow, 0.05);
}

TEST(PlaneCut, AreasOfCurvedCellsAddUpToTheirVolume) {
  auto tube = straight_vessel<2>(4, 2, 4);
  for (Point& x : tube.part.nodes) {  // bulging, so that the distance from the plane bends in the cells, too
    const double wider = 1 + 0.2 * std::sin(x[2]);
    x = {wider * x[0], wider * x[1], x[2] + 0.1 * x[0] * x[0] * std::sin(pi / 4 * x[2])};
  }
  double volume = 0;
  for (const auto& cell : tube.part.cells) {
    std::array<Point, 10> x;
    for (int i = 0; i < 10; ++i) x[i] = tube.part.nodes[cell[i]];
    volume += cell_jacobian<3>(x).mean / 6;
  }
  const auto fluid = flow_array<3>(
      tube.part,
      [](const Point&) {
        return Point{0, 0, 1};
      },
      sloping, space);
  constexpr int planes = 100;
  const double low = 0, high = 4;
  double sum = 0;
  for (int i = 0; i < planes; ++i) {
    const auto cut = plane_cut(tube.part, {0, 0, low + (high - low) * (i + 0.5) / planes}, {0, 0, 1}, false);
    if (cut) sum += (high - low) / planes * cut->look({}, fluid).area;
  }
  std::printf("areas of planes add up to %.8f mm^3 of %.8f\n", sum, volume);
  EXPECT_NEAR(sum, volume, 1e-5 * volume);
}

TEST(PlaneCut, FlowThroughCurvedCellsIsThatOfTheInlet) {
  const auto tube = straight_vessel<2>(4, 3, 5);
  // Linear and without divergence; along the wall of the tube.
  const auto swirl = [](const Point& x) { return Point{-x[1], x[0], 2}; };
  const auto fluid = flow_array<3>(tube.part, swirl, sloping, space);
  const auto inlet = plane_cut(tube.part, {0, 0, 0}, {0, 0, 1}, false)->look({}, fluid);
  EXPECT_NEAR(inlet.area, pi, 2e-3);
  for (const Point& normal : {Point{0, 0, 1}, Point{0.5, 0.2, 1}}) {
    const auto row = plane_cut(tube.part, {0, 0, 2.07}, normal, false)->look({}, fluid);
    EXPECT_NEAR(row.area * normal[2] / norm(normal), pi, 3e-3);
    EXPECT_NEAR(row.flow, 2 * pi, 5e-3);
    EXPECT_NEAR(row.pressure, 3 + 2 * 2.07, 5e-3);
  }
}

TEST(PlaneCut, OfTrianglesIsALineOrWhatItsTurningSweeps) {
  ArteryShape shape;
  shape.inner_radius = 1.5;
  shape.length = 2;
  ArteryCells cells;
  cells.lumen = 3;
  cells.media = cells.adventitia = 1;
  cells.axial = 5;
  const auto section = generate_artery_section(shape, cells);
  const auto expect = [&](const auto& tube) {
    // Poiseuille's flow, exact for quadratic cells; of linear ones the plug.
    constexpr bool quadratic = std::tuple_size_v<typename std::decay_t<decltype(tube.part)>::Cell> == 6;
    const auto u = [&](const Point& x) { return Point{0, 0, quadratic ? 2.25 - x[0] * x[0] : 1.0}; };
    const auto fluid = flow_array<2>(tube.part, u, [](const Point& x) { return x[2]; }, {0, 2});
    const auto turned = plane_cut(tube.part, {0, 0, 0.77}, {0, 0, 1}, true)->look({}, fluid);
    const double area = pi * 2.25;
    EXPECT_NEAR(turned.area, area, 1e-12);
    EXPECT_NEAR(turned.flow, quadratic ? pi / 2 * 2.25 * 2.25 : area, 1e-12);
    EXPECT_NEAR(turned.pressure, 0.77, 1e-12);
    EXPECT_FALSE(plane_cut(tube.part, {0, 0, 0.77}, {0, 1, 0}, true));
  };
  expect(fluid_of(section));
  expect(fluid_of(with_mid_edge_nodes(section)));

  auto plane = fluid_of(section);  // the same in the plane of x and y
  for (Point& x : plane.part.nodes) x = {x[0], x[2], 0};
  const auto fluid = flow_array<2>(plane.part, [](const Point&) { return Point{0, 3, 0}; }, sloping, {0, 1});
  const auto row = plane_cut(plane.part, {0, 0.77, 0}, {0, 1, 0}, false)->look({}, fluid);
  EXPECT_NEAR(row.area, 1.5, 1e-12);
  EXPECT_NEAR(row.flow, 4.5, 1e-12);
  EXPECT_NEAR(row.pressure, 3 - 0.75, 1e-12);
}

}  // namespace
}  // namespace fsi::test
