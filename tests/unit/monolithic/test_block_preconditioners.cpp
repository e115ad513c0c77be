#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_solvers/block/block_gauss_seidel.hpp"
#include "monolithic/coupled_solvers/block/block_preconditioners.hpp"
#include "monolithic/coupled_solvers/multigrid/coupled_multigrid.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

/// The box with factorised sub-problems: a hierarchy of one level.
struct Factorised {
  CoupledSystem<3> system{linearised_box().blocks()};
  std::unique_ptr<CoupledMultigrid<3>> multigrid;
  CoupledVector b;

  Factorised() {
    system.update();
    CoupledMultigridOptions options;
    options.coarsening.max_levels = 1;
    multigrid = std::make_unique<CoupledMultigrid<3>>(system, linearised_box().blocks(), options);
    b = system.matrix().zero_vector();
    int i = 0;
    for (auto* part : {&b.mesh, &b.fluid, &b.wall})
      for (double& value : *part) value = std::sin(1.0 + 0.3 * i++);
  }
  SubSolvers inverse() { return multigrid->finest_sub_solvers(); }
  CoupledVector apply(const std::string& name) {
    CoupledVector x = b;
    make_block_preconditioner(name, system.matrix(), inverse())->apply(b, x);
    return x;
  }
};

/// Products with the blocks that K has and a preconditioner lacks: with P = K + R, b - K x = R x.
class BlockPreconditioner : public testing::Test {
 protected:
  Factorised problem;
  const CoupledMatrix<3>& k = problem.system.matrix();

  /// b - K x = R x for x = P^-1 b; `subtract_remainder(x, r)` does r -= R x.
  template <class Remainder>
  void expect_inverse(const std::string& name, Remainder subtract_remainder) {
    const CoupledVector x = problem.apply(name);
    CoupledVector r = x;
    k.residual(problem.b, x, r);
    subtract_remainder(x, r);
    EXPECT_LT(norm(r), 1e-9 * norm(problem.b)) << name;
  }
  std::vector<double> solve(SubSolver& inverse, const std::vector<double>& b) {
    std::vector<double> x;
    inverse.solve(b, x);
    return x;
  }
  /// Minus A_ij x for the blocks of K.
  template <class Subtract>
  std::vector<double> minus(std::size_t size, Subtract subtract) {
    std::vector<double> y(size, 0.0);
    subtract(y);
    return y;
  }
};

TEST_F(BlockPreconditioner, DiagonalLacksAllCouplings) {
  expect_inverse("diagonal", [&](const CoupledVector& x, CoupledVector& r) {
    CoupledVector t = k.zero_vector();  // R = -(couplings)
    k.subtract_mesh_wall(x.wall, t.mesh);
    k.subtract_fluid_mesh(x.mesh, t.fluid);
    k.subtract_fluid_wall(x.wall, t.fluid);
    k.subtract_wall_fluid(x.fluid, t.wall);
    axpy(-1, t, r);
  });
}

TEST_F(BlockPreconditioner, LowerLacksTheUpperCouplings) {
  expect_inverse("lower", [&](const CoupledVector& x, CoupledVector& r) {
    CoupledVector t = k.zero_vector();
    k.subtract_mesh_wall(x.wall, t.mesh);
    k.subtract_fluid_wall(x.wall, t.fluid);
    axpy(-1, t, r);
  });
}

TEST_F(BlockPreconditioner, UpperLacksTheLowerCouplings) {
  expect_inverse("upper", [&](const CoupledVector& x, CoupledVector& r) {
    CoupledVector t = k.zero_vector();
    k.subtract_fluid_mesh(x.mesh, t.fluid);
    k.subtract_wall_fluid(x.fluid, t.wall);
    axpy(-1, t, r);
  });
}

// Paper, section 4.1.4: R has Afm Am^-1 Ams and Asf Af^-1 Afs in the wall's column.
TEST_F(BlockPreconditioner, SsorHasThePapersRemainder) {
  expect_inverse("ssor", [&](const CoupledVector& x, CoupledVector& r) {
    const auto inverse = problem.inverse();
    const auto z = solve(inverse.mesh, minus(x.mesh.size(), [&](auto& y) { k.subtract_mesh_wall(x.wall, y); }));
    const auto w = solve(inverse.fluid, minus(x.fluid.size(), [&](auto& y) { k.subtract_fluid_wall(x.wall, y); }));
    CoupledVector t = k.zero_vector();  // z = -Am^-1 Ams x_s, w = -Af^-1 Afs x_s: t = R x
    k.subtract_fluid_mesh(z, t.fluid);
    k.subtract_wall_fluid(w, t.wall);
    axpy(-1, t, r);
  });
}

// [Langer2018], section 4.1.5: R has Asf Af^-1 (Afs - Afm Am^-1 Ams) in the corner. The inverse as printed would fail
// here (docs/theory.md, section 12, item 7).
TEST_F(BlockPreconditioner, IluHasThePapersRemainder) {
  expect_inverse("ilu", [&](const CoupledVector& x, CoupledVector& r) {
    const auto inverse = problem.inverse();
    const auto z = solve(inverse.mesh, minus(x.mesh.size(), [&](auto& y) { k.subtract_mesh_wall(x.wall, y); }));
    const auto w = solve(inverse.fluid, minus(x.fluid.size(), [&](auto& y) {
                           k.subtract_fluid_wall(x.wall, y);
                           k.subtract_fluid_mesh(z, y);
                         }));
    CoupledVector t = k.zero_vector();  // w = -Af^-1 (Afs - Afm Am^-1 Ams) x_s: t = R x
    k.subtract_wall_fluid(w, t.wall);
    axpy(-1, t, r);
  });
}

// Algorithm 2 without damping, from zero, is the block lower preconditioner.
TEST_F(BlockPreconditioner, UndampedSmootherFromZeroIsLower) {
  CoupledVector x = k.zero_vector();
  BlockGaussSeidel<3> smoother(k, problem.inverse());
  smoother.sweep(problem.b, x, {1, 1, 1});
  axpy(-1, problem.apply("lower"), x);
  EXPECT_LT(norm(x), 1e-12 * norm(problem.b));
}

TEST_F(BlockPreconditioner, CountsItsSubProblemSolves) {
  const auto count = [&](const std::string& name) {
    const long long before[] = {problem.multigrid->mesh_cycles(), problem.multigrid->fluid_cycles(),
                                problem.multigrid->wall_cycles()};
    problem.apply(name);
    return std::vector<long long>{problem.multigrid->mesh_cycles() - before[0],
                                  problem.multigrid->fluid_cycles() - before[1],
                                  problem.multigrid->wall_cycles() - before[2]};
  };
  const std::vector<long long> once{1, 1, 1}, twice{2, 2, 1};
  EXPECT_EQ(count("diagonal"), once);
  EXPECT_EQ(count("lower"), once);
  EXPECT_EQ(count("upper"), once);
  EXPECT_EQ(count("ssor"), twice);
  EXPECT_EQ(count("ilu"), twice);
}

}  // namespace

}  // namespace fsi::test
