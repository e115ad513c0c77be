#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "coupled_waves.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_solvers/coupled_linear_solver.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

struct Hierarchy {
  CoupledSystem<3> system{linearised_box().blocks()};
  std::unique_ptr<CoupledMultigrid<3>> multigrid;

  explicit Hierarchy(CoarseningKind kind) {
    system.update();
    CoupledMultigridOptions options;
    options.coarsening.kind = kind;
    options.coarsening.coarsest_nodes = 20;
    options.fluid.stabilisation_growth = options.wall.stabilisation_growth = 0;
    multigrid = std::make_unique<CoupledMultigrid<3>>(system, linearised_box().blocks(), options);
  }
};

/// x = P y
CoupledVector prolongated(const CoupledTransfer& p, const CoupledVector& y, CoupledVector x) {
  x.set_zero();
  prolongate_add<3, 3>(*p.mesh, y.mesh, x.mesh);
  prolongate_add<4, 3>(*p.fluid, y.fluid, x.fluid);
  prolongate_add<4, 3>(*p.wall, y.wall, x.wall);
  return x;
}

class CoupledHierarchy : public testing::TestWithParam<CoarseningKind> {};

// Paper, section 4.2.1: K_(l+1) = R K_l P with all coupling blocks, where the stabilisation is not rescaled.
TEST_P(CoupledHierarchy, CoarseMatricesAreGalerkinProducts) {
  Hierarchy hierarchy(GetParam());
  auto& levels = hierarchy.multigrid->levels();
  ASSERT_GE(levels.size(), 2u);
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    const auto& p = levels[l]->coarser;
    const auto &fine = levels[l]->k, &coarse = levels[l + 1]->k;
    CoupledVector y = waves(coarse);
    const auto clear = [](const NodeTransfer& t, int entries, std::vector<double>& part) {
      for (int c = 0; c < t.coarse_nodes; ++c)
        if (t.coarse_prescribed[c])
          for (int k = 0; k < 3; ++k) part[static_cast<std::size_t>(c) * entries + k] = 0;
    };
    clear(*p.mesh, 3, y.mesh);
    clear(*p.fluid, 4, y.fluid);
    clear(*p.wall, 4, y.wall);
    CoupledVector r = fine.zero_vector(), expected = coarse.zero_vector(), found = coarse.zero_vector();
    fine.residual(fine.zero_vector(), prolongated(p, y, fine.zero_vector()), r);
    restrict_to<3, 3>(*p.mesh, r.mesh, expected.mesh);
    restrict_to<4, 3>(*p.fluid, r.fluid, expected.fluid);
    restrict_to<4, 3>(*p.wall, r.wall, expected.wall);
    coarse.residual(coarse.zero_vector(), y, found);
    const double size = norm(expected);
    axpy(-1, expected, found);
    EXPECT_LT(norm(found), 1e-12 * size) << "level " << l + 1;
  }
}

/// For each coarse node the node of the finest level that it grew from.
std::vector<int> origins(const CoupledCycle<3>::Levels& levels, std::size_t level,
                         std::shared_ptr<const NodeTransfer> CoupledTransfer::*field) {
  std::vector<int> nodes = (*(levels[level - 1]->coarser.*field)).seeds;
  for (std::size_t l = level - 1; l > 0; --l)
    for (int& node : nodes) node = (*(levels[l - 1]->coarser.*field)).seeds[node];
  return nodes;
}

// The interface is coarsened alike in all three fields: coarse vectors that satisfy d_m = d_s and u = d_s / dt node by
// node satisfy the coarse matrix's interface rows.
TEST_P(CoupledHierarchy, CoarseInterfaceConditionsAreTheFineOnes) {
  Hierarchy hierarchy(GetParam());
  auto& levels = hierarchy.multigrid->levels();
  const double rate = 1 / linearised_box().setup().time->step;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const auto& k = levels[l]->k;
    std::vector<int> wall_of(levels[0]->k.fluid_nodes(), -1), coarse_wall(levels[0]->k.wall_nodes(), -1);
    for (const auto& node : linearised_box().scene().interface) wall_of[node.fluid] = node.wall;
    CoupledVector x = k.zero_vector();
    const auto wall = origins(levels, l, &CoupledTransfer::wall);
    for (std::size_t w = 0; w < wall.size(); ++w) {
      coarse_wall[wall[w]] = static_cast<int>(w);
      for (std::size_t i = 0; i < 3; ++i)
        if (!levels[l - 1]->coarser.wall->coarse_prescribed[w])
          x.wall[w * 4 + i] = std::sin(1 + static_cast<double>(w + 10 * i));
    }
    const auto follow = [&](const std::vector<int>& fluid, std::size_t entries, double factor,
                            std::vector<double>& part) {
      int pairs = 0;
      for (std::size_t f = 0; f < fluid.size(); ++f) {
        if (wall_of[fluid[f]] < 0) continue;
        const auto w = static_cast<std::size_t>(coarse_wall[wall_of[fluid[f]]]);
        ++pairs;
        for (std::size_t i = 0; i < 3; ++i) part[f * entries + i] = factor * x.wall[w * 4 + i];
      }
      EXPECT_GT(pairs, 0);
    };
    follow(origins(levels, l, &CoupledTransfer::mesh), 3, 1, x.mesh);
    follow(origins(levels, l, &CoupledTransfer::fluid), 4, rate, x.fluid);

    CoupledVector r = k.zero_vector();
    k.residual(k.zero_vector(), x, r);
    const auto expect_held = [&](const BlockMatrix<1, 1>& tie, std::size_t entries, const std::vector<double>& rows) {
      for (int row = 0; row < tie.graph->rows(); ++row)
        for (std::size_t i = 0; i < 3 && tie.graph->offsets[row] < tie.graph->offsets[row + 1]; ++i)
          EXPECT_NEAR(rows[static_cast<std::size_t>(row) * entries + i], 0, 1e-12 * rate) << "level " << l;
    };
    expect_held(*k.wall_fluid, 4, r.wall);
    expect_held(*k.mesh_wall, 3, r.mesh);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, CoupledHierarchy,
                         testing::Values(CoarseningKind::colouring, CoarseningKind::aggregation), [](const auto& of) {
                           return of.param == CoarseningKind::colouring ? "Colouring" : "Aggregation";
                         });

/// Spectral radius of the damped iteration's 2 x 2 matrix of damping_for's comment.
double radius(double omega, double k) {
  const double theta = 1 - omega, trace = 2 * theta - omega * omega * k, determinant = theta * theta;
  const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace / 4 - determinant));
  return std::max(std::abs(trace / 2 + root), std::abs(trace / 2 - root));
}

TEST(Damping, ContractsAllModesAlikeAndIsTheLargestThatDoes) {
  for (double largest : {0.5, 2.7, 9.2, 25.0, 200.0}) {
    const double omega = damping_for(largest);
    for (double share : {0.0, 0.1, 0.5, 0.9, 0.9999}) EXPECT_NEAR(radius(omega, share * largest), 1 - omega, 2e-8);
    EXPECT_GT(radius(1.05 * omega, largest), 1 - omega);
  }
  EXPECT_DOUBLE_EQ(damping_for(0), 1) << "nothing to damp";
}

// A cycle is linear with kinds v and w, so that plain GMRES may use it.
TEST(CoupledCycle, VAndWCyclesAreLinear) {
  Hierarchy hierarchy(CoarseningKind::colouring);
  hierarchy.multigrid->set_smoothing({});
  for (const auto kind : {CoupledCycleKind::v, CoupledCycleKind::w}) {
    CoupledCycleOptions options;
    options.kind = kind;
    CoupledCycle<3> cycle(hierarchy.multigrid->levels(), options);
    cycle.factorise_coarsest();
    const auto& k = hierarchy.system.matrix();
    CoupledVector a = waves(k), b = k.zero_vector(), sum = a, xa = b, xb = b, x = b;
    for (auto* part : {&b.mesh, &b.fluid, &b.wall})
      for (std::size_t i = 0; i < part->size(); ++i) (*part)[i] = std::cos(0.3 * static_cast<double>(i));
    axpy(2, b, sum);
    cycle.apply(a, xa);
    cycle.apply(b, xb);
    cycle.apply(sum, x);
    const double size = norm(x);
    axpy(-1, xa, x);
    axpy(-2, xb, x);
    EXPECT_LT(norm(x), 1e-10 * size);
  }
}

TEST(CoupledCycle, SolvesExactlyWithOneLevel) {
  CoupledSystem<3> system{linearised_box().blocks()};
  system.update();
  CoupledMultigridOptions options;
  options.coarsening.max_levels = 1;
  CoupledMultigrid<3> multigrid(system, linearised_box().blocks(), options);
  CoupledCycle<3> cycle(multigrid.levels(), {});
  cycle.factorise_coarsest();
  const auto& k = system.matrix();
  const CoupledVector b = waves(k);
  CoupledVector x = b, r = b;
  cycle.apply(b, x);
  k.residual(b, x, r);
  EXPECT_LT(norm(r), 1e-9 * norm(b));
}

}  // namespace

}  // namespace fsi::test
