#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/threads.hpp"
#include "linear/krylov/gmres.hpp"
#include "monolithic/coupled_solvers/amg/sub_problem_options.hpp"
#include "monolithic/study/sub_problem_study.hpp"
#include "unit/linear/artery_matrices.hpp"
#include "unit/linear/grid_matrices.hpp"
#include "unit/linear/schur_complement.hpp"

namespace {

using namespace fsi;
using Vector = std::vector<double>;

const test::ArteryMatrices& coarse_artery() {
  static const test::ArteryMatrices matrices(artery_level("coarse"), "neo-hookean");
  return matrices;
}

EllipticAmgOptions small_elliptic(CycleKind kind, CoarseningKind coarsening, double smoothing) {
  EllipticAmgOptions options;
  options.cycle.kind = kind;
  options.cycle.pre_smoothing = options.cycle.post_smoothing = 2;
  options.cycle.coarsest_nodes = 30;
  options.coarsening = coarsening;
  options.smoothing = smoothing;
  return options;
}

double laplacian_factor(int n, const EllipticAmgOptions& options) {
  const auto a = test::grid_laplacian(n);
  EllipticAmg<3> amg(options);
  amg.build(a, NodeMarks(a.graph->rows()));
  EXPECT_GE(amg.levels(), 3);
  const auto study = study_multigrid(amg, 3);
  EXPECT_TRUE(study.converged);
  return study.convergence_factor;
}

TEST(EllipticMultigrid, FactorDoesNotDependOnTheMesh) {
  const auto smoothed = small_elliptic(CycleKind::v, CoarseningKind::aggregation, 4.0 / 3);
  const double coarse = laplacian_factor(10, smoothed), fine = laplacian_factor(24, smoothed);
  EXPECT_LT(fine, 0.35);
  EXPECT_LT(fine, coarse + 0.15);
  const auto colouring = small_elliptic(CycleKind::w, CoarseningKind::colouring, 0);
  const double coarse_w = laplacian_factor(10, colouring), fine_w = laplacian_factor(24, colouring);
  EXPECT_LT(fine_w, 0.45);
  EXPECT_LT(fine_w, coarse_w + 0.2);
  EXPECT_LT(laplacian_factor(20, small_elliptic(CycleKind::k, CoarseningKind::aggregation, 0)), 0.7);
}

/// The components of a vector are solved as if each were alone, and numbers per component give the same as one for all.
TEST(EllipticMultigrid, ComponentsDoNotCouple) {
  const auto a = test::grid_laplacian(12);
  BlockMatrix<1, 3> each(a.graph);
  for (int at = 0; at < a.graph->blocks(); ++at)
    for (int k = 0; k < 3; ++k) each.block(at)[k] = a.values[at];
  const auto options = small_elliptic(CycleKind::v, CoarseningKind::colouring, 0);
  const NodeMarks marks(a.graph->rows());
  EllipticAmg<3> one(options);
  one.build(a, marks);
  EllipticAmg<3, 3> three(options);
  three.build(each, marks);
  EllipticAmg<1> single(options);
  single.build(a, marks);
  const auto b = test::random_vector(a.graph->rows() * 3);
  Vector x(b.size()), y(b.size()), b1(a.graph->rows()), x1(a.graph->rows());
  one.cycle(0, b, x);
  three.cycle(0, b, y);
  EXPECT_EQ(x, y);
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < b1.size(); ++i) b1[i] = b[i * 3 + k];
    single.cycle(0, b1, x1);
    for (std::size_t i = 0; i < b1.size(); ++i) EXPECT_NEAR(x1[i], x[i * 3 + k], 1e-14);
  }
}

/// A V-cycle with Gauss-Seidel forwards and backwards is a symmetric operator.
TEST(EllipticMultigrid, VCycleIsSymmetric) {
  const auto a = test::grid_laplacian(10);
  EllipticAmg<1> amg(small_elliptic(CycleKind::v, CoarseningKind::colouring, 0));
  amg.build(a, NodeMarks(a.graph->rows()));
  const auto u = test::random_vector(1000, 1), v = test::random_vector(1000, 2);
  Vector mu(1000), mv(1000);
  amg.cycle(0, u, mu);
  amg.cycle(0, v, mv);
  EXPECT_NEAR(dot(mu, v), dot(u, mv), 1e-12 * norm(u) * norm(mv));
}

TEST(Multigrid, GivenTransfersAndMatricesGiveTheSameCycle) {
  const auto& artery = coarse_artery();
  auto options = wall_amg_options();
  options.cycle.coarsest_nodes = 60;
  options.stabilisation_growth = 0.5;
  SaddleAmg<4> own(options), transfers(options), matrices(options);
  own.build(artery.wall, artery.wall_marks);
  ASSERT_GE(own.levels(), 3);
  transfers.build(artery.wall, own.transfers());
  std::vector<const BlockMatrix<4, 4>*> levels;
  for (int l = 0; l < own.levels(); ++l) levels.push_back(&own.matrix(l));
  matrices.build(levels, own.transfers());
  const auto b = test::random_vector(own.matrix(0).graph->rows() * 4);
  Vector x(b.size()), y(b.size()), z(b.size());
  own.cycle(0, b, x);
  transfers.cycle(0, b, y);
  matrices.cycle(0, b, z);
  EXPECT_EQ(x, y);
  EXPECT_EQ(x, z);
  EXPECT_EQ(own.cycles(), 1);
  // From a given x: the error of x is what the cycle works on.
  const Vector start = test::random_vector(b.size(), 9);
  Vector r(b.size()), c(b.size());
  x = start;
  own.cycle(0, b, x, false);
  residual(artery.wall, b, start, r);
  own.cycle(0, r, c);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], start[i] + c[i], 1e-4 * (1 + std::abs(x[i])));
}

TEST(Multigrid, UpdateTakesNewValues) {
  const auto& artery = coarse_artery();
  auto options = fluid_amg_options();
  options.cycle.coarsest_nodes = 60;
  BlockMatrix<4, 4> a = artery.fluid;
  SaddleAmg<4> kept(options), fresh(options);
  kept.build(a, artery.fluid_marks);
  for (std::size_t k = 0; k < a.values.size(); ++k) a.values[k] *= 1 + 0.1 * std::sin(static_cast<double>(k % 16));
  kept.update();
  fresh.build(a, artery.fluid_marks);
  const auto b = test::random_vector(a.graph->rows() * 4);
  Vector x(b.size()), y(b.size());
  kept.cycle(0, b, x);
  fresh.cycle(0, b, y);
  EXPECT_EQ(x, y);
}

TEST(Multigrid, ThreadsDoNotChangeACycle) {
  const auto& artery = coarse_artery();
  Vector x[2];
  for (int pass = 0; pass < 2; ++pass) {
    set_threads(pass == 0 ? 1 : 3);
    SaddleAmg<4> amg(fluid_amg_options());
    amg.build(artery.fluid, artery.fluid_marks);
    const auto b = test::random_vector(artery.fluid.graph->rows() * 4);
    x[pass].resize(b.size());
    amg.cycle(0, b, x[pass]);
  }
  set_threads(0);
  EXPECT_EQ(x[0], x[1]);
}

struct Factors {
  const char* name;
  CycleKind kind;
  double fluid, wall, mesh;
};
class Cycles : public ::testing::TestWithParam<Factors> {};
INSTANTIATE_TEST_SUITE_P(Artery, Cycles,
                         ::testing::Values(Factors{"V", CycleKind::v, 0.2, 0.15, 0.2},
                                           Factors{"W", CycleKind::w, 0.2, 0.15, 0.2},
                                           Factors{"K", CycleKind::k, 0.2, 0.15, 0.2}),
                         [](const auto& cycle) { return cycle.param.name; });

/// Each sub-problem of the artery on its own, with the recommended options, three levels and more.
TEST_P(Cycles, ConvergeOnTheSubProblemsOfTheArtery) {
  const auto& artery = coarse_artery();
  auto fluid = fluid_amg_options(), wall = wall_amg_options();
  auto mesh = mesh_amg_options();
  for (CycleOptions* cycle : {&fluid.cycle, &wall.cycle, &mesh.cycle}) {
    cycle->kind = GetParam().kind;
    cycle->coarsest_nodes = 40;
  }
  SaddleAmg<4> fluid_amg(fluid), wall_amg(wall);
  EllipticAmg<3> mesh_amg(mesh);
  fluid_amg.build(artery.fluid, artery.fluid_marks);
  wall_amg.build(artery.wall, artery.wall_marks);
  mesh_amg.build(artery.mesh, artery.mesh_marks);
  const auto check = [](const char* what, const MultigridStudy& study, double limit) {
    EXPECT_TRUE(study.converged) << what;
    EXPECT_LT(study.convergence_factor, limit) << what;
    EXPECT_GE(study.levels, 2) << what;
    EXPECT_LT(study.operator_complexity, 2) << what;
  };
  check("fluid", study_multigrid(fluid_amg, 4), GetParam().fluid);
  check("wall", study_multigrid(wall_amg, 4), GetParam().wall);
  check("mesh", study_multigrid(mesh_amg, 3), GetParam().mesh);
}

TEST(Smoothers, VankaConvergesOnTheFluidWithBothPatches) {
  const auto& artery = coarse_artery();
  for (auto patch : {VankaPatch::diagonal, VankaPatch::full}) {
    auto options = fluid_amg_options();
    options.smoother = SaddleSmootherKind::vanka;
    options.vanka.patch = patch;
    SaddleAmg<4> amg(options);
    amg.build(artery.fluid, artery.fluid_marks);
    const auto study = study_multigrid(amg, 4);
    EXPECT_TRUE(study.converged);
    EXPECT_LT(study.convergence_factor, 0.4);
  }
}

TEST(Smoothers, VankaConvergesOnTheWallWithAMilderCorrection) {
  const auto& artery = coarse_artery();
  SaddleAmg<4> amg(wall_amg_options(SaddleSmootherKind::vanka));
  amg.build(artery.wall, artery.wall_marks);
  EXPECT_LT(study_multigrid(amg, 4).convergence_factor, 0.95);
}

/// One full patch that covers the whole graph is a direct solve: checks the patch matrix, its inverse and the running
/// residual at once.
TEST(Smoothers, FullVankaPatchOfACompleteGraphSolvesIt) {
  const auto graph = test::grid_graph(2);  // every node couples with every other
  auto a = test::random_matrix<4, 4>(graph, 3);
  for (int i = 0; i < graph->rows(); ++i)
    for (int k = 0; k < 4; ++k) a.block(graph->find(i, i))[k * 4 + k] += k < 3 ? 30 : -30;
  // The patch keeps one scalar: give the others none of their own coupling.
  for (int i = 0; i < graph->rows(); ++i)
    for (int at = graph->offsets[i]; at < graph->offsets[i + 1]; ++at) {
      const int j = graph->columns[at];
      double* block = a.block(at);
      for (int k = 0; k < 3; ++k) {
        if (i > 0) block[12 + k] = 0;
        if (j > 0) block[k * 4 + 3] = 0;
      }
      if (i != j) block[15] = 0;
    }
  Vanka<4> vanka(a, {VankaPatch::full, 1, 1});
  vanka.update(a);
  const auto exact = test::random_vector(32);
  Vector b(32), x(32, 0.0);
  multiply(a, exact, b);
  vanka.smooth(a, b, x, 1, false, true);
  for (int i = 0; i < 32; ++i) EXPECT_NEAR(x[i], exact[i], 1e-4);
}

TEST(SaddleMultigrid, PreconditionsFgmresOnAMovingState) {
  const test::ArteryMatrices artery(artery_level("coarse"), "mooney-rivlin", true);
  auto options = fluid_amg_options();
  options.cycle.coarsest_nodes = 60;
  auto wall_options = wall_amg_options();
  wall_options.cycle.coarsest_nodes = 60;
  SaddleAmg<4> fluid(options), wall(wall_options);
  fluid.build(artery.fluid, artery.fluid_marks);
  wall.build(artery.wall, artery.wall_marks);
  for (SaddleAmg<4>* amg : {&fluid, &wall}) {
    const auto b = test::random_vector(amg->matrix(0).graph->rows() * 4);
    Vector x;
    Fgmres method;
    const auto report = method.solve([&](const Vector& u, Vector& v) { amg->multiply(0, u, v); },
                                     [&](const Vector& u, Vector& v) { amg->cycle(0, u, v); }, b, x, {1e-10, 30, 30});
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_LE(report.iterations, 12);
  }
}

/// The stability that the rescaled stabilisation is for [Wabro2004]: the smallest eigenvalue of the pressure Schur
/// complement against the lumped pressure mass, level by level. It stays with the factor and is lost without.
TEST(SaddleMultigrid, RescaledStabilisationKeepsCoarseLevelsStable) {
  const auto& artery = coarse_artery();
  const Vector& mass = artery.scene->fluid->space().volumes();  // lumped
  const auto smallest_by_level = [&](double growth) {
    auto options = fluid_amg_options();
    options.stabilisation_growth = growth;
    options.cycle.coarsest_nodes = 20;
    SaddleAmg<4> amg(options);
    amg.build(artery.fluid, artery.fluid_marks);
    Vector smallest, weights = mass;
    for (int l = 0; l < amg.levels(); ++l) {
      smallest.push_back(test::smallest_eigenvalue(test::schur_complement(amg.matrix(l)), weights));
      if (l + 1 == amg.levels()) break;
      const auto& t = *amg.transfer(l);
      Vector coarse(t.coarse_nodes, 0.0);
      for (int i = 0; i < t.fine_nodes(); ++i)
        for (int at = t.graph.offsets[i]; at < t.graph.offsets[i + 1]; ++at)
          coarse[t.graph.columns[at]] += t.weights[at] * weights[i];
      weights = coarse;
    }
    return smallest;
  };
  const Vector with = smallest_by_level(2.0 / 3), without = smallest_by_level(0);
  ASSERT_GE(with.size(), 3u);
  EXPECT_GT(*std::min_element(with.begin(), with.end()), 0.5 * with.front());
  EXPECT_LT(without[1], 0.6 * without[0]);
  EXPECT_LT(without[2], 0.15 * without[0]);
}

}  // namespace
