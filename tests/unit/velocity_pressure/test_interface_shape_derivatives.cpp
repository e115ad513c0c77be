// What the condensed matrix knows of the mesh motion: on the interface, all that needs no harmonic extension.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linear/interface/jacobian_product.hpp"
#include "linear/velocity_pressure/velocity_pressure_matrix.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

/// Products of the condensed matrix and of the whole Jacobian with velocities of the interface, the mesh elsewhere at
/// rest: their difference in the interface's momentum equations over the part of them that comes from the mesh motion.
double relative_error(Numbering numbering, Scene<3>& scene) {
  System<3> system("scene", scene, std::move(numbering));
  State state = scene.at_rest();
  for (std::size_t i = 0; i < state.now.fluid.size(); ++i) state.now.fluid[i] = std::sin(static_cast<double>(i));
  StepData data;
  data.rates = scene.integrator->rates(state, 0.125);
  data.opening_pressures = {1.332};
  data.interface_load.assign(state.now.wall.size(), 0.0);
  system.work_on(state, data);
  system.evaluate();
  system.linearise();
  auto blocks = system.blocks();
  VelocityPressureLayout<3> layout(blocks);
  VelocityPressureMatrix<3> matrix(blocks, layout);
  matrix.fill();

  std::vector<char> wet(layout.velocities, 0);
  for (const auto& node : scene.interface)
    if (layout.velocity_of_fluid[node.fluid] >= 0) wet[layout.velocity_of_fluid[node.fluid]] = 1;
  std::vector<double> v(layout.size(), 0.0), mine, x(static_cast<std::size_t>(blocks.numbering.size), 0.0), all, rows,
      fixed_mesh;
  for (std::size_t i = 0; i < layout.velocity_size(); ++i)
    if (wet[i / 3]) v[i] = std::cos(static_cast<double>(i));
  std::vector<float> single(matrix.size()), product(single);
  matrix.take(v, 1, single);
  matrix.multiply(single, product);
  matrix.give(product, 1, mine);

  layout.give(v, x);
  JacobianProduct<3>(blocks).multiply(x, all);
  layout.take(all, rows);
  blocks.shape_derivatives = nullptr;
  JacobianProduct<3>(blocks).multiply(x, all);
  layout.take(all, fixed_mesh);
  double error = 0, shape = 0;
  for (std::size_t i = 0; i < layout.velocity_size(); ++i) {
    if (!wet[i / 3]) continue;
    error += std::pow(mine[i] - rows[i], 2);
    shape += std::pow(rows[i] - fixed_mesh[i], 2);
  }
  EXPECT_GT(shape, 0);
  return std::sqrt(error / shape);
}

TEST(InterfaceShapeDerivatives, AreThoseOfTheJacobianInFluidAndWall) {
  auto& scene = linearised_box().scene();
  EXPECT_LT(relative_error(number_scene(scene), scene), 1e-3);
}

TEST(InterfaceShapeDerivatives, AreThoseOfTheJacobianInTheFluidWithItsDomain) {
  auto& scene = linearised_box().scene();
  EXPECT_LT(relative_error(number_fluid_and_domain(scene), scene), 1e-3);
}

// By displacements of the mesh as by the velocities that they come with.
TEST(InterfaceShapeDerivatives, MultiplyDisplacementsAsTheirVelocities) {
  auto& scene = linearised_box().scene();
  System<3> system("scene", scene, number_scene(scene));
  State state = scene.at_rest();
  for (std::size_t i = 0; i < state.now.fluid.size(); ++i) state.now.fluid[i] = std::sin(static_cast<double>(i));
  StepData data;
  data.rates = scene.integrator->rates(state, 0.125);
  data.opening_pressures = {1.332};
  data.interface_load.assign(state.now.wall.size(), 0.0);
  system.work_on(state, data);
  system.linearise();
  const auto blocks = system.blocks();
  VelocityPressureLayout<3> layout(blocks);
  const InterfaceShapeDerivatives<3> derivatives(blocks, layout);

  std::vector<double> v(layout.size(), 0.0), x(static_cast<std::size_t>(blocks.numbering.size), 0.0);
  for (std::size_t i = 0; i < layout.velocity_size(); ++i) v[i] = std::cos(static_cast<double>(i));
  layout.give(v, x);
  std::vector<double> mesh(blocks.numbering.mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i)
    if (const Unknown& unknown = blocks.numbering.mesh[i]; unknown.index >= 0)
      mesh[i] = unknown.factor * x[unknown.index];
  std::vector<double> by_mesh(layout.size(), 0.0), by_velocity = by_mesh;
  derivatives.add_product(mesh, by_mesh);
  double largest = 0;
  for (int row = 0; row < layout.velocities; ++row)
    derivatives.for_row(row, [&](int column, int i, int k, double value) {
      by_velocity[VectorLayout<3>::vector(row, i)] += value * v[VectorLayout<3>::vector(column, k)];
      largest = std::max(largest, std::abs(value));
    });
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < by_mesh.size(); ++i) EXPECT_NEAR(by_mesh[i], by_velocity[i], 1e-12 * largest) << i;
}

// A part alone has no mesh motion: its matrix is the Jacobian.
TEST(InterfaceShapeDerivatives, AreNoneWhereTheMeshIsGiven) {
  auto& scene = linearised_box().scene();
  System<3> system("scene", scene, number_fluid(scene, /*free_interface=*/true));
  const auto blocks = system.blocks();
  VelocityPressureLayout<3> layout(blocks);
  int asked = 0;
  const InterfaceShapeDerivatives<3> none(blocks, layout);
  for (int v = 0; v < layout.velocities; ++v) none.for_row(v, [&](int, int, int, double) { ++asked; });
  EXPECT_EQ(asked, 0);
}

}  // namespace

}  // namespace fsi::test
