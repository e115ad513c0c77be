// Plug and parabola on openings of any shape.

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "fluid/opening_profile.hpp"
#include "opening_meshes.hpp"
#include "support/pi.hpp"

namespace fsi::test {

namespace {

double centre_velocity(const UnitInflow& inflow, const Point& inward) {
  return along<P1Tetrahedron>(inflow.velocity, 0, inward);
}
template <class Element>
double largest(const InflowOpening<Element>& opening, const UnitInflow& inflow, const Point& inward) {
  double most = 0;
  for (std::size_t a = 0; a < opening.nodes.size(); ++a)
    most = std::max(most, along<Element>(inflow.velocity, static_cast<int>(a), inward));
  return most;
}

/// One unit of flow, along the normal alone, nothing where the fluid sticks.
template <class Element>
void expect_unit_flow(const InflowOpening<Element>& opening, const UnitInflow& inflow, const Point& inward) {
  using Layout = VectorLayout<Element::components>;
  EXPECT_NEAR(discrete_inflow(opening, inflow.velocity), 1, 1e-13);
  for (std::size_t a = 0; a < opening.nodes.size(); ++a) {
    const double size = along<Element>(inflow.velocity, static_cast<int>(a), inward);
    for (int k = 0; k < Element::components; ++k)
      EXPECT_NEAR(inflow.velocity[Layout::vector(static_cast<int>(a), k)], size * inward[Element::axis[k]], 1e-14);
    if (opening.sticking[a]) {
      EXPECT_EQ(size, 0);
    }
  }
}

template <class Element>
void check_disk() {
  const auto opening = flat_opening<Element>(disk(1.4, 6, 24), everywhere);
  const auto plug = plug_inflow(opening), parabola = parabolic_inflow(opening);
  EXPECT_EQ(plug.instead, "");
  EXPECT_EQ(parabola.instead, "");
  const Point inward = tilted_inward();
  expect_unit_flow(opening, plug, inward);
  expect_unit_flow(opening, parabola, inward);
  EXPECT_NEAR(along<Element>(plug.velocity, 0, inward), along<Element>(plug.velocity, 25, inward), 1e-15);
  for (std::size_t a = 0; a < opening.nodes.size(); ++a)
    if (!opening.sticking[a]) {
      const double s = distance(opening.nodes[a], opening.nodes[0]) / 1.4;
      EXPECT_NEAR(along<Element>(parabola.velocity, static_cast<int>(a), inward),
                  (1 - s * s) * along<Element>(parabola.velocity, 0, inward), 1e-14);
    }
}

TEST(InflowProfile, OverADiskInAnyDirection) {
  check_disk<P1Tetrahedron>();
  check_disk<P2P1Tetrahedron>();
}

TEST(InflowProfile, ComponentsThroughPlanesOfSymmetryAreZeroToTheBit) {
  InflowOpening<P1Tetrahedron> quarter =
      flat_opening<P1Tetrahedron>(sector(1.4, 0.5 * pi, 5, 8), [](const Point& x) { return norm(x) > 1.39; });
  // Turned so that the planes of symmetry are x = 0 and y = 0 of space again.
  for (auto& x : quarter.nodes) {
    const Point from_centre = x - tilted({0, 0, 0});
    x = {dot(from_centre, tilted({1, 0, 0}) - tilted({0, 0, 0})),
         dot(from_centre, tilted({0, 1, 0}) - tilted({0, 0, 0})), dot(from_centre, tilted_inward())};
  }
  const auto parabola = parabolic_inflow(quarter);
  expect_unit_flow(quarter, parabola, {0, 0, 1});
  for (std::size_t a = 0; a < quarter.nodes.size(); ++a)
    for (int k : {0, 1}) EXPECT_EQ(parabola.velocity[3 * a + static_cast<std::size_t>(k)], 0);
}

/// Poiseuille's flow has 2/(pi R^2) at its centre: second order of linear facets, of quadratic ones on a polygon too.
TEST(InflowProfile, ParabolaOverACircleConvergesToPoiseuillesFlow) {
  double before = 0;
  for (int m : {1, 2, 4}) {
    const auto opening = flat_opening<P1Tetrahedron>(disk(1.4, 3 * m, 12 * m), everywhere);
    const double error = centre_velocity(parabolic_inflow(opening), tilted_inward()) * pi * 1.4 * 1.4 / 2 - 1;
    if (before != 0) {
      EXPECT_NEAR(std::log2(before / error), 2, 0.15);
    }
    before = error;
  }
}

TEST(InflowProfile, ParabolaIsExactInAPipeOfRevolutionAndAChannel) {
  const auto pipe = line_opening<P2P1AxisymmetricTriangle>({0, 0, 2}, {1.4, 0, 2}, 3, false, true);
  const auto round = parabolic_inflow(pipe);
  expect_unit_flow(pipe, round, {0, 0, 1});
  EXPECT_NEAR(round.velocity[1], 2 / (pi * 1.4 * 1.4), 1e-14);
  const auto channel = line_opening<P2P1PlaneTriangle>({1, 0, 0}, {4, 4, 0}, 4, true, true);
  const auto flat = parabolic_inflow(channel);
  expect_unit_flow(channel, flat, {-0.8, 0.6, 0});
  EXPECT_NEAR(along<P2P1PlaneTriangle>(flat.velocity, 4, {-0.8, 0.6, 0}), 1.5 / 5, 1e-14);
  const auto half = line_opening<P2P1PlaneTriangle>({1, 0, 0}, {4, 4, 0}, 4, false, true);
  EXPECT_NEAR(along<P2P1PlaneTriangle>(parabolic_inflow(half).velocity, 0, {-0.8, 0.6, 0}), 1.5 / 5, 1e-14);
}

/// Fully developed flow in an annulus of outer radius 1 and inner radius k: 1 - r^2 - (1 - k^2) ln r / ln k.
TEST(InflowProfile, AnnulusHasItsOwnProfile) {
  const double k = 0.4;
  const auto exact = [&](double r) { return 1 - r * r - (1 - k * k) * std::log(r) / std::log(k); };
  double before = 0;
  for (int n : {4, 8}) {
    const auto opening = line_opening<P2P1AxisymmetricTriangle>({k, 0, 0}, {1, 0, 0}, n, true, true);
    const auto inflow = parabolic_inflow(opening);
    EXPECT_EQ(inflow.instead,
              "the surface in is no flat circle about the axis: the flow that is fully developed on its own facets is "
              "let in, the discrete solution of "
              "-Laplace w = 1");
    expect_unit_flow(opening, inflow, {0, 0, 1});
    double flow = 0;  // of the exact profile, by Simpson's rule
    constexpr int steps = 400;
    for (int i = 0; i <= steps; ++i) {
      const double r = k + (1 - k) * i / steps;
      flow += (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * (1 - k) / steps / 3 * 2 * pi * r * exact(r);
    }
    double error = 0;  // of the velocity, over the mean velocity
    for (std::size_t a = 0; a < opening.nodes.size(); ++a)
      error =
          std::max(error, std::abs(inflow.velocity[2 * a + 1] - exact(opening.nodes[a][0]) / flow) * pi * (1 - k * k));
    EXPECT_LT(error, 2e-3);
    if (before != 0) {
      EXPECT_GT(std::log2(before / error), 2.8);
    }
    before = error;
  }
}

/// An elliptic duct: 1 - (x/a)^2 - (y/b)^2, twice its mean in the middle.
template <class Element>
double ellipse_error(int m) {
  const auto squeezed = disk(1, 4 * m, 16 * m);
  auto plane = squeezed;
  for (auto& x : plane.nodes) x[1] *= 0.5;
  const auto opening = flat_opening<Element>(plane, everywhere);
  const auto inflow = parabolic_inflow(opening);
  EXPECT_EQ(inflow.instead,
            "the surface in is no flat circle: the flow that is fully developed on its own facets is let in, the "
            "discrete solution of "
            "-Laplace w = 1");
  const Point inward = tilted_inward();
  expect_unit_flow(opening, inflow, inward);
  return std::abs(along<Element>(inflow.velocity, 0, inward) * pi * 0.5 / 2 - 1);
}
TEST(InflowProfile, EllipticDuct) {
  EXPECT_NEAR(std::log2(ellipse_error<P1Tetrahedron>(2) / ellipse_error<P1Tetrahedron>(4)), 2, 0.2);
  EXPECT_LT(ellipse_error<P1Tetrahedron>(4), 0.007);
  EXPECT_NEAR(std::log2(ellipse_error<P2P1Tetrahedron>(1) / ellipse_error<P2P1Tetrahedron>(2)), 2, 0.1) << "of the rim";
}

/// A square duct has 2.09626 times its mean velocity in the middle [White2006, section 3-3].
TEST(InflowProfile, SquareDuct) {
  const auto opening = flat_opening<P2P1Tetrahedron>(rectangle(1, 1, 8, 8), everywhere);
  const auto inflow = parabolic_inflow(opening);
  expect_unit_flow(opening, inflow, tilted_inward());
  EXPECT_NEAR(largest(opening, inflow, tilted_inward()), 2.09626, 2e-3);
}

/// A parabola along each side: twice and a quarter the mean in the middle, also where a plane of symmetry halves the duct.
TEST(InflowProfile, BiparabolicOnARectangle) {
  const auto plane = rectangle(0.8, 0.4, 8, 4);
  const auto check = [](const auto& opening, double area, const auto& shape) {
    const auto inflow = biparabolic_inflow(opening);
    EXPECT_EQ(inflow.instead, "");
    expect_unit_flow(opening, inflow, tilted_inward());
    const double top = largest(opening, inflow, tilted_inward());
    EXPECT_NEAR(top * area, 2.25, 1e-3) << "of the flow of quadratic shape functions";
    for (std::size_t a = 0; a < opening.nodes.size(); ++a)
      EXPECT_NEAR(along<P2P1Tetrahedron>(inflow.velocity, static_cast<int>(a), tilted_inward()),
                  top * shape(opening.nodes[a]), 1e-12);
  };
  const Point e1 = tilted({1, 0, 0}) - tilted({0, 0, 0}), e2 = tilted({0, 1, 0}) - tilted({0, 0, 0});
  const auto place = [&](const Point& x, const Point& along) { return dot(x - tilted({0, 0, 0}), along); };
  const auto parabola = [](double s, double length) { return 4 * s * (length - s) / (length * length); };
  check(flat_opening<P2P1Tetrahedron>(plane, everywhere), 0.32,
        [&](const Point& x) { return parabola(place(x, e1), 0.8) * parabola(place(x, e2), 0.4); });
  check(flat_opening<P2P1Tetrahedron>(plane,
                                      [](const Point& x) { return x[0] > 1e-9 || x[1] < 1e-9 || x[1] > 0.4 - 1e-9; }),
        0.32, [&](const Point& x) { return parabola(place(x, e1) + 0.8, 1.6) * parabola(place(x, e2), 0.4); });
  for (const auto& wrong : {flat_opening<P2P1Tetrahedron>(disk(1.4, 4, 16), everywhere),
                            flat_opening<P2P1Tetrahedron>(plane, [](const Point& x) { return x[0] < 0.3; })})
    EXPECT_THROW(biparabolic_inflow(wrong), InputError);
}

TEST(InflowProfile, WithoutAWalledRimTheParabolaIsAPlug) {
  const auto opening = line_opening<P1PlaneTriangle>({1, 0, 0}, {4, 4, 0}, 4, false, false);
  const auto inflow = parabolic_inflow(opening);
  EXPECT_NE(inflow.instead.find("sticks nowhere"), std::string::npos);
  EXPECT_EQ(inflow.velocity, plug_inflow(opening).velocity);
  EXPECT_NEAR(along<P1PlaneTriangle>(inflow.velocity, 2, {-0.8, 0.6, 0}), 0.2, 1e-15);
}

}  // namespace

}  // namespace fsi::test
