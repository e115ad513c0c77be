// Every block of the Jacobians of fluid, wall and mesh motion against central differences, for every element, at
// deformed, moving, flowing states on meshes whose quadratic edges are curved.

#include <gtest/gtest.h>

#include <array>
#include <type_traits>

#include "fem/elements.hpp"
#include "fem/function_space.hpp"
#include "mesh_motion/motion_of_vertices.hpp"
#include "sub_problem_jacobians.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/mesh_motion_problems.hpp"

namespace fsi::test::element_jacobians_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
class EveryElement : public testing::Test {
 protected:
  static constexpr int side = Element::order == 1 ? 3 : (Element::dim == 3 ? 1 : 2);

  static auto mesh(const std::string& region) {
    auto mesh = irregular_mesh<Element>(side, region);
    curve<Element>(mesh, 0.05);
    return mesh;
  }
};

TYPED_TEST_SUITE(EveryElement, Elements, ElementNames);

TYPED_TEST(EveryElement, FluidJacobianIsTheDerivativeOfTheResidual) {
  using Element = TypeParam;
  const auto mesh = this->mesh("fluid");
  FluidProblem<Element> fluid(whole(mesh), strongly_coupled_fluid(Element::stabilised), {});
  check_fluid_blocks(fluid, FluidState<Element>(mesh.nodes), "fluid", {1});
}

template <class Law>
Material with_lame() {
  Law law;
  law.lame_lambda = 20;
  law.lame_mu = 3;
  return law;
}

TYPED_TEST(EveryElement, WallJacobianIsTheDerivativeOfTheResidualForEveryMaterial) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  // A stretch across the fibres tightens or slackens all of them, so that none is at the kink of its law. The axis of
  // cubes and squares passes beside them.
  for (const auto& [name, layer, stretch] :
       {std::tuple{"neo-Hookean", Material{NeoHookean{3}}, 1.2},
        std::tuple{"Mooney-Rivlin", Material{MooneyRivlin{3, 0.3}}, 1.2},
        std::tuple{"artery, tight", Material{Artery{3, 2.3632, 0.8393, 1, 29}}, Element::axisymmetric ? 1.3 : 0.7},
        std::tuple{"artery, dispersed", Material{Artery{3, 2.3632, 0.8393, 1, 29, 0.2}},
                   Element::axisymmetric ? 1.3 : 0.7},
        std::tuple{"Saint Venant-Kirchhoff", with_lame<SaintVenantKirchhoff>(), 1.2},
        std::tuple{"linear elastic", with_lame<LinearElastic>(), 1.2},
        std::tuple{"compressible neo-Hookean", with_lame<CompressibleNeoHookean>(), 1.2}}) {
    const auto mesh = this->mesh("media");
    WallProblem<Element> wall(whole(mesh), {1.2, 50.0, 0.5}, {{0, layer}}, {{{-2, 0.5, 0}}, {{0, 0, 1}}});
    auto solution = random_field(mesh.nodes, n + 1, 0.05, 0.01, 21);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const double others = Element::axisymmetric ? 0.7 : std::pow(stretch, -1.0 / (Element::dim - 1));
      for (int k = 0; k < n; ++k)
        solution[(n + 1) * a + k] += ((k == 0 ? stretch : others) - 1) * mesh.nodes[a][Element::axis[k]];
      solution[(n + 1) * a + n] *= 20;  // kPa
    }
    check_wall_blocks(wall, solution, random_field(mesh.nodes, n, 10.0, 1.0, 22), 16.0, 0.0, name, {1});
  }
}

/// Of quadratic elements: the weak form of linear ones on their vertices, where nodes in the middles of edges follow.
TYPED_TEST(EveryElement, MeshMotionsOperatorIsTheDerivativeOfItsWeakForm) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const auto mesh = this->mesh("fluid");
  const auto part = whole(mesh);
  const auto space = function_space<Element>(part);
  const ElementPacks<Element> packs(part.nodes, part.cells, all_cells(part), *space.graph());
  const auto motion = harmonic_mesh_motion<Element>(part, packs, space.graph());
  MeshMotionMatrix<n> matrix(motion->graph());
  motion->assemble(matrix);
  const auto state = random_field(mesh.nodes, n, 0.3, 0.1, 41);
  auto direction = random_field(mesh.nodes, n, 0.3, 0.1, 42);
  const auto compare = [&](const auto& linear_packs) {
    using Linear = std::decay_t<decltype(linear_packs)>;
    std::vector<double> product(direction.size());
    multiply_mesh_motion<n>(matrix, direction, product);
    expect_exact(central_differences(
        "mesh motion",
        [&](double t) {
          return mesh_motion_residual<typename Linear::ElementType>(linear_packs, moved(state, t, direction));
        },
        product));
  };
  if constexpr (Element::order == 1) {
    compare(packs);
  } else {
    std::vector<std::array<int, Element::scalar_nodes>> cells(part.cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int a = 0; a < Element::scalar_nodes; ++a) cells[c][a] = part.cells[c][a];
    follow_edges(part, n, direction);
    compare(ElementPacks<typename Element::OnVertices>(part.nodes, cells, all_cells(part), *motion->graph()));
  }
}

}  // namespace

}  // namespace fsi::test::element_jacobians_tests
