// Which displacements of a wall are no solution, and where they are said to be none.

#include "system/wall_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mesh/point_math.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

/// A block of one layer, `wall`, without loads.
template <class Element>
std::unique_ptr<Scene<Element::components>> block(const MaterialData& layer, double bulk_modulus = 1e5) {
  Case setup;
  setup.structure = StructureData{};
  setup.structure->density = 1;
  setup.structure->bulk_modulus = bulk_modulus;
  setup.structure->layers["wall"] = layer;
  setup.static_load = StaticData{};
  return build_scene<Element>(setup, irregular_mesh<Element>(2, "wall"));
}

/// The displacement of a uniform deformation, by the stretches along the axes of the element's components. In bodies of
/// revolution the first is that of the circumference, too.
template <class Element>
std::vector<double> stretched(const Scene<Element::components>& scene,
                              const std::array<double, Element::components>& by) {
  std::vector<double> wall(scene.wall->space().mixed_size(), 0.0);
  for (int a = 0; a < scene.wall->node_count(); ++a)
    for (int k = 0; k < Element::components; ++k)
      wall[MixedLayout<Element::components>::vector(a, k)] =
          (by[k] - 1) * scene.wall->nodes().nodes[static_cast<std::size_t>(a)][Element::axis[k]];
  return wall;
}

MaterialData neo_hookean() {
  return layer_of("neo-hookean", {{"c10", 3.0}});
}

template <class Element>
class WallCheckOf : public testing::Test {};
TYPED_TEST_SUITE(WallCheckOf, Elements, ElementNames);

TYPED_TEST(WallCheckOf, MeasuresTheVolumeAndNamesThePlace) {
  constexpr int n = TypeParam::components;
  const auto scene = block<TypeParam>(neo_hookean());
  std::array<double, n> by;
  by.fill(1);
  by[0] = 0.5;
  by[n - 1] = 0.9;
  const double volume = (TypeParam::axisymmetric ? 0.25 : 0.5) * 0.9;
  scene->volume_factor = 1.01 / volume;
  const auto wall = stretched<TypeParam>(*scene, by);
  const WallCheck sound = check_wall(*scene, wall);
  EXPECT_EQ(sound.fault, "");
  ASSERT_EQ(sound.layers.size(), 1u);
  EXPECT_NEAR(sound.layers[0].least.value, volume, 1e-12);
  scene->volume_factor = 0.99 / volume;
  const std::string fault = check_wall(*scene, wall).fault;
  EXPECT_NE(fault.find("in layer wall"), std::string::npos) << fault;
  EXPECT_NE(fault.find("mm"), std::string::npos) << fault;
}

TYPED_TEST(WallCheckOf, RefusesAFoldedWallOfAnyLaw) {
  constexpr int n = TypeParam::components;
  std::array<double, n> by;
  by.fill(1);
  by[n - 1] = -0.1;
  for (const char* law : {"neo-hookean", "saint-venant-kirchhoff", "linear-elastic", "compressible-neo-hookean"}) {
    const auto scene = block<TypeParam>(layer_of(law, {{"young", 9.0}, {"poisson", 0.3}}));
    by[n - 1] = 0.1;
    EXPECT_EQ(check_wall(*scene, stretched<TypeParam>(*scene, by)).fault, "") << law;
    by[n - 1] = -0.1;
    const std::string fault = check_wall(*scene, stretched<TypeParam>(*scene, by)).fault;
    EXPECT_EQ(fault.rfind("the wall is folded near (", 0), 0u) << law << ": " << fault;
  }
}

TYPED_TEST(WallCheckOf, FindsAFoldBetweenTheQuadraturePoints) {
  if constexpr (TypeParam::order == 2) {
    constexpr int n = TypeParam::components;
    const auto scene = block<TypeParam>(neo_hookean());
    scene->volume_factor = 1e9;  // the sign alone
    auto wall = stretched<TypeParam>(*scene, {});
    for (double& x : wall) x = 0;
    // One node in the middle of an edge moves along it: det J = 1 + 4 shift (l0 - l1) in the cells beside it, as in
    // CurvedCells.MidEdgeNodeMayMoveAQuarterOfTheEdge. The quadrature points lie inside.
    const auto vertices = scene->wall->cell_vertices();
    const auto& x = scene->wall->nodes().nodes;
    const Point from = x[static_cast<std::size_t>(vertices[0])], to = x[static_cast<std::size_t>(vertices[1])];
    int middle = -1;
    for (int a = 0; a < scene->wall->node_count(); ++a)
      if (distance(x[static_cast<std::size_t>(a)], 0.5 * (from + to)) < 1e-12) middle = a;
    ASSERT_GE(middle, 0);
    const auto move = [&](double shift) {
      for (int k = 0; k < n; ++k)
        wall[MixedLayout<n>::vector(middle, k)] = shift * (to[TypeParam::axis[k]] - from[TypeParam::axis[k]]);
      return check_wall(*scene, wall);
    };
    EXPECT_EQ(move(0.245).fault, "");
    const WallCheck bad = move(0.255);
    EXPECT_GT(bad.layers[0].least.value, 0);
    EXPECT_EQ(bad.fault.rfind("the wall is folded near (", 0), 0u) << bad.fault;
    EXPECT_NEAR(bad.layers[0].folded.value, 1 - 4 * 0.255, 1e-12);
    EXPECT_NEAR(distance(bad.layers[0].folded.where, to), 0, 1e-12);
  }
}

TYPED_TEST(WallCheckOf, MeasuresTheStrainOfLinearElasticLayers) {
  constexpr int n = TypeParam::components;
  const auto scene = block<TypeParam>(layer_of("linear-elastic", {{"young", 9.0}, {"poisson", 0.3}}));
  std::array<double, n> by;
  by.fill(1);
  by[n - 1] = 0.93;
  const auto layers = check_wall(*scene, stretched<TypeParam>(*scene, by)).layers;
  EXPECT_NEAR(layers[0].strain.value, 0.07, 1e-12);
  EXPECT_NEAR(layers[0].rotation.value, 0, 1e-12);
  // u_0 = a x_last: half of it strain, half rotation; the hoop strain of a ring, a z / r, is at most a there.
  auto sheared = stretched<TypeParam>(*scene, by);
  for (int a = 0; a < scene->wall->node_count(); ++a) {
    for (int k = 0; k < n; ++k) sheared[MixedLayout<n>::vector(a, k)] = 0;
    sheared[MixedLayout<n>::vector(a, 0)] =
        0.2 * scene->wall->nodes().nodes[static_cast<std::size_t>(a)][TypeParam::axis[n - 1]];
  }
  const auto of_shear = check_wall(*scene, sheared).layers[0];
  EXPECT_NEAR(of_shear.rotation.value, 0.1, 1e-12);
  if (!TypeParam::axisymmetric) {
    EXPECT_NEAR(of_shear.strain.value, 0.1, 1e-12);
  }
}

TEST(WallCheck, TellsNearlyIncompressibleLaws) {
  const auto is = [](const char* law, const ParameterValues& values, double of_structure) {
    return is_nearly_incompressible(make_material(law, values), of_structure);
  };
  EXPECT_TRUE(is("neo-hookean", {{"c10", 3.0}}, 60.0));
  EXPECT_FALSE(is("neo-hookean", {{"c10", 3.0}}, 59.0));
  EXPECT_FALSE(is("neo-hookean", {{"young", 3.0}, {"poisson", 0.3}}, 1e5));
  EXPECT_FALSE(is("saint-venant-kirchhoff", {{"young", 3.0}, {"poisson", 0.499}}, 1e5));
}

}  // namespace

}  // namespace fsi::test
