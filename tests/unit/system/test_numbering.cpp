#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

// fluid_and_wall_box(n) has (n+1)^2 nodes in each of n + 3 planes z = const: n + 1 of the fluid, the last of them the
// interface, and two more of the wall. Inside the square there are (n-1)^2.
struct Counts {
  int n, plane, inner;
  explicit Counts(int side) : n(side), plane((side + 1) * (side + 1)), inner((side - 1) * (side - 1)) {}
  int fluid_nodes() const { return plane * (n + 1); }
  int wall_nodes() const { return plane * 3; }
  int interface_unknowns() const { return 3 * inner; }      ///< its rim is clamped
  int wall_displacements() const { return 3 * inner * 3; }  ///< clamped on its sides, free on top and below
  /// Inner nodes of planes 1 ... n - 1, and those of inlet and outlet x = 0, 1 away from the closed sides.
  int free_velocities() const { return 3 * (inner * (n - 1) + 2 * (n - 1) * (n - 1)); }
  int free_mesh_nodes() const { return 3 * inner * (n - 1); }
};

std::set<std::int64_t> indices(const UnknownMap& map) {
  std::set<std::int64_t> found;
  for (const auto& unknown : map)
    if (unknown.index >= 0) found.insert(unknown.index);
  return found;
}

TEST(SceneOfABox, HasTheSubProblemsAndBoundaryConditionsOfTheCase) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(3));
  const Counts counts(3);
  EXPECT_EQ(scene->fluid->node_count(), counts.fluid_nodes());
  EXPECT_EQ(scene->wall->node_count(), counts.wall_nodes());
  EXPECT_EQ(static_cast<int>(scene->interface.size()), counts.plane);
  EXPECT_EQ(scene->wall->layer_data().size(), 2u);
  int clamped = 0;
  for (const auto& node : scene->interface) {
    EXPECT_EQ(scene->fluid->nodes().nodes[node.fluid], scene->wall->nodes().nodes[node.wall]);
    EXPECT_EQ(scene->fluid->nodes().nodes[node.fluid][2], 1.0);
    clamped += node.clamped;
  }
  EXPECT_EQ(clamped, counts.plane - counts.inner);
  for (std::size_t i = 1; i < scene->interface.size(); ++i)
    EXPECT_LT(scene->interface[i - 1].fluid, scene->interface[i].fluid);
}

TEST(Numbering, OfTheSceneCountsEveryUnknownOnce) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(3));
  const Counts counts(3);
  const auto all = number_scene(*scene);
  EXPECT_EQ(all.size, counts.wall_displacements() + counts.wall_nodes() + counts.free_velocities() +
                          counts.fluid_nodes() + counts.free_mesh_nodes());
  // All numbers from 0 to size - 1 appear as unknowns and as equations.
  std::set<std::int64_t> unknowns, equations;
  for (const auto* map : {&all.mesh, &all.fluid, &all.wall}) unknowns.merge(indices(*map));
  for (const auto* map : {&all.mesh_rows, &all.fluid_rows, &all.wall_rows}) equations.merge(indices(*map));
  for (const auto* found : {&unknowns, &equations}) {
    EXPECT_EQ(static_cast<std::int64_t>(found->size()), all.size);
    EXPECT_EQ(*found->begin(), 0);
    EXPECT_EQ(*found->rbegin(), all.size - 1);
  }
}

TEST(Numbering, InterfaceHasOneOwner) {
  const double step = 0.25;
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean", step), fluid_and_wall_box(3));
  auto all = number_scene(*scene);
  EXPECT_TRUE(all.follow({step})) << "the factors are those of the step";
  EXPECT_FALSE(all.follow({step})) << "and stay";
  EXPECT_EQ(all.version, 1);
  int shared = 0;
  for (const auto& node : scene->interface)
    for (int k = 0; k < 3; ++k) {
      const auto &wall = all.wall[4 * node.wall + k], &mesh = all.mesh[3 * node.fluid + k],
                 &flow = all.fluid[4 * node.fluid + k];
      EXPECT_EQ(mesh.index, wall.index) << "d_m = d_s";
      EXPECT_EQ(flow.index, wall.index) << "u = (d_s - d_s old) / dt";
      EXPECT_EQ(all.fluid_rows[4 * node.fluid + k].index, wall.index) << "one sum of both momentum equations";
      EXPECT_EQ(all.mesh_rows[3 * node.fluid + k].index, -1) << "no equation of mesh motion";
      if (node.clamped) {
        EXPECT_EQ(wall.index, -1);
        continue;
      }
      ++shared;
      EXPECT_EQ(wall.factor, 1);
      EXPECT_EQ(mesh.factor, 1);
      EXPECT_EQ(flow.factor, 1 / step);
      EXPECT_EQ(all.fluid_rows[4 * node.fluid + k].factor, 1);
      EXPECT_NE(all.fluid[4 * node.fluid + 3].index, all.wall[4 * node.wall + 3].index) << "pressures are separate";
    }
  EXPECT_EQ(shared, Counts(3).interface_unknowns());
}

TEST(Numbering, OfTheFluidAlonePrescribesTheInterfaceVelocity) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(3));
  const Counts counts(3);
  const auto part = number_fluid(*scene);
  EXPECT_EQ(part.size, counts.free_velocities() + counts.fluid_nodes());
  EXPECT_TRUE(part.mesh.empty() && part.wall.empty());
  for (const auto& node : scene->interface) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(part.fluid[4 * node.fluid + k].index, -1);
    EXPECT_GE(part.fluid[4 * node.fluid + 3].index, 0);
  }
}

TEST(Numbering, OfTheWallAloneLeavesTheInterfaceFree) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(3));
  const Counts counts(3);
  const auto part = number_wall(*scene);
  EXPECT_EQ(part.size, counts.wall_displacements() + counts.wall_nodes());
  EXPECT_TRUE(part.mesh.empty() && part.fluid.empty());
  for (const auto& node : scene->interface)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(part.wall[4 * node.wall + k].index >= 0, !node.clamped);
}

// Pressures per layer: the copies of a vertex have one displacement and one momentum equation, and a pressure each.
TEST(Numbering, CopiesOfAWallNodeShareTheirDisplacement) {
  auto setup = coupled_case("neo-hookean");
  setup.structure->layer_pressure = LayerPressure::separate;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3));
  const Counts counts(3);
  const auto& nodes = scene->wall->nodes();
  EXPECT_EQ(nodes.node_count(), counts.wall_nodes() + counts.plane);
  const auto wall = number_wall(*scene), all = number_scene(*scene);
  EXPECT_EQ(wall.size, counts.wall_displacements() + counts.wall_nodes() + counts.plane);
  EXPECT_EQ(all.size, wall.size + counts.free_velocities() + counts.fluid_nodes() + counts.free_mesh_nodes());
  for (const auto* part : {&wall, &all}) {
    std::set<std::int64_t> pressures;
    int copies = 0;
    for (int a = 0; a < nodes.node_count(); ++a) {
      for (const auto* map : {&part->wall, &part->wall_rows})
        for (int k = 0; k < 3; ++k) EXPECT_EQ((*map)[4 * a + k].index, (*map)[4 * nodes.original_of(a) + k].index);
      pressures.insert(part->wall[4 * a + 3].index);
      copies += nodes.original_of(a) != a;
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(scene->wall_conditions.fixes(a, k), scene->wall_conditions.fixes(nodes.original_of(a), k));
    }
    EXPECT_EQ(copies, counts.plane);
    EXPECT_EQ(static_cast<int>(pressures.size()), nodes.node_count()) << "each has its own";
    EXPECT_EQ(pressures.count(-1), 0u);
  }
  for (const auto& node : scene->interface) EXPECT_EQ(nodes.original_of(node.wall), node.wall);
}

TEST(Numbering, OfTheMeshMotionPrescribesTheWholeBoundary) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(3));
  const auto part = number_mesh_motion(*scene);
  EXPECT_EQ(part.size, Counts(3).free_mesh_nodes());
  for (std::size_t a = 0; a < scene->fluid->nodes().nodes.size(); ++a) {
    const auto& x = scene->fluid->nodes().nodes[a];
    const bool inside = std::all_of(x.begin(), x.end(), [](double c) { return c > 1e-12 && c < 1 - 1e-12; });
    for (int k = 0; k < 3; ++k) EXPECT_EQ(part.mesh[3 * a + k].index >= 0, inside);
  }
}

TEST(Numbering, ScenesOfOneSubProblemHaveNoUnknownsOfTheOther) {
  auto setup = coupled_case("neo-hookean");
  setup.structure.reset();
  const auto rigid = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3));
  EXPECT_FALSE(rigid->coupled());
  EXPECT_TRUE(rigid->mesh_motion.values.empty()) << "no mesh motion is assembled for a rigid wall";
  const auto fluid = number_scene(*rigid);
  EXPECT_TRUE(fluid.wall.empty() && fluid.mesh.empty());
  EXPECT_EQ(fluid.size, Counts(3).free_velocities() + Counts(3).fluid_nodes()) << "the interface is a no-slip wall now";

  setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  const auto dry = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3));
  const auto wall = number_scene(*dry);
  EXPECT_TRUE(wall.fluid.empty() && wall.mesh.empty());
  EXPECT_EQ(wall.size, Counts(3).wall_displacements() + Counts(3).wall_nodes());
}

// A symmetry plane: one component of the wall's displacement and of the fluid's velocity is prescribed, two are free.
TEST(Numbering, LeavesOutSingleComponents) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(3));
  const auto before = number_scene(*scene);
  const auto& x = scene->fluid->nodes().nodes;
  const int inside = static_cast<int>(std::find_if(x.begin(), x.end(),
                                                   [](const Point& p) {
                                                     return p[0] > 0.1 && p[0] < 0.9 && p[1] > 0.1 && p[1] < 0.9 &&
                                                            p[2] > 0.1 && p[2] < 0.9;
                                                   }) -
                                      x.begin());
  scene->velocity_conditions.fix(inside, 1);
  const auto moving = std::find_if(scene->interface.begin(), scene->interface.end(),
                                   [](const InterfaceNode& node) { return !node.clamped; });
  scene->wall_conditions.fix(moving->wall, 2);
  const auto all = number_scene(*scene);
  EXPECT_EQ(all.size, before.size - 2);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(all.fluid[MixedLayout<3>::vector(inside, k)].index >= 0, k != 1);
    EXPECT_EQ(all.wall[MixedLayout<3>::vector(moving->wall, k)].index >= 0, k != 2);
    EXPECT_EQ(all.mesh[VectorLayout<3>::vector(moving->fluid, k)].index >= 0, k != 2);
    EXPECT_EQ(all.fluid[MixedLayout<3>::vector(moving->fluid, k)].index >= 0, k != 2);
  }
}

TEST(DirichletConditions, HoldComponentsWithTheirValues) {
  DirichletConditions<3> conditions(4);
  conditions.fix(1, 2, 0.5);
  conditions.fix(3);
  conditions.fix(3, 0, -2);
  EXPECT_FALSE(conditions.fixes(1));
  EXPECT_TRUE(conditions.fixes(1, 2));
  EXPECT_TRUE(conditions.fixes(3));
  std::vector<double> field(16, 7.0), expected(field);
  expected[1 * 4 + 2] = 0.5;
  expected[3 * 4 + 0] = -2;
  conditions.impose<MixedLayout<3>>(field);
  EXPECT_EQ(field, expected) << "values that are zero are left to the fields, which start from zero";
  conditions.fix(1, 2, 0.25);
  conditions.impose<MixedLayout<3>>(field);
  EXPECT_EQ(field[6], 0.25);
}

TEST(Scene, InterfaceConditionsAreImposedOnEveryComponent) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean", 0.25), fluid_and_wall_box(3));
  State state = scene->at_rest();
  state.now.wall = random_field(scene->wall->nodes().nodes, 4, 0.1, 0.1, 1);
  state.before[0].wall = random_field(scene->wall->nodes().nodes, 4, 0.1, 0.1, 2);
  scene->impose_interface(state, scene->integrator->rates(state, 0.25));
  for (const auto& node : scene->interface)
    for (int k = 0; k < 3; ++k) {
      const double d = state.now.wall[4 * node.wall + k], d_old = state.before[0].wall[4 * node.wall + k];
      EXPECT_EQ(state.now.mesh[3 * node.fluid + k], d);
      EXPECT_DOUBLE_EQ(state.now.fluid[4 * node.fluid + k], (d - d_old) / 0.25);
      EXPECT_EQ(state.now.fluid[4 * node.fluid + 3], 0) << "pressures are not touched";
    }
}

}  // namespace

}  // namespace fsi::test
