// Derivatives by way of the points against those for one node after the other: two ways to the same numbers.
#include <gtest/gtest.h>

#include <tuple>
#include <utility>
#include <vector>

#include "fem/function_space.hpp"
#include "fluid/fluid_assembly.hpp"
#include "host/threads.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/nodal_arrays.hpp"
#include "support/problems.hpp"
#include "wall/wall_assembly.hpp"

namespace fsi::test {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
class PointTangents : public testing::Test {
 protected:
  static auto curved_mesh() {
    auto mesh = irregular_mesh<Element>(Element::dim == 3 ? 1 : 2);
    curve<Element>(mesh, 0.05);
    return mesh;
  }

  const Submesh<Element::dim, Element::order> part = whole(curved_mesh());
  const FunctionSpace<Element::components> space = function_space<Element>(part);
  const ElementPacks<Element> packs{part.nodes, part.cells, all_cells(part), *space.graph()};
  const std::vector<double> mixed = random_field(part.nodes, Element::components + 1, 0.2, 0.05, 1),
                            mixed_before = random_field(part.nodes, Element::components + 1, 0.2, 0.05, 2),
                            moved = random_field(part.nodes, Element::components, 0.1, 0.02, 3),
                            moved_before = random_field(part.nodes, Element::components, 0.1, 0.02, 4);

  static void expect_equal(const std::vector<double>& a, const std::vector<double>& b) {
    EXPECT_GT(largest(a), 0);
    EXPECT_LT(largest(difference(a, b)), 1e-13 * largest(a));
  }
};

using Quadratic = testing::Types<P2P1Tetrahedron, P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(PointTangents, Quadratic, ElementNames);

TYPED_TEST(PointTangents, OfTheFluidAreThoseByNodes) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const FluidInput in{
      this->moved.data(), this->moved_before.data(), this->mixed.data(), this->mixed_before.data(), 8, 5, 0.1};
  const AleFluid form{1.1, 0.3};
  const auto assembled = [&](auto loop) {
    FluidJacobian<n> jacobian(this->space.graph(), FluidDerivatives::fluid_and_domain);
    std::vector<double> residual(this->space.mixed_size(), 0.0);
    loop(this->packs.of_thread(0), residual.data(), jacobian);
    return std::tuple{residual, jacobian.fluid.values, jacobian.shape_derivatives.values};
  };
  const auto by_points = assembled([&](const auto& of_thread, double* residual, auto& jacobian) {
    detail::fluid_packs_by_points<Element, true, true>(form, of_thread, in, residual, &jacobian);
  });
  const auto by_nodes = assembled([&](const auto& of_thread, double* residual, auto& jacobian) {
    detail::fluid_packs<Element, FluidDerivatives::fluid_and_domain, true>(form, of_thread, in, residual, &jacobian);
  });
  this->expect_equal(std::get<0>(by_nodes), std::get<0>(by_points));
  this->expect_equal(std::get<1>(by_nodes), std::get<1>(by_points));
  this->expect_equal(std::get<2>(by_nodes), std::get<2>(by_points));
}

TYPED_TEST(PointTangents, OfTheWallAreThoseByNodes) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const WallInput in{this->mixed.data(), this->moved_before.data(), 16.0};
  const Hyperelastic<MooneyRivlin> form{1.2, 50.0, 0.5, MooneyRivlin{3, 0.3}};
  const auto assembled = [&](auto loop) {
    WallMatrix<n> jacobian(this->space.graph());
    std::vector<double> residual(this->space.mixed_size(), 0.0);
    loop(this->packs.of_thread(0), residual.data(), jacobian.values.data());
    return std::pair{residual, jacobian.values};
  };
  const auto by_points = assembled([&](const auto& of_thread, double* residual, double* blocks) {
    detail::layer_packs_by_points<Element>(form, of_thread, nullptr, in, residual, blocks);
  });
  const auto by_nodes = assembled([&](const auto& of_thread, double* residual, double* blocks) {
    detail::layer_packs<Element, true>(form, of_thread, nullptr, in, residual, blocks);
  });
  this->expect_equal(by_nodes.first, by_points.first);
  this->expect_equal(by_nodes.second, by_points.second);
}

}  // namespace

}  // namespace fsi::test
