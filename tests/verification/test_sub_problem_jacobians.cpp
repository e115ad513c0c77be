// Jacobians of the sub-problems on tetrahedra, block by block.

#include <gtest/gtest.h>

#include "fem/p1_tetrahedron.hpp"
#include "scene/build_scene.hpp"
#include "sub_problem_jacobians.hpp"
#include "support/meshes.hpp"

namespace fsi::test::sub_problem_jacobians_tests {

namespace {

using Tet = P1Tetrahedron;

// Meshes of a few hundred elements: threads would only wait for one another.
[[maybe_unused]] const int single_thread = set_threads(1);

FluidProblem<Tet> fluid_cube(bool grad_div) {
  return {whole(irregular_cube(3)), strongly_coupled_fluid(grad_div), {}};
}

TEST(FluidJacobian, IsTheDerivativeOfTheResidualInEveryBlock) {
  auto fluid = fluid_cube(false);
  check_fluid_blocks(fluid, FluidState<Tet>(fluid.part().nodes), "fluid", {1, 2});
}

TEST(FluidJacobian, WithGradDivStabilisation) {
  auto fluid = fluid_cube(true);
  check_fluid_blocks(fluid, FluidState<Tet>(fluid.part().nodes), "fluid, grad-div", {3, 4});
}

TEST(FluidJacobian, WithTheProjectedPressure) {
  auto fluid = fluid_cube(false);
  fluid.set_wave_speed(0.1);  // T = h / c_w is about 3 ms, six steps
  check_fluid_blocks(fluid, FluidState<Tet>(fluid.part().nodes), "fluid, projected", {5, 6});
}

TEST(FluidJacobian, OnARigidDomainIsThatOfAnUnmovedOne) {
  auto fluid = fluid_cube(false);
  FluidState<Tet> state(fluid.part().nodes);
  std::fill(state.mesh.begin(), state.mesh.end(), 0.0);
  state.mesh_old = state.mesh;
  std::vector<double> unmoved, rigid;
  FluidJacobian<3> of_unmoved(fluid.graph(), FluidDerivatives::fluid_and_domain),
      of_rigid(fluid.graph(), FluidDerivatives::fluid);
  fluid.assemble(state.input(), {}, unmoved, &of_unmoved);
  fluid.assemble(euler_input(nullptr, nullptr, state.fluid, state.fluid_old, 0.5), {}, rigid, &of_rigid);
  EXPECT_LT(norm(difference(unmoved, rigid)), 1e-14 * norm(rigid));
  EXPECT_LT(norm(difference(of_unmoved.fluid.values, of_rigid.fluid.values)), 1e-14 * norm(of_rigid.fluid.values));
}

// The terms of tau must weigh alike in the states above, or an error in the derivative of one of them could hide.
TEST(FluidJacobian, StatesMakeEveryTermOfTauMatter) {
  auto fluid = fluid_cube(false);
  const auto& form = fluid.form();
  const FluidState<Tet> state(fluid.part().nodes);
  double time = 0, convection = 0, diffusion = 0;
  for (const auto& pack : fluid.packs().of_thread(0)) {
    NodalVector<Tet> d{}, u{};
    gather<VectorLayout<3>>(d, pack, state.mesh.data());
    gather<MixedLayout<3>>(u, pack, state.fluid.data());
    const auto g = Tet::at(pack.geometry, 0);
    const auto k = form.prepare(gradient_of(d, g), gradient_of(u, g), Vec3<Pack>{}, pack.geometry.metric);
    const auto c = value_of(u, g);
    const double nu = form.viscosity / form.density;
    for (int lane = 0; lane < pack_width; ++lane) {
      time += 4 / (form.step * form.step);
      convection += dot(c, k.metric * c)[lane];
      diffusion += form.inverse_estimate * nu * nu * contract(k.metric, k.metric)[lane];
    }
  }
  const double sum = time + convection + diffusion;
  fmt::print("shares of 1/tau^2: time {:.2f}, convection {:.2f}, diffusion {:.2f}\n", time / sum, convection / sum,
             diffusion / sum);
  EXPECT_GT(time / sum, 0.1);
  EXPECT_GT(convection / sum, 0.1);
  EXPECT_GT(diffusion / sum, 0.1);
}

// --- wall ----------------------------------------------------------------------------------------------------------

/// Material constants of the artery's media (docs/theory.md, section 1.3), a softer volume so that no term drowns in
/// another.
const WallConstants constants{1.2, 50.0, 0.5};

struct WallCase {
  const char* name;
  Material material;
  double radial_stretch;  ///< the fibres lie across it: below 1 they are stretched, above 1 slack
};

void PrintTo(const WallCase& with, std::ostream* out) {
  *out << with.name;
}

class WallJacobian : public testing::TestWithParam<WallCase> {};

TEST_P(WallJacobian, IsTheDerivativeOfTheResidualInEveryBlock) {
  const auto& with = GetParam();
  const auto mesh = irregular_cube(2, 0.15, "media");
  // The axis passes beside the cube, so that fibre directions turn from element to element.
  const CylinderAxis axis{{{-2, 0.5, 0}}, {{0, 0, 1}}};
  auto part = whole(mesh);
  const auto pressurised = facets_where(mesh, "media", [](const Point& x) { return x[0] < 1e-12; });
  WallProblem<Tet> wall(part, constants, {{0, with.material}}, axis, pressurised);

  auto solution = random_field(part.nodes, 4, 0.08, 0.01, 21);
  for (std::size_t a = 0; a < part.nodes.size(); ++a) {
    const double stretch[3] = {with.radial_stretch, 1 / std::sqrt(with.radial_stretch),
                               1 / std::sqrt(with.radial_stretch)};
    for (int i = 0; i < 3; ++i) solution[4 * a + i] += (stretch[i] - 1) * part.nodes[a][i];
    solution[4 * a + 3] *= 20;  // kPa
  }
  const auto history = random_field(part.nodes, 3, 10.0, 1.0, 22);

  if (const auto* artery = std::get_if<Artery>(&with.material)) {
    int stretched = 0, slack = 0;
    for (int t = 0; t < wall.layers()[0].packs.thread_count(); ++t)
      for (std::size_t p = 0; p < wall.layers()[0].packs.of_thread(t).size(); ++p) {
        const auto& pack = wall.layers()[0].packs.of_thread(t)[p];
        NodalVector<Tet> d{};
        gather<MixedLayout<3>>(d, pack, solution.data());
        const auto strain = strain_of(gradient_of(d, Tet::at(pack.geometry, 0)));
        for (const auto& point : wall.layers()[0].fibres[t][p])
          for (const auto& a : point.direction)
            for (int lane = 0; lane < pack_width; ++lane) ++(extension(strain, a)[lane] > 0 ? stretched : slack);
      }
    EXPECT_GT(artery->k1, 0);
    EXPECT_EQ(with.radial_stretch < 1 ? slack : stretched, 0);
  }
  check_wall_blocks(wall, solution, history, /*acceleration_factor=*/16.0, /*pressure=*/2.0, with.name, {1, 2});
}

INSTANTIATE_TEST_SUITE_P(Materials, WallJacobian,
                         testing::Values(WallCase{"neo-Hookean", NeoHookean{3}, 1.2},
                                         WallCase{"Mooney-Rivlin", MooneyRivlin{3, 0.3}, 1.2},
                                         WallCase{"artery, fibres stretched", Artery{3, 2.3632, 0.8393, 1, 29}, 0.7},
                                         WallCase{"artery, fibres slack", Artery{3, 2.3632, 0.8393, 1, 29}, 1.4}));

// The follower load alone is quadratic in the displacement: differences of any step are exact.
TEST(FollowerPressure, JacobianIsTheDerivativeOfTheLoad) {
  const auto mesh = irregular_cube(2);
  const auto part = whole(mesh);
  const auto facets = facets_where(mesh, "fluid", [](const Point&) { return true; });
  const auto solution = random_field(mesh.nodes, 4, 0.2, 0.05, 31);
  const auto load = [&](const std::vector<double>& at, WallMatrix<3>* jacobian = nullptr) {
    std::vector<double> r(at.size(), 0.0);
    add_follower_pressure<Tet>(mesh.nodes, facets, 1.7, at, r, jacobian);
    return r;
  };
  std::vector<int> cell_nodes;
  for (const auto& cell : part.cells) cell_nodes.insert(cell_nodes.end(), cell.begin(), cell.end());
  WallMatrix<3> jacobian(std::make_shared<NodeGraph>(graph_of_cells(part.node_count(), cell_nodes, 4)));
  load(solution, &jacobian);
  for (unsigned seed : {1, 2, 3}) {
    const auto direction = random_field(mesh.nodes, 4, 0.3, 0.1, seed);
    expect_exact(central_differences(
        "follower pressure", [&](double t) { return load(moved(solution, t, direction)); },
        multiply(jacobian, direction)));
  }
  // Over a closed surface the pressure has no resultant: an independent sign and orientation check is in the patch
  // tests.
  const auto r = load(solution);
  for (int i = 0; i < 3; ++i) {
    double resultant = 0;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) resultant += r[4 * a + i];
    EXPECT_NEAR(resultant, 0, 1e-13);
  }
}

// --- mesh motion -----------------------------------------------------------------------------------------------------

TEST(MeshMotionJacobian, OperatorIsTheDerivativeOfItsWeakForm) {
  const auto mesh = irregular_cube(3);
  FluidProblem<Tet> fluid(whole(mesh), strongly_coupled_fluid(false), {});
  MeshMotionMatrix<3> matrix(fluid.graph());
  assemble_mesh_motion(fluid.packs(), matrix);
  const auto state = random_field(mesh.nodes, 3, 0.3, 0.1, 41);
  for (unsigned seed : {1, 2}) {
    const auto direction = random_field(mesh.nodes, 3, 0.3, 0.1, seed);
    std::vector<double> product(direction.size());
    multiply_mesh_motion<3>(matrix, direction, product);
    expect_exact(central_differences(
        "mesh motion", [&](double t) { return mesh_motion_residual<Tet>(fluid.packs(), moved(state, t, direction)); },
        product));
  }
}

}  // namespace

}  // namespace fsi::test::sub_problem_jacobians_tests
