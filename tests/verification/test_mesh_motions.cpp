// Mesh motions: exact derivatives and homogeneous deformations of the pseudo-solid, and how far each method follows a
// boundary before an element folds (the table of docs/theory.md, section 6).

#include <gtest/gtest.h>

#include "fem/elements.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/mesh_motion_problems.hpp"
#include "support/random.hpp"

namespace fsi::test::mesh_motions_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
class MeshMotions : public testing::Test {};
TYPED_TEST_SUITE(MeshMotions, Elements, ElementNames);

TYPED_TEST(MeshMotions, TangentOfThePseudoSolidIsTheDerivativeOfItsRows) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  auto mesh = irregular_mesh<Element>(Element::order == 1 ? 3 : (Element::dim == 3 ? 1 : 2));
  curve<Element>(mesh, 0.05);
  const auto part = whole(mesh);
  const auto space = function_space<Element>(part);
  const ElementPacks<Element> packs(part.nodes, part.cells, all_cells(part), *space.graph());
  std::vector<double> stiffness;
  for (std::size_t c = 0; c < part.cells.size(); ++c) stiffness.push_back(1 + 0.1 * static_cast<double>(c));
  const ElasticMeshMotion<Element> motion(packs, space.graph(), PseudoSolid::of_poisson(0.3), stiffness);
  const auto state = random_field(mesh.nodes, n, 0.15, 0.02, 1), direction = random_field(mesh.nodes, n, 0.3, 0.1, 2);
  std::vector<double> rows;
  MeshMotionTangent<n> tangent(space.graph());
  ASSERT_FALSE(motion.assemble(state, rows, &tangent).inverted());
  expect_second_order(central_differences(
      "pseudo-solid",
      [&](double t) {
        EXPECT_FALSE(motion.assemble(moved(state, t, direction), rows).inverted());
        return rows;
      },
      multiply(tangent, direction), 0.05));
}

/// A homogeneous deformation has a homogeneous stress, which is in balance: exact on any mesh.
TYPED_TEST(MeshMotions, HomogeneousDeformationsAreFollowedExactly) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  auto mesh = irregular_mesh<Element>(Element::order == 1 ? 4 : 2);
  PrescribedMotion<Element> problem;
  problem.part = whole(mesh);
  const auto marks = [&] {
    if constexpr (Element::order == 1) {
      return boundary_marks(mesh);
    } else {
      std::vector<char> on(mesh.nodes.size(), 0);  // edges are straight
      for (std::size_t a = 0; a < on.size(); ++a)
        for (int k = 0; k < n; ++k) {
          const double x = mesh.nodes[a][Element::axis[k]] - (Element::axisymmetric && k == 0 ? 1 : 0);
          if (x < 1e-9 || x > 1 - 1e-9) on[a] = 1;
        }
      return on;
    }
  }();
  problem.given.assign(marks.size() * n, 0);
  for (std::size_t a = 0; a < marks.size(); ++a)
    if (marks[a]) {
      problem.interface.push_back(static_cast<int>(a));
      for (int k = 0; k < n; ++k) problem.given[n * a + k] = 1;
    }
  problem.displacement = [](const Point& x, double amount) -> Point {
    if (Element::axisymmetric) return {amount * x[0], 0, -0.5 * amount * x[2]};
    const double shear = 0.8 * amount * x[Element::axis[n - 1]];  // along x
    return {amount * x[0] + shear, -0.5 * amount * x[1], 0.1 * amount * x[2]};
  };
  MovedMesh<Element> moved_mesh(problem, {MeshMotionMethod::nonlinear_elastic, 0, 0, 0.3});
  EXPECT_GT(moved_mesh.move(0.6), 0);
  for (std::size_t a = 0; a < marks.size(); ++a) {
    const Point exact = problem.displacement(mesh.nodes[a], 0.6);
    for (int k = 0; k < n; ++k) EXPECT_NEAR(moved_mesh.mesh[n * a + k], exact[Element::axis[k]], 1e-12);
  }
}

std::vector<double> steps(double step, int count) {
  std::vector<double> amounts;
  for (int i = 1; i <= count; ++i) amounts.push_back(i * step);
  return amounts;
}

/// Amounts of motion at which the harmonic mesh has folded; the largest asked for.
struct Motion {
  const char* name;
  double step;
  int count;
};

/// Prints what each method stands, and demands: stiffening goes further than without, and the pseudo-solid to the end.
template <class Element>
void compare(const Motion& motion, const PrescribedMotion<Element>& problem) {
  const auto amounts = steps(motion.step, motion.count);
  const auto harmonic = [&] { return MovedMesh<Element>(problem, {}); };
  const double plain = harmonic().last_unfolded(amounts);
  const double stiffened = MovedMesh<Element>(problem, {MeshMotionMethod::stiffened}).last_unfolded(amounts);
  MovedMesh<Element> elastic(problem, {MeshMotionMethod::nonlinear_elastic});
  const double pseudo_solid = elastic.last_unfolded(amounts);
  std::vector<double> rows;
  fmt::print("{:<28} harmonic {:5.2f}  stiffened {:5.2f}  nonlinear-elastic {:5.2f}", motion.name, plain, stiffened,
             pseudo_solid);
  fmt::print("  tangents {:3} solves {:3}", elastic.follower->tangents(), elastic.follower->iterations());
  const double further = plain + motion.step;  // here the plain one is folded and the others are not
  const double folded = harmonic().move(further);
  const double held = MovedMesh<Element>(problem, {MeshMotionMethod::stiffened}).move(further);
  const double elastic_held = MovedMesh<Element>(problem, {MeshMotionMethod::nonlinear_elastic}).move(further);
  fmt::print("   min J at {:5.2f}: {:7.3f} {:7.3f} {:7.3f}\n", further, folded, held, elastic_held);
  EXPECT_LE(folded, 0);
  EXPECT_GT(held, 0);
  EXPECT_GT(elastic_held, 0);
  EXPECT_GT(stiffened, plain);
  EXPECT_NEAR(pseudo_solid, amounts.back(), 1e-9);
  EXPECT_LT(plain, amounts.back());
}

TYPED_TEST(MeshMotions, OthersHoldWhereTheHarmonicOneFolds) {
  using Element = TypeParam;
  if constexpr (Element::axisymmetric) {
    auto tube = bulging_tube<Element>(Element::order == 1 ? 10 : 6);
    const auto outward = tube.displacement;
    tube.displacement = [&](const Point& x, double amount) { return outward(x, -amount); };
    compare<Element>({"tube pressed in, mm", 0.04, 23}, tube);
  } else {
    auto body = body_in_a_box<Element>(Element::dim == 3 ? (Element::order == 1 ? 10 : 5) : 20);
    body.displacement = turned;
    compare<Element>({"body turned, degrees", 5, Element::dim == 3 ? 12 : 24}, body);
    body.displacement = shifted;
    compare<Element>({"body shifted, mm", 0.02, 17}, body);
  }
}

}  // namespace

}  // namespace fsi::test::mesh_motions_tests
