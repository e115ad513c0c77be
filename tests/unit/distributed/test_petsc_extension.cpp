// The mesh motion by PETSc against the factorisation: components apart, mixed by frames, and of a nonlinear tangent.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/p1_tetrahedron.hpp"
#include "linear/distributed/petsc_extension.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "support/scenes.hpp"
#include "system/numbering.hpp"

namespace fsi::test {

namespace {

struct Problem {
  std::unique_ptr<Scene<3>> scene = build_scene<P1Tetrahedron>(coupled_case("artery"), fluid_and_wall_box(4));
  std::vector<char> inner;
  std::vector<double> right, field;

  Problem() {
    const Numbering numbering = number_mesh_motion(*scene);
    for (const auto& row : numbering.mesh_rows) inner.push_back(row.index >= 0);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      right.push_back(inner[i] ? 0.1 * std::sin(static_cast<double>(i)) : 0);
      field.push_back(inner[i] ? 0 : std::cos(static_cast<double>(3 * i)));
    }
  }
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

void expect_factorisations_answer(const NodalFrames<3>* frames) {
  Problem p;
  const PartNodes& part = p.scene->fluid->nodes();
  HarmonicExtension<3> expected(p.scene->mesh_motion, p.inner, {}, frames);
  PetscExtension<3> petsc(p.scene->mesh_motion, p.inner, frames, part);
  std::vector<double> a = p.field, b = p.field;
  expected.solve(p.right, a);
  petsc.solve(p.right, b, 1e-12);
  EXPECT_TRUE(petsc.iterates());
  EXPECT_GT(petsc.iterations(), 3);
  EXPECT_LT(petsc.iterations(), 40);
  EXPECT_LT(largest_difference(a, b), 1e-10);
  PetscExtension<3> central(p.scene->mesh_motion, p.inner, frames, part, 100000);
  std::vector<double> c = p.field;
  central.solve(p.right, c, 1);
  EXPECT_FALSE(central.iterates());
  EXPECT_LT(largest_difference(a, c), 1e-12);
}

TEST(PetscExtension, SolvesAHarmonicMotion) {
  expect_factorisations_answer(nullptr);
}

TEST(PetscExtension, SolvesComponentsThatFramesMix) {
  NodalFrames<3> frames;
  const double c = std::cos(0.4), s = std::sin(0.4);
  for (const int node : {3, 20, 41}) frames.turn(node, {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}});
  expect_factorisations_answer(&frames);
}

/// The same equations as a tangent; then one that is not positive, which the iteration cannot solve.
TEST(PetscExtension, SolvesATangentAndFactorisesOneThatIsNotPositive) {
  Problem p;
  const auto& laplacian = p.scene->mesh_motion;
  MeshMotionTangent<3> tangent(laplacian.graph);
  for (const double sign : {1.0, -1.0}) {
    for (int at = 0; at < laplacian.graph->blocks(); ++at)
      for (int k = 0; k < 3; ++k) tangent.block(at)[k * 3 + k] = (k == 1 ? sign : 1) * laplacian.block(at)[k];
    PetscExtension<3> petsc(tangent, p.inner, p.scene->fluid->nodes());
    petsc.update();
    std::vector<double> right = p.right, found = p.field, expected = p.field;
    petsc.solve(right, found, 1e-12);
    for (std::size_t i = 1; i < right.size(); i += 3) right[i] *= sign;
    HarmonicExtension<3>(laplacian, p.inner).solve(right, expected);
    EXPECT_LT(largest_difference(found, expected), 1e-10);
    EXPECT_EQ(petsc.iterates(), sign > 0);
  }
}

}  // namespace

}  // namespace fsi::test
