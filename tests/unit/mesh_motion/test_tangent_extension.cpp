#include <gtest/gtest.h>

#include <algorithm>

#include "fem/elements.hpp"
#include "fem/held_components.hpp"
#include "support/mesh_motion_problems.hpp"
#include "support/nodal_arrays.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

TangentExtensionOptions iterative_tangent() {
  TangentExtensionOptions options;
  options.iterative_from = 0;
  return options;
}
TangentExtensionOptions direct_tangent() {
  TangentExtensionOptions options;
  options.iterative_from = 1 << 30;
  return options;
}

/// The tangent of a pseudo-solid in a deformed cube around a body.
struct TangentProblem {
  PrescribedMotion<Tet> body = body_in_a_box<Tet>(10);
  FunctionSpace<3> space = function_space<Tet>(body.part);
  ElementPacks<Tet> packs{body.part.nodes, body.part.cells, all_cells(body.part), *space.graph()};
  ElasticMeshMotion<Tet> motion{packs, space.graph(), PseudoSolid::of_poisson(0.3),
                                mesh_stiffness(body.part, body.interface, {MeshMotionMethod::nonlinear_elastic})};
  MeshMotionTangent<3> tangent{space.graph()};
  std::vector<char> inner;
  std::vector<double> right, field;

  TangentProblem() {
    std::vector<double> rows;
    EXPECT_FALSE(motion.assemble(random_field(body.part.nodes, 3, 0.05, 0.002, 1), rows, &tangent).inverted());
    Random random(7);
    for (const char given : body.given) {
      inner.push_back(!given);
      right.push_back(0.1 * random());
      field.push_back(random());
    }
  }
  double residual(const std::vector<double>& solution) const {
    const auto rows = multiply(tangent, solution);
    double largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (inner[i]) largest = std::max(largest, std::abs(rows[i] - right[i]));
    return largest;
  }
};

TEST(TangentExtension, FactorsInSinglePrecisionAreCorrectedAsFarAsDemanded) {
  const TangentProblem problem;
  TangentExtensionOptions few_digits = direct_tangent();
  few_digits.single_precision = true;
  TangentExtension<3> single(problem.tangent, problem.inner, few_digits),
      twice(problem.tangent, problem.inner, direct_tangent());
  single.update();
  twice.update();
  EXPECT_FALSE(single.iterates());
  EXPECT_LT(single.memory_mib(), 0.75 * twice.memory_mib());
  double before = 1e-4;
  for (const double tolerance : {1e-3, 1e-8, 1e-12}) {
    auto field = problem.field;
    single.solve(problem.right, field, tolerance);
    const double left = problem.residual(field);
    EXPECT_LT(left, 10 * tolerance);
    EXPECT_LE(left, before);
    if (tolerance == 1e-3) {
      EXPECT_GT(left, 1e-10) << "in single precision";
    }
    before = left;
  }
}

TEST(TangentExtension, IterationAndFactorisationAgree) {
  const TangentProblem problem;
  TangentExtension<3> by_factors(problem.tangent, problem.inner, direct_tangent()),
      by_iteration(problem.tangent, problem.inner, iterative_tangent());
  by_factors.update();
  by_iteration.update();
  auto first = problem.field, second = problem.field;
  by_factors.solve(problem.right, first);
  by_iteration.solve(problem.right, second);
  EXPECT_FALSE(by_factors.iterates());
  EXPECT_TRUE(by_iteration.iterates());
  EXPECT_GT(by_iteration.iterations(), 5);
  EXPECT_LT(by_iteration.iterations(), 60);
  EXPECT_LT(problem.residual(first), 1e-12);
  EXPECT_LT(problem.residual(second), 1e-10);
  EXPECT_LT(largest(difference(first, second)), 1e-10);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (!problem.inner[i]) {
      EXPECT_EQ(second[i], problem.field[i]);
    }
}

TEST(TangentExtension, AFactorisationFollowsWhenTheIterationIsCutShort) {
  TangentProblem problem;
  auto options = iterative_tangent();
  options.max_iterations = 2;
  TangentExtension<3> extension(problem.tangent, problem.inner, options);
  for (const double factor : {1.0, 2.0}) {
    for (double& value : problem.tangent.values) value *= factor;
    extension.update();
    EXPECT_TRUE(extension.iterates()) << "what failed with other values is tried again with these";
    auto field = problem.field;
    extension.solve(problem.right, field);
    EXPECT_FALSE(extension.iterates());
    EXPECT_LT(problem.residual(field), 1e-12);
  }
}

TEST(TangentExtension, ATangentThatIsNotPositiveIsFactorised) {
  TangentProblem problem;
  for (double& value : problem.tangent.values) value = -value;
  TangentExtension<3> extension(problem.tangent, problem.inner, iterative_tangent());
  extension.update();
  auto field = problem.field;
  extension.solve(problem.right, field);
  EXPECT_FALSE(extension.iterates());
  EXPECT_LT(problem.residual(field), 1e-12);
}

TEST(TangentExtension, SameBitsForAnyNumberOfThreads) {
  const int before = threads();
  std::vector<double> of_threads[2];
  for (const int count : {1, 2}) {
    set_threads(count);
    const TangentProblem problem;
    TangentExtension<3> extension(problem.tangent, problem.inner, iterative_tangent());
    extension.update();
    of_threads[count - 1] = problem.field;
    extension.solve(problem.right, of_threads[count - 1]);
  }
  set_threads(before);
  EXPECT_EQ(of_threads[0], of_threads[1]);
}

/// Where the body ends up decides the mesh, not the way: one jump or small steps, with a kept tangent or a new one.
TEST(MeshFollower, TheWayDoesNotMatter) {
  auto body = body_in_a_box<P1PlaneTriangle>(10);
  body.displacement = turned;
  const MeshMotionOptions options{MeshMotionMethod::nonlinear_elastic};
  MovedMesh<P1PlaneTriangle> at_once(body, options), in_steps(body, options);
  at_once.move(45);
  for (const double amount : {10, 20, 30, 40, 50}) {
    in_steps.move(amount);
    if (amount == 20) in_steps.follower->forget();
  }
  EXPECT_GT(in_steps.move(45), 0);
  EXPECT_LT(largest(difference(at_once.mesh, in_steps.mesh)), 1e-10);
  const int before = at_once.follower->iterations();
  const auto mesh = at_once.mesh;
  at_once.move(45);
  EXPECT_LE(at_once.follower->iterations() - before, 2) << "nothing moves";
  EXPECT_LT(largest(difference(at_once.mesh, mesh)), 1e-11);
}

TEST(MeshFollower, NoWayThroughTheOuterBoundaryIsReported) {
  auto body = body_in_a_box<P1PlaneTriangle>(10);
  body.displacement = shifted;
  MovedMesh<P1PlaneTriangle> mesh(body, {MeshMotionMethod::nonlinear_elastic});
  mesh.move(0.2);
  const auto before = mesh.mesh;
  EXPECT_THROW(mesh.move(0.45), ConvergenceError);
  EXPECT_EQ(mesh.mesh, before) << "the last good mesh stays";
}

/// A node whose frame is turned keeps the component that its frame holds, and balances in the others.
TEST(MeshFollower, NodesWithFrames) {
  auto body = body_in_a_box<P1PlaneTriangle>(10);
  const auto space = function_space<P1PlaneTriangle>(body.part);
  const ElementPacks<P1PlaneTriangle> packs(body.part.nodes, body.part.cells, all_cells(body.part), *space.graph());
  const ElasticMeshMotion<P1PlaneTriangle> motion(packs, space.graph(), PseudoSolid::of_poisson(0.2), {});
  const Direction<2> normal{0.8, 0.6};
  const auto held = hold<2>({normal});
  NodalFrames<2> frames;
  std::vector<char> inner;
  for (const char given : body.given) inner.push_back(!given);
  std::vector<int> turned_nodes;
  for (std::size_t a = 0; a < body.part.nodes.size(); ++a)
    if (std::abs(body.part.nodes[a][1] - 0.2) < 1e-9 && inner[2 * a]) {
      frames.turn(static_cast<int>(a), held.axes);
      turned_nodes.push_back(static_cast<int>(a));
      for (int k = 0; k < 2; ++k) inner[2 * a + k] = !held.held[k];
    }
  ASSERT_EQ(turned_nodes.size(), 9u);
  body.displacement = shifted;
  MeshFollower<2> follower(motion, inner, &frames);
  std::vector<double> mesh(inner.size(), 0.0), rows;
  follower.follow(body.target(0.1), mesh);
  EXPECT_FALSE(motion.assemble(mesh, rows).inverted());
  frames.to_frames<VectorLayout<2>>(rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (inner[i]) {
      EXPECT_NEAR(rows[i], 0, 1e-11);
    }
  double along = 0;
  for (const int node : turned_nodes) {
    EXPECT_NEAR(normal[0] * mesh[2 * node] + normal[1] * mesh[2 * node + 1], 0, 1e-13);
    along = std::max(along, std::abs(mesh[2 * node]));
  }
  EXPECT_GT(along, 1e-3);
}

}  // namespace

}  // namespace fsi::test
