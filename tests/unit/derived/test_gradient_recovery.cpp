// Recovered gradients: exact for polynomials of a degree above the element's, at boundaries too, and of the order that
// follows for others. They turn with the body, and at planes of symmetry they are those of the whole body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "derived/gradient_recovery.hpp"
#include "derived/surface_shape.hpp"
#include "fem/elements.hpp"
#include "fem/nodal_layout.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/point_math.hpp"
#include "support/element_meshes.hpp"
#include "support/orthogonal.hpp"
#include "support/random.hpp"
#include "support/vessels.hpp"

namespace fsi::test {

namespace {

template <class Element>
class RecoveredGradients : public testing::Test {};
using Kinds = testing::Types<P1Tetrahedron, P1AxisymmetricTriangle, P1PlaneTriangle, P2P1Tetrahedron,
                             P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(RecoveredGradients, Kinds);

template <class Element>
GradientRecovery recovery(const SimplexMesh<Element::dim, Element::order>& mesh) {
  RecoveryCells cells{
      mesh.nodes,           {}, Element::nodes, Element::order, {std::begin(Element::axis), std::end(Element::axis)},
      Element::axisymmetric};
  for (const auto& cell : mesh.cells) cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
  std::vector<int> all(mesh.nodes.size());
  for (std::size_t a = 0; a < all.size(); ++a) all[a] = static_cast<int>(a);
  return {cells, all};
}

/// Largest error at any node of the gradient of a field whose component k is f(s, k), s = x . direction + 0.3 k.
template <class Element, class Function, class Slope>
double largest_error(const SimplexMesh<Element::dim, Element::order>& mesh, Function f, Slope slope) {
  constexpr int n = Element::components;
  const double direction[3] = {0.6, 0.9, 0.4};
  const auto along = [&](const Point& x, int k) {
    double s = 0.3 * k;
    for (const int axis : Element::axis) s += direction[axis] * x[axis];
    return s;
  };
  std::vector<double> field(VectorLayout<n>::size(static_cast<int>(mesh.nodes.size())));
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    for (int k = 0; k < n; ++k) field[VectorLayout<n>::vector(static_cast<int>(a), k)] = f(along(mesh.nodes[a], k));
  const GradientRecovery gradients = recovery<Element>(mesh);
  EXPECT_EQ(gradients.fallbacks(), 0u);
  double largest = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    Mat3<double> h = gradients.gradient<VectorLayout<n>>(a, field);
    for (int k = 0; k < n; ++k)
      for (const int axis : Element::axis)
        h(Element::axis[k], axis) -= direction[axis] * slope(along(mesh.nodes[a], k));
    if (Element::axisymmetric) h(1, 1) -= f(along(mesh.nodes[a], 0)) / mesh.nodes[a][0];
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(h(i / 3, i % 3)));
  }
  return largest;
}

TYPED_TEST(RecoveredGradients, AreExactForAPolynomialOfADegreeAboveTheElements) {
  constexpr int degree = TypeParam::order + 1;
  const auto mesh = irregular_mesh<TypeParam>(TypeParam::dim == 3 ? 3 : 5);
  EXPECT_LT(largest_error<TypeParam>(
                mesh, [](double s) { return std::pow(s, degree); },
                [](double s) { return degree * std::pow(s, degree - 1); }),
            1e-11);
}

TYPED_TEST(RecoveredGradients, HaveTheOrderAboveTheElements) {
  const int n = TypeParam::dim == 3 ? 4 : 8, finer = TypeParam::dim == 3 ? 1 : 3;  // times halved
  double errors[2];
  for (int level = 0; level < 2; ++level)
    errors[level] = largest_error<TypeParam>(
        irregular_mesh<TypeParam>(level == 0 ? n : n << finer), [](double s) { return std::sin(1.5 * s); },
        [](double s) { return 1.5 * std::cos(1.5 * s); });
  const double order = std::log2(errors[0] / errors[1]) / finer;
  std::printf("largest error %.2e, %.2e: order %.2f\n", errors[0], errors[1], order);
  EXPECT_GT(order, TypeParam::order + 1 - 0.25);
}

// One linear element thick: there is no power of the radius but the first, or none that can be told from the others.
// Linear fields of space stay exact, quadratic ones have an error of the thickness.
TEST(RecoveredGradientsOfThinLayers, KeepTheElementsOrder) {
  for (const bool curved : {false, true}) {
    double errors[2];
    for (int level = 0; level < 2; ++level) {
      const double thickness = 0.1 / (1 << level);
      const int along = 20 << level;
      const auto mesh = triangle_grid(
          {1, along}, {"wall"},
          [&](int i, int j) {
            const double r = 1 + i * thickness, angle = 1.5 * j / along;
            return curved ? Point{r * std::cos(angle), 0, r * std::sin(angle)} : Point{r, 0, angle};
          },
          [](int, int) { return 0; });
      RecoveryCells cells{mesh.nodes, {}, 3, 1, {0, 2}};
      for (const auto& cell : mesh.cells) cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
      std::vector<int> all(mesh.nodes.size());
      for (std::size_t a = 0; a < all.size(); ++a) all[a] = static_cast<int>(a);
      const GradientRecovery gradients(cells, all);
      if (!curved) {
        EXPECT_EQ(gradients.fallbacks(), mesh.nodes.size());
      }
      std::vector<double> linear, square;
      for (const auto& x : mesh.nodes) {
        linear.insert(linear.end(), {2 * x[0] - x[2], x[0] + 3 * x[2]});
        square.insert(square.end(), {x[0] * x[0] + x[2] * x[2], 0});
      }
      errors[level] = 0;
      for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
        const auto h = gradients.gradient<VectorLayout<2>>(a, linear);
        const auto s = gradients.gradient<VectorLayout<2>>(a, square);
        const Point& x = mesh.nodes[a];
        EXPECT_NEAR(h(0, 0), 2, 1e-10);
        EXPECT_NEAR(h(0, 2), -1, 1e-10);
        EXPECT_NEAR(h(2, 0), 1, 1e-10);
        EXPECT_NEAR(h(2, 2), 3, 1e-10);
        errors[level] = std::max({errors[level], std::abs(s(0, 0) - 2 * x[0]), std::abs(s(0, 2) - 2 * x[2])});
        if (!curved) {
          EXPECT_NEAR(s(0, 2), 2 * x[2], 1e-10) << "along the layer it has its full degree";
        }
      }
    }
    std::printf("thin layer: largest error %.2e, %.2e\n", errors[0], errors[1]);
    EXPECT_LT(errors[0], 0.11);
    EXPECT_LT(errors[1], 0.055);
  }
}

// A layer whose thickness rounding hides from second moments: a message, no weights of noise.
TEST(RecoveredGradientsOfThinLayers, AreRefusedWhereRoundingHidesTheThickness) {
  const auto layer = [](double thickness) {
    const auto mesh = triangle_grid(
        {1, 4}, {"wall"},
        [&](int i, int j) {
          return Point{1 + i * thickness, 0, 0.25 * j};
        },
        [](int, int) { return 0; });
    RecoveryCells cells{mesh.nodes, {}, 3, 1, {0, 2}};
    for (const auto& cell : mesh.cells) cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
    GradientRecovery(cells, {0});
  };
  EXPECT_NO_THROW(layer(1e-4));
  try {
    layer(1e-8);
    FAIL() << "no message";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mesh: all cells around the node at (1, 0, 0) mm are too flat"),
              std::string::npos)
        << error.what();
  }
}

// A ring of one linear cell through its thickness and 30 degrees along has the curvatures of its circles, at open ends and at a
// mirror; seen along them its faces are straight. A flat layer has no shape.
TEST(ShapesOfBoundaries, AreCirclesOfARingAndNothingOfAPlate) {
  const double inner = 1.4, outer = 1.7, pi = std::acos(-1.0);
  for (const bool curved : {true, false}) {
    const auto mesh = triangle_grid(
        {1, 3}, {"wall"},
        [&](int i, int j) {
          const double radius = i == 0 ? inner : outer, angle = j * pi / 6;
          return curved ? Point{radius * std::cos(angle), 0, radius * std::sin(angle)} : Point{radius, 0, angle};
        },
        [](int, int) { return 0; });
    RecoveryCells cells{mesh.nodes, {}, 3, 1, {0, 2}};
    for (const auto& cell : mesh.cells) cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
    cells.mirrors.push_back({{0, 0, 1}, {0, 1}});
    const SurfaceShapes shapes(cells);
    for (int a = 0; a < static_cast<int>(mesh.nodes.size()); ++a) {
      const SurfaceShape* shape = shapes.at(a);
      ASSERT_EQ(shape != nullptr, curved);
      if (!shape) continue;
      const Point& x = mesh.nodes[static_cast<std::size_t>(a)];
      const double radius = norm(x), outward = dot(shape->normal, x) / radius;
      EXPECT_NEAR(std::abs(outward), 1, 1e-9);
      EXPECT_NEAR(shape->curvatures[0], outward / radius, 1e-9);
      for (const auto& y : mesh.nodes) {
        const auto straight = shape->straightened(y - x);
        ASSERT_TRUE(straight);
        EXPECT_NEAR(dot(*straight, shape->normal), outward * (norm(y) - radius), 1e-9);
      }
    }
  }
}

// Surfaces that were segmented leave more than a shape explains: layers straightened by it bend by more than they are thick.
TEST(ShapesOfBoundaries, AreNoneOfARoughTube) {
  for (const bool rough : {false, true}) {
    auto mesh = with_curved_edges(tube_mesh(4, 3, 8), 1);
    std::mt19937 numbers(5);
    std::uniform_real_distribution<double> off(-0.02, 0.02);
    for (Point& x : mesh.nodes) {
      const double by = rough ? off(numbers) : 0;
      x[0] *= 1 + by;
      x[1] *= 1 + by;
    }
    RecoveryCells cells{mesh.nodes, {}, 10, 2, {0, 1, 2}};
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      if (mesh.regions[static_cast<std::size_t>(mesh.cell_region[c])] == "media")
        cells.nodes.insert(cells.nodes.end(), mesh.cells[c].begin(), mesh.cells[c].end());
    const SurfaceShapes shapes(cells);
    int found = 0, nodes = 0;
    for (int a = 0; a < static_cast<int>(mesh.nodes.size()); ++a) {
      if (std::find(cells.nodes.begin(), cells.nodes.end(), a) == cells.nodes.end()) continue;
      ++nodes;
      if (shapes.at(a) != nullptr) ++found;
    }
    EXPECT_EQ(found, rough ? 0 : nodes);
  }
}

/// As nodes, and vectors at them: a body and a field on it, which need not be smooth.
struct Body {
  std::vector<Point> points;
  std::vector<int> cells;
  std::vector<Vec3<double>> field;
};

template <class Element>
Body irregular_body(int n, double inner = 1) {
  const auto mesh = irregular_mesh<Element>(n, "fluid", inner);
  Body body{mesh.nodes, {}, {}};
  for (const auto& cell : mesh.cells) body.cells.insert(body.cells.end(), cell.begin(), cell.end());
  Random random(3);
  body.field.assign(body.points.size(), {});
  for (auto& u : body.field)
    for (const int axis : Element::axis) u[axis] = random();
  return body;
}

/// At all nodes, or the first ones.
template <class Element>
std::vector<Mat3<double>> gradients_of(const Body& body, std::vector<RecoveryMirror> mirrors = {},
                                       std::size_t count = 0, bool of_revolution = Element::axisymmetric) {
  constexpr int n = Element::components;
  std::vector<int> at(count > 0 ? count : body.points.size());
  for (std::size_t a = 0; a < at.size(); ++a) at[a] = static_cast<int>(a);
  const GradientRecovery recovered({body.points,
                                    body.cells,
                                    Element::nodes,
                                    Element::order,
                                    {std::begin(Element::axis), std::end(Element::axis)},
                                    of_revolution,
                                    std::move(mirrors)},
                                   at);
  std::vector<double> field(VectorLayout<n>::size(static_cast<int>(body.points.size())));
  for (std::size_t a = 0; a < body.points.size(); ++a)
    for (int k = 0; k < n; ++k)
      field[VectorLayout<n>::vector(static_cast<int>(a), k)] = body.field[a][Element::axis[k]];
  std::vector<Mat3<double>> gradients;
  for (std::size_t i = 0; i < at.size(); ++i) gradients.push_back(recovered.gradient<VectorLayout<n>>(i, field));
  return gradients;
}

double size_of(const Mat3<double>& m) {
  return std::sqrt(contract(m, m));
}

// The same body and field, turned or mirrored, have the turned or mirrored gradients, at every node.
TYPED_TEST(RecoveredGradients, TurnWithTheBody) {
  const Body body = irregular_body<TypeParam>(TypeParam::dim == 3 ? 3 : 8);
  const auto at_rest = gradients_of<TypeParam>(body);
  double size = 0, difference = 0;
  for (const auto& h : at_rest) size = std::max(size, size_of(h));
  // A body of revolution has no other map than one reflection.
  const unsigned turns = TypeParam::axisymmetric ? 2 : (TypeParam::dim == 3 ? 8 : 20);
  for (unsigned i = 0; i < turns; ++i) {
    const Mat3<double> q = orthogonal<TypeParam>(i);
    Body turned = body;
    for (auto& x : turned.points) x = turn(q, x);
    for (auto& u : turned.field) u = q * u;
    const auto found = gradients_of<TypeParam>(turned);
    for (std::size_t a = 0; a < found.size(); ++a)
      difference = std::max(difference, size_of(found[a] - times_transposed(q * at_rest[a], q)));
  }
  std::printf("turned and mirrored: gradients differ by %.1e of the largest\n", difference / size);
  EXPECT_LT(difference, 1e-10 * size);
}

/// The body and all its images in planes through the origin, the nodes of the body first.
Body with_images(const Body& part, const std::vector<Point>& planes) {
  std::vector<Mat3<double>> turns{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  for (std::size_t g = 0; g < turns.size(); ++g)
    for (const auto& plane : planes) {
      Mat3<double> mirror{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) mirror(i, j) -= 2 * plane[i] * plane[j];
      const Mat3<double> both = mirror * turns[g];
      if (std::none_of(turns.begin(), turns.end(), [&](const auto& t) { return size_of(t - both) < 1e-9; }))
        turns.push_back(both);
    }
  Body all;
  for (const auto& q : turns) {
    std::vector<int> number;
    for (std::size_t a = 0; a < part.points.size(); ++a) {
      const Point x = turn(q, part.points[a]);
      const auto found = std::find_if(all.points.begin(), all.points.end(), [&](const Point& y) {
        return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) < 1e-9;
      });
      number.push_back(static_cast<int>(found - all.points.begin()));
      if (found != all.points.end()) continue;
      all.points.push_back(x);
      all.field.push_back(q * part.field[a]);
    }
    for (const int node : part.cells) all.cells.push_back(number[static_cast<std::size_t>(node)]);
  }
  return all;
}

/// Largest difference, relative, of the gradients on a part with its planes of symmetry to those on the whole.
/// \param planes  unit normals, through the origin
template <class Element>
double difference_to_the_whole(Body part, const std::vector<Point>& planes, bool of_revolution = false) {
  std::vector<RecoveryMirror> mirrors;
  for (const auto& normal : planes) {
    mirrors.push_back({normal, {}});
    for (std::size_t a = 0; a < part.points.size(); ++a)
      if (std::abs(dot(normal, part.points[a])) < 1e-12) mirrors.back().nodes.push_back(static_cast<int>(a));
  }
  // What lies in a plane has no component across. Twice and more where planes meet at an angle.
  for (int pass = 0; pass < 200; ++pass)
    for (const auto& mirror : mirrors)
      for (const int node : mirror.nodes) {
        double across = 0;
        for (int k = 0; k < 3; ++k) across += mirror.normal[k] * part.field[node][k];
        for (int k = 0; k < 3; ++k) part.field[node][k] -= across * mirror.normal[k];
      }
  const auto of_part = gradients_of<Element>(part, mirrors, 0, of_revolution);
  const auto of_whole = gradients_of<Element>(with_images(part, planes), {}, part.points.size(), false);
  double size = 0, difference = 0;
  for (std::size_t a = 0; a < of_part.size(); ++a) {
    Mat3<double> h = of_part[a];
    if (of_revolution) h(1, 1) = 0;  // which a plane body lacks
    size = std::max(size, size_of(of_whole[a]));
    difference = std::max(difference, size_of(h - of_whole[a]));
  }
  return difference / size;
}

template <class Element>
class MirroredPatches : public testing::Test {};
using SolidElements = testing::Types<P1Tetrahedron, P2P1Tetrahedron>;
TYPED_TEST_SUITE(MirroredPatches, SolidElements);

TYPED_TEST(MirroredPatches, OfAHalfAQuarterAnEighthAndASectorAreThoseOfTheWhole) {
  const Body cube = irregular_body<TypeParam>(2);
  const Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_LT(difference_to_the_whole<TypeParam>(cube, {x}), 1e-10);
  EXPECT_LT(difference_to_the_whole<TypeParam>(cube, {x, y}), 1e-10);
  EXPECT_LT(difference_to_the_whole<TypeParam>(cube, {x, y, z}), 1e-10);
  Body sector = cube;  // of 60 degrees, between y = 0 and a plane that is normal to no axis
  const double cosine = 0.5, sine = std::sqrt(0.75);
  for (auto& at : sector.points) at = {at[0] + cosine * at[1], sine * at[1], at[2]};
  EXPECT_LT(difference_to_the_whole<TypeParam>(sector, {{0, 1, 0}, {sine, -cosine, 0}}), 1e-10);
}

// Planes at an angle that is no part of 180 degrees mirror nothing: gradients there are those without planes.
TYPED_TEST(MirroredPatches, EndWherePlanesDoNotMirrorEachOther) {
  Body sector = irregular_body<TypeParam>(2);  // of 50 degrees
  const double angle = 50 * std::acos(-1.0) / 180, cosine = std::cos(angle), sine = std::sin(angle);
  for (auto& at : sector.points) at = {at[0] + cosine * at[1], sine * at[1], at[2]};
  ASSERT_EQ(norm(sector.points[0]), 0);  // the only node that is given as lying in both
  const std::vector<RecoveryMirror> mirrors{{{0, 1, 0}, {0}}, {{sine, -cosine, 0}, {0}}};
  const auto with = gradients_of<TypeParam>(sector, mirrors), without = gradients_of<TypeParam>(sector);
  for (std::size_t a = 0; a < with.size(); ++a) EXPECT_EQ(size_of(with[a] - without[a]), 0);
}

template <class Element>
class MirroredPlanePatches : public testing::Test {};
using FlatElements =
    testing::Types<P1AxisymmetricTriangle, P1PlaneTriangle, P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(MirroredPlanePatches, FlatElements);

// The axis of a body of revolution is a plane of symmetry of its half.
TYPED_TEST(MirroredPlanePatches, AreThoseOfTheWhole) {
  const Body body = irregular_body<TypeParam>(4, 0);
  const Point across{1, 0, 0}, along = TypeParam::axisymmetric ? Point{0, 0, 1} : Point{0, 1, 0};
  EXPECT_LT(difference_to_the_whole<TypeParam>(body, {across}, TypeParam::axisymmetric), 1e-10);
  EXPECT_LT(difference_to_the_whole<TypeParam>(body, {across, along}, TypeParam::axisymmetric), 1e-10);
}

}  // namespace

}  // namespace fsi::test
