#include <gtest/gtest.h>

#include <cmath>

#include "coupled_waves.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "linear/direct/direct_solver.hpp"
#include "monolithic/coupled_solvers/block/coupled_system.hpp"
#include "support/linear_systems.hpp"
#include "support/nodal_arrays.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

/// The paper's K and b of the box.
struct PaperForm {
  LinearisedScene<3>& box = linearised_box();
  CoupledSystem<3> system{box.blocks()};
  CoupledVector b = system.matrix().zero_vector();

  PaperForm() {
    system.update();
    system.expand(box.b(), b);
  }
};

// The paper's system is the condensed one with its two identity rows put back (docs/theory.md, section 9).
TEST(CoupledMatrix, HasTheSolutionOfTheCondensedSystem) {
  PaperForm paper;
  const SparseMatrix k = sparse_matrix(paper.system.matrix());
  DirectSolver direct;
  direct.factorise(k);
  std::vector<double> b, flat, condensed;
  flatten(paper.b, b);
  direct.solve(k, b, flat);
  CoupledVector x = paper.system.matrix().zero_vector();
  unflatten(flat, x);
  paper.system.compress(x, condensed);
  EXPECT_LT(norm(difference(condensed, paper.box.solution())), 1e-11 * norm(paper.box.solution()));

  for (const auto& pair : paper.system.interface())
    for (int i = 0; i < 3; ++i) {
      const double d = x.wall[4 * pair.wall + i];
      EXPECT_NEAR(x.mesh[3 * pair.fluid + i], d, 1e-14);
      EXPECT_NEAR(x.fluid[4 * pair.fluid + i], d / paper.box.setup().time->step, 1e-13);
    }
}

TEST(CoupledMatrix, BlockProductsAreTheSparseMatrix) {
  PaperForm paper;
  const auto& k = paper.system.matrix();
  const CoupledVector x = waves(k), zero = k.zero_vector();
  CoupledVector r = zero;
  k.residual(zero, x, r);
  std::vector<double> flat, blocks;
  flatten(x, flat);
  flatten(r, blocks);
  const auto sparse = product(sparse_matrix(k), flat);
  for (std::size_t i = 0; i < sparse.size(); ++i) ASSERT_NEAR(-blocks[i], sparse[i], 1e-12 * norm(sparse)) << i;
}

TEST(CoupledMatrix, HasTheBlockPatternOfThePaper) {
  PaperForm paper;
  const auto& k = paper.system.matrix();
  const std::int64_t fluid0 = 3 * k.fluid_nodes(), wall0 = fluid0 + 4 * k.fluid_nodes();
  const SparseMatrix sparse = sparse_matrix(k);
  const auto part = [&](std::int64_t i) { return i < fluid0 ? 0 : i < wall0 ? 1 : 2; };
  long long entries[3][3] = {};
  for (std::int64_t c = 0; c < sparse.size(); ++c)
    for (std::int64_t at = sparse.offsets[c]; at < sparse.offsets[c + 1]; ++at)
      ++entries[part(sparse.rows[at])][part(c)];
  const auto pairs = static_cast<long long>(paper.system.interface().size());
  EXPECT_EQ(entries[0][1], 0) << "no flow in the mesh motion";
  EXPECT_EQ(entries[2][0], 0) << "no mesh motion in the wall";
  EXPECT_EQ(entries[0][2], 3 * pairs) << "d_m - d_s = 0";
  EXPECT_EQ(entries[2][1], 3 * pairs) << "-u + d_s / dt = 0";
  EXPECT_GT(entries[1][0], 0) << "shape derivatives";
  EXPECT_GT(entries[1][2], 0) << "traction of the wall";
}

TEST(CoupledMatrix, PrescribedEntriesHaveIdentityRowsAndZeroColumns) {
  PaperForm paper;
  const auto& k = paper.system.matrix();
  auto& scene = paper.box.scene();
  CoupledVector only_prescribed = k.zero_vector(), r = k.zero_vector();
  for (int a = 0; a < k.fluid_nodes(); ++a)
    for (int i = 0; i < 3; ++i) {
      if (scene.mesh_conditions.fixes(a)) only_prescribed.mesh[3 * a + i] = 1;
      if (scene.velocity_conditions.fixes(a)) only_prescribed.fluid[4 * a + i] = 1;
    }
  for (int a = 0; a < k.wall_nodes(); ++a)
    for (int i = 0; i < 3; ++i)
      if (scene.wall_conditions.fixes(a)) only_prescribed.wall[4 * a + i] = 1;
  k.residual(k.zero_vector(), only_prescribed, r);
  axpy(1, only_prescribed, r);
  EXPECT_EQ(norm(r), 0) << "K x = x";
}

}  // namespace

}  // namespace fsi::test
