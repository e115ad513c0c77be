// Patch states of every element on meshes with curved edges: the residual of a state of constant stress vanishes in the
// rows of inner nodes, to rounding, and not on the boundary, where it is the traction.

#include <gtest/gtest.h>

#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/nodal_arrays.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test::element_patch_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

/// Largest momentum residual in the rows of inner nodes and of nodes on the boundary, by the straight mesh.
template <class Element, class Mesh>
std::pair<double, double> inside_and_outside(const Mesh& straight, const std::vector<double>& residual) {
  constexpr int n = Element::components;
  double inside = 0, outside = 0;
  for (std::size_t a = 0; a < straight.nodes.size(); ++a) {
    bool boundary = false;
    for (int i : Element::axis) {
      const double x = straight.nodes[a][i] - (Element::axisymmetric && i == 0 ? 1 : 0);
      boundary = boundary || x < 1e-9 || x > 1 - 1e-9;
    }
    for (int k = 0; k < n; ++k) {
      const double r = std::abs(residual[MixedLayout<n>::vector(static_cast<int>(a), k)]);
      (boundary ? outside : inside) = std::max(boundary ? outside : inside, r);
    }
  }
  return {inside, outside};
}

template <class Element>
class PatchOfElement : public testing::Test {
 protected:
  static constexpr int side = Element::order == 1 ? 3 : 2;
};
TYPED_TEST_SUITE(PatchOfElement, Elements, ElementNames);

/// The law's pressure at a homogeneous deformation over -kappa: J - 1, tr E, tr eps or ln J.
double volume_measure(const Material& layer, const Mat3<Pack>& h) {
  return std::visit(
      [&](const auto& law) {
        if constexpr (std::is_same_v<std::decay_t<decltype(law)>, CompressibleLaw>)
          return law.response(h, deformation(h)).volume_measure[0];
        else
          return volume_change(h)[0];
      },
      element_law(layer));
}

const Yeoh yeoh{3, 0.7, 0.2};  // runs through the loops of constants that vary

template <class Law>
Material with_lame() {
  Law law;
  law.lame_lambda = 4;
  law.lame_mu = 3;
  return law;
}

// A homogeneous deformation (in a body of revolution with equal radial and hoop stretch) with p = -kappa g. The energy
// of the wall is that of a point times the volume.
TYPED_TEST(PatchOfElement, WallIsInEquilibriumInHomogeneousStretch) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const auto straight = irregular_mesh<Element>(this->side, "media");
  auto mesh = straight;
  curve<Element>(mesh, 0.05);
  const double stretch[3] = {1.2, 0.9, 1.05}, shear = Element::axisymmetric ? 0 : 0.15;
  Mat3<Pack> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h(i, j) = Pack(0.0);
  for (int k = 0; k < n; ++k) h(Element::axis[k], Element::axis[k]) = Pack(stretch[k] - 1);
  if (Element::axisymmetric)
    h(1, 1) = h(0, 0);
  else
    h(0, 1) = Pack(shear);
  for (const Material& layer :
       {Material{NeoHookean{3}}, Material{MooneyRivlin{3, 0.3}}, Material{yeoh}, with_lame<SaintVenantKirchhoff>(),
        with_lame<LinearElastic>(), with_lame<CompressibleNeoHookean>()}) {
    WallProblem<Element> wall(whole(mesh), {1.2, 50, 0.5}, {{0, layer}}, {});
    const double kappa = bulk_modulus(layer, 50), pressure = -kappa * volume_measure(layer, h);
    std::vector<double> state(MixedLayout<n>::size(wall.node_count()), 0.0), residual;
    for (int a = 0; a < wall.node_count(); ++a) {
      const Point& x = mesh.nodes[a];
      for (int k = 0; k < n; ++k)
        state[MixedLayout<n>::vector(a, k)] =
            (stretch[k] - 1) * x[Element::axis[k]] + (k == 0 ? shear * x[Element::axis[1]] : 0.1);
      state[MixedLayout<n>::scalar(a)] = pressure;
    }
    wall.assemble({state.data(), nullptr, 0.0}, 0.0, state, residual);
    const auto [inside, outside] = inside_and_outside<Element>(straight, residual);
    EXPECT_LT(inside, 1e-13 * outside);
    EXPECT_GT(outside, 0.1);
    EXPECT_LT(largest(only(residual, n + 1, n, 1)), 1e-13) << "volume";

    const WallEnergy energy = wall.energy(state, {}, state, {});
    const double volume = wall.layer_data()[0].volume;
    const double per_volume = std::visit(
        [&](const auto& law) {
          if constexpr (std::is_same_v<std::decay_t<decltype(law)>, CompressibleLaw>)
            return law.energy(h)[0];
          else if constexpr (std::is_same_v<std::decay_t<decltype(law)>, VaryingLaw>)
            return yeoh.energy(strain_of(h), {})[0];
          else if constexpr (std::is_same_v<typename std::decay_t<decltype(law)>::FibreData, Fibres>)
            return 0.0;
          else
            return law.energy(strain_of(h), {})[0];
        },
        element_law(layer));
    EXPECT_NEAR(energy.isochoric, volume * per_volume, 1e-13 * volume);
    EXPECT_NEAR(energy.volumetric, volume * pressure * pressure / (2 * kappa), 1e-13 * energy.volumetric);
  }
}

// Fluid at rest under constant pressure, on a mesh that has moved anyhow.
TYPED_TEST(PatchOfElement, FluidAtRestBearsConstantPressureOnAMovedMesh) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const auto straight = irregular_mesh<Element>(this->side);
  auto mesh = straight;
  curve<Element>(mesh, 0.05);
  FluidProblem<Element> fluid(whole(mesh), {1.2, 0.05, false, 0.5}, {});
  const auto d = random_field(mesh.nodes, n, 0.1, 0.02, 1);
  std::vector<double> flow(MixedLayout<n>::size(fluid.node_count()), 0.0), residual;
  for (int a = 0; a < fluid.node_count(); ++a) flow[MixedLayout<n>::scalar(a)] = 1.3;
  FluidInput in = euler_input(&d, &d, flow, flow, 0.5);
  ASSERT_FALSE(fluid.assemble(in, {}, residual).inverted());
  const auto [inside, outside] = inside_and_outside<Element>(straight, residual);
  EXPECT_LT(inside, 1e-13 * outside);
  EXPECT_GT(outside, 0.01);
  EXPECT_LT(largest(only(residual, n + 1, n, 1)), 1e-14) << "continuity";
}

}  // namespace

}  // namespace fsi::test::element_patch_tests
