// The mesh motion of quadratic elements: vertices as linear elements have them, nodes in the middles of edges by the mean
// of their ends.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/elements.hpp"
#include "support/mesh_motion_problems.hpp"

namespace fsi::test {

namespace {

template <class Element>
class MotionOfVerticesOf : public testing::Test {};
using QuadraticElements = testing::Types<P2P1Tetrahedron, P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(MotionOfVerticesOf, QuadraticElements);

/// Of a body that is turned, or a tube that bulges.
template <class Element>
PrescribedMotion<Element> problem_of() {
  if constexpr (Element::axisymmetric) {
    return bulging_tube<Element>(5);
  } else {
    auto body = body_in_a_box<Element>(5);
    body.displacement = turned;
    return body;
  }
}
template <class Element>
constexpr double amount = Element::axisymmetric ? 0.2 : 20;

TYPED_TEST(MotionOfVerticesOf, VerticesMoveAsThoseOfLinearElements) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  for (const auto method : {MeshMotionMethod::harmonic, MeshMotionMethod::stiffened}) {
    // Distances from the interface are those from its nodes, which differ.
    const MeshMotionOptions options{method, 1, 0};
    const auto problem = problem_of<Element>();
    const auto on_vertices = problem_of<typename Element::OnVertices>();
    MovedMesh<Element> quadratic(problem, options);
    MovedMesh<typename Element::OnVertices> linear(on_vertices, options);
    EXPECT_GT(quadratic.move(amount<Element>), 0);
    EXPECT_GT(linear.move(amount<Element>), 0);
    double largest = 0;
    for (std::size_t i = 0; i < linear.mesh.size(); ++i) {
      EXPECT_NEAR(quadratic.mesh[i], linear.mesh[i], 1e-13);
      if (!problem.given[i]) largest = std::max(largest, std::abs(linear.mesh[i]));
    }
    EXPECT_GT(largest, 0.01);
    auto following = quadratic.mesh;
    follow_edges(problem.part, n, following);
    double curved = 0;
    for (std::size_t i = 0; i < following.size(); ++i)
      if (problem.given[i])
        curved = std::max(curved, std::abs(following[i] - quadratic.mesh[i]));
      else
        EXPECT_NEAR(quadratic.mesh[i], following[i], 1e-14);
    if (Element::axisymmetric) {  // a body that turns stays as straight as it was
      EXPECT_GT(curved, 1e-3) << "the boundary keeps its curve";
    }
  }
}

TYPED_TEST(MotionOfVerticesOf, HomogeneousStretchIsFollowed) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  auto problem = problem_of<Element>();
  const auto stretched = [](const Point& x, int k) { return (k == 0 ? 0.3 : -0.2) * x[Element::axis[k]]; };
  MovedMesh<Element> mesh(problem, {});
  problem.interface.clear();
  for (std::size_t a = 0; a < problem.part.nodes.size(); ++a)
    problem.interface.push_back(static_cast<int>(a));  // target() tells of all nodes, given ones are taken
  problem.displacement = [&](const Point& x, double) {
    Point d{};
    for (int k = 0; k < n; ++k) d[Element::axis[k]] = stretched(x, k);
    return d;
  };
  EXPECT_GT(mesh.move(1), 0);
  for (std::size_t a = 0; a < problem.part.nodes.size(); ++a)
    for (int k = 0; k < n; ++k) EXPECT_NEAR(mesh.mesh[n * a + k], stretched(problem.part.nodes[a], k), 1e-13);
}

TYPED_TEST(MotionOfVerticesOf, TheOperatorIsSymmetricAndDiagonalAmongEdges) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const auto problem = problem_of<Element>();
  const auto space = function_space<Element>(problem.part);
  const ElementPacks<Element> packs(problem.part.nodes, problem.part.cells, all_cells(problem.part), *space.graph());
  const auto motion = harmonic_mesh_motion<Element>(problem.part, packs, space.graph());
  MeshMotionMatrix<n> matrix(motion->graph());
  motion->assemble(matrix);
  const NodeGraph& graph = *matrix.graph;
  EXPECT_LT(1.9 * graph.blocks(), space.graph()->blocks());
  for (int row = 0; row < graph.rows(); ++row) {
    if (!space.carries_scalar(row)) {
      EXPECT_EQ(graph.offsets[row + 1] - graph.offsets[row], 3);
    }
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at) {
      const double* there = matrix.block(graph.find(graph.columns[at], row));
      for (int k = 0; k < n; ++k) EXPECT_NEAR(matrix.block(at)[k], there[k], 1e-14);
    }
  }
}

}  // namespace

}  // namespace fsi::test
