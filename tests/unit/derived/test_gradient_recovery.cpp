// Recovered gradients: exact for polynomials of a degree above the element's, at boundaries too, and of the order that
// follows for others.

#include <gtest/gtest.h>

#include <cmath>

#include "derived/gradient_recovery.hpp"
#include "fem/elements.hpp"
#include "fem/nodal_layout.hpp"
#include "support/element_meshes.hpp"

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
  constexpr int n = TypeParam::dim == 3 ? 3 : 6, finer = TypeParam::dim == 3 ? 1 : 2;  // times halved
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

}  // namespace

}  // namespace fsi::test
