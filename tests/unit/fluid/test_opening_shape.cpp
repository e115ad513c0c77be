// What is taken for a circle, or a segment, and what is not.

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "fluid/opening_shape.hpp"
#include "opening_meshes.hpp"
#include "support/messages.hpp"
#include "support/pi.hpp"

namespace fsi::test {

namespace {

using Kind = OpeningShape::Kind;

void expect_circle(const OpeningShape& shape, double radius) {
  ASSERT_EQ(shape.kind, Kind::circle);
  EXPECT_NEAR(shape.radius, radius, 1e-12);
  EXPECT_LT(distance(shape.centre, tilted({0, 0, 0})), 1e-12);
  EXPECT_LT(distance(shape.inward, tilted_inward()), 1e-12);
}

TEST(OpeningShape, CoarsePolygonsBetweenPointsOfACircleAreOne) {
  for (int around : {6, 7, 30}) {
    expect_circle(shape_of(flat_opening<P1Tetrahedron>(disk(1.4, 2, around), everywhere)), 1.4);
    expect_circle(shape_of(flat_opening<P2P1Tetrahedron>(disk(1.4, 2, around), everywhere)), 1.4);
  }
}

TEST(OpeningShape, QuadraticEdgesOnTheCircleCountAsTwo) {
  const auto onto_circle = [](const Point& x) { return (1.4 / norm(x)) * x; };
  const auto coarse = disk(1.4, 2, 5);
  expect_circle(shape_of(flat_opening<P2P1Tetrahedron>(coarse, everywhere, onto_circle)), 1.4);
  EXPECT_EQ(shape_of(flat_opening<P2P1Tetrahedron>(coarse, everywhere)).kind, Kind::other) << "straight edges";
}

TEST(OpeningShape, SectorsBetweenPlanesOfSymmetryAreCircles) {
  for (double angle : {0.5 * pi, pi, pi / 6, 0.4}) {
    const auto mesh = sector(1.4, angle, 3, angle > 3 ? 8 : 4);
    const auto on_arc = [](const Point& x) { return norm(x) > 1.39; };
    expect_circle(shape_of(flat_opening<P1Tetrahedron>(mesh, on_arc)), 1.4);
    expect_circle(shape_of(flat_opening<P2P1Tetrahedron>(mesh, [](const Point& x) { return norm(x) > 1.3; })), 1.4);
  }
}

TEST(OpeningShape, ARimOfSegmentedPicturesMayMissTheCircleByLessThanOnePercent) {
  for (const auto& [miss, kind] : {std::pair{0.008, Kind::circle}, std::pair{0.03, Kind::other}}) {
    const auto rough = [miss = miss](const Point& x) { return (1 + miss * std::sin(40 * x[0] + 17 * x[1])) * x; };
    EXPECT_EQ(shape_of(flat_opening<P1Tetrahedron>(disk(1.4, 4, 24), everywhere, rough)).kind, kind) << miss;
    const auto warped = [miss = miss](const Point& x) { return Point{x[0], x[1], 1.4 * miss * std::sin(5 * x[0])}; };
    EXPECT_EQ(shape_of(flat_opening<P1Tetrahedron>(disk(1.4, 4, 24), everywhere, warped)).kind, kind) << miss;
  }
}

TEST(OpeningShape, OtherShapesAreNotCircles) {
  const auto squeezed = [](const Point& x) { return Point{x[0], 0.9 * x[1], 0}; };
  EXPECT_EQ(shape_of(flat_opening<P1Tetrahedron>(disk(1, 3, 24), everywhere, squeezed)).kind, Kind::other);
  for (int n : {2, 5}) {
    EXPECT_EQ(shape_of(flat_opening<P1Tetrahedron>(rectangle(1, 1, n, n), everywhere)).kind, Kind::other);
    EXPECT_EQ(shape_of(flat_opening<P2P1Tetrahedron>(rectangle(1, 1, n, n), everywhere)).kind, Kind::other);
  }
  // Half a disk that is walled all round; a sector whose free sides do not meet in the centre.
  EXPECT_EQ(shape_of(flat_opening<P1Tetrahedron>(sector(1, pi, 3, 8), everywhere)).kind, Kind::other);
  auto shifted = sector(1, 0.5 * pi, 3, 6);
  for (auto& x : shifted.nodes)
    if (norm(x) < 0.99) x = x + Point{0.1 * (1 - norm(x)), 0.2 * (1 - norm(x)), 0};
  EXPECT_EQ(shape_of(flat_opening<P1Tetrahedron>(shifted, [](const Point& x) { return norm(x) > 0.99; })).kind,
            Kind::other);
  // A strut across it.
  auto strut = flat_opening<P1Tetrahedron>(disk(1, 3, 24), everywhere);
  strut.sticking[0] = 1;
  EXPECT_EQ(shape_of(strut).kind, Kind::other);
}

TEST(OpeningShape, OfTriangleMeshes) {
  const auto pipe = shape_of(line_opening<P2P1AxisymmetricTriangle>({0, 0, 2}, {1.4, 0, 2}, 3, false, true));
  EXPECT_EQ(pipe.kind, Kind::circle);
  EXPECT_DOUBLE_EQ(pipe.radius, 1.4);
  EXPECT_EQ(pipe.inward, (Point{0, 0, 1}));
  const auto back = shape_of(line_opening<P1AxisymmetricTriangle>({1.4, 0, 2}, {0, 0, 2}, 3, true, false));
  EXPECT_EQ(back.kind, Kind::circle);
  EXPECT_EQ(back.inward, (Point{0, 0, -1}));
  EXPECT_EQ(shape_of(line_opening<P1AxisymmetricTriangle>({0.4, 0, 2}, {1.4, 0, 2}, 3, true, true)).kind, Kind::other);
  EXPECT_EQ(shape_of(line_opening<P1AxisymmetricTriangle>({0, 0, 2}, {1.4, 0, 2.3}, 3, false, true)).kind, Kind::other);

  const auto channel = shape_of(line_opening<P1PlaneTriangle>({1, 0, 0}, {4, 4, 0}, 4, true, true));
  EXPECT_EQ(channel.kind, Kind::segment);
  EXPECT_DOUBLE_EQ(channel.radius, 2.5);
  EXPECT_LT(distance(channel.centre, {2.5, 2, 0}), 1e-14);
  EXPECT_LT(distance(channel.inward, {-0.8, 0.6, 0}), 1e-14);
  for (bool first : {true, false}) {
    const auto half = shape_of(line_opening<P2P1PlaneTriangle>({1, 0, 0}, {4, 4, 0}, 4, first, !first));
    EXPECT_EQ(half.kind, Kind::segment);
    EXPECT_DOUBLE_EQ(half.radius, 5);
    EXPECT_LT(distance(half.centre, first ? Point{4, 4, 0} : Point{1, 0, 0}), 1e-14);
  }
  const auto free = shape_of(line_opening<P1PlaneTriangle>({1, 0, 0}, {4, 4, 0}, 4, false, false));
  EXPECT_EQ(free.kind, Kind::other);
  EXPECT_FALSE(free.walled);
}

TEST(OpeningShape, WithoutAFreeNodeNothingCanFlow) {
  auto opening = flat_opening<P1Tetrahedron>(rectangle(1, 1, 1, 1), everywhere);
  opening.file = "case.toml";
  EXPECT_EQ(message_of<InputError>([&] { shape_of(opening); }),
            "case.toml: opening.in: the fluid sticks at every node of this surface, so that none can flow through it; "
            "refine the mesh there, "
            "so that nodes lie inside the opening");
}

TEST(OpeningShape, ASurfaceAroundTheFluidHasNoMeanNormal) {
  InflowOpening<P1PlaneTriangle> ring;
  ring.name = "in";
  ring.file = "case.toml";
  for (int i = 0; i < 12; ++i) {
    ring.nodes.push_back({std::cos(pi * i / 6), std::sin(pi * i / 6), 0});
    ring.facets.push_back({i, (i + 1) % 12});
  }
  ring.sticking.assign(12, 0);
  EXPECT_EQ(message_of<InputError>([&] { shape_of(ring); }),
            "case.toml: opening.in: this surface has no mean normal for the flow to follow; take a flow rate through a "
            "surface that does not "
            "surround the fluid");
}

}  // namespace

}  // namespace fsi::test
