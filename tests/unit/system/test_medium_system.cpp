// A medium as a part of a coupled problem: further forces, the steps of an iteration over several media; and systems on one
// scene that do not disturb each other.
#include "system/medium_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "fem/p1_tetrahedron.hpp"
#include "linear/choice/general_solvers.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "support/nodal_arrays.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "system/numbering.hpp"

namespace fsi::test {

namespace {

/// Fluid and wall of a box at a random state, and forces on the fluid.
struct Box {
  std::unique_ptr<Scene<3>> scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(2));
  State state = scene->at_rest();
  StepData data;
  std::vector<double> forces;

  Box() {
    data.rates = scene->integrator->rates(state, 0.125);
    data.opening_pressures = {1.332};
    data.interface_load.assign(state.now.wall.size(), 0.0);
    state.now.fluid = random_field(scene->fluid->nodes().nodes, 4, 0.3, 1e-3, 1);
    state.now.wall = random_field(scene->wall->nodes().nodes, 4, 1e-3, 1e-4, 2);
    forces = random_field(scene->fluid->nodes().nodes, 4, 0.5, 0.1, 3);
  }
  std::unique_ptr<MediumSystem<3>> fluid(const LinearSolverFactory<3>& make_solver = {}) {
    auto made = std::make_unique<MediumSystem<3>>("fluid", *scene, number_fluid(*scene, true), make_solver);
    made->work_on(state, data);
    made->evaluate();
    made->linearise();
    return made;
  }
  std::vector<double> velocity_increments(const MediumSystem<3>& system) const {
    std::vector<double> all;
    for (int node = 0; node < scene->fluid->node_count(); ++node)
      for (const double component : system.increment_at(node)) all.push_back(component);
    return all;
  }
};

TEST(MediumSystem, ResponseToForcesIsWhatTheyAddToASolution) {
  Box box;
  const auto system = box.fluid();
  system->solve(1e-10);
  const auto alone = box.velocity_increments(*system);
  ASSERT_TRUE(system->add_response(box.forces, 1e-10));
  const auto added = box.velocity_increments(*system);
  system->solve_with(box.forces, 1e-10);
  const auto at_once = box.velocity_increments(*system);
  EXPECT_GT(largest(difference(at_once, alone)), 1e-2 * largest(at_once));
  EXPECT_LT(largest(difference(added, at_once)), 1e-10 * largest(at_once));
}

TEST(MediumSystem, LinearResidualIsThatOfTheIncrement) {
  Box box;
  FastOptions iterative;
  iterative.direct_below = 0;
  const auto system = box.fluid(general_solver_factory<3>("fast", iterative));
  std::vector<double> residual, with_forces, z(static_cast<std::size_t>(system->numbering().columns())), product;
  system->begin_increment();
  system->linear_residual(std::vector<double>(box.forces.size(), 0.0), residual);
  EXPECT_EQ(residual, system->residual());
  system->linear_residual(box.forces, with_forces);
  auto added = difference(with_forces, residual);
  add_to_field(system->numbering().fluid, added, -1, box.forces);  // of rows that have an equation
  double left = 0;
  for (std::size_t i = 0; i < box.forces.size(); ++i)
    if (system->numbering().fluid_rows[i].index >= 0) left = std::max(left, std::abs(box.forces[i]));
  EXPECT_LT(left, 1e-12);
  Random random(4);
  for (double& value : z) value = random();
  system->correct_increment(z);
  system->linear_residual(std::vector<double>(box.forces.size(), 0.0), residual);
  JacobianProduct<3>(system->blocks()).multiply(z, product);
  const auto expected = difference(system->residual(), product);
  EXPECT_LT(largest(difference(residual, expected)), 1e-12 * largest(expected));
}

TEST(System, JacobiansOnOneSceneAreTheirOwn) {
  Box box;
  const auto first = box.fluid();
  MediumSystem<3> first_wall("wall", *box.scene, number_wall(*box.scene));
  first_wall.work_on(box.state, box.data);
  first_wall.linearise();
  const auto fluid_values = *first->fluid_values();
  const auto wall_values = *first_wall.wall_values();
  first->solve(1e-10);
  const auto before = box.velocity_increments(*first);
  EXPECT_EQ(first->wall_values(), nullptr);
  EXPECT_EQ(first_wall.fluid_values(), nullptr);

  State moved = box.state;
  for (double& value : moved.now.fluid) value *= 3;
  for (double& value : moved.now.wall) value *= 30;
  MediumSystem<3> second("fluid", *box.scene, number_fluid(*box.scene, true)),
      second_wall("wall", *box.scene, number_wall(*box.scene));
  second.work_on(moved, box.data);
  second.linearise();
  second_wall.work_on(moved, box.data);
  second_wall.linearise();
  EXPECT_NE(*second.fluid_values(), fluid_values) << "a difference that can be seen";
  EXPECT_NE(*second_wall.wall_values(), wall_values);
  EXPECT_EQ(*first->fluid_values(), fluid_values);
  EXPECT_EQ(*first_wall.wall_values(), wall_values);
  first->solve(1e-10);
  EXPECT_EQ(box.velocity_increments(*first), before);
}

}  // namespace

}  // namespace fsi::test
