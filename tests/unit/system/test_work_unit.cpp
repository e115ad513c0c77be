// The work unit: its matrix has the numbers of the monolithic Jacobian, each of which a product reads, and nothing that a
// step reads is changed by it.
#include "system/work_unit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "fem/p1_tetrahedron.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/scenes.hpp"
#include "system/system.hpp"

namespace fsi::test {

namespace {

constexpr int n = 3, mixed = 4;

std::unique_ptr<Scene<3>> box(bool fluid, bool wall, bool elastic_mesh = false) {
  Case setup = coupled_case("neo-hookean");
  if (!fluid) {
    setup.fluid.reset();
    setup.inlet.reset();
    setup.load = PressureTable{{{0.0, 1.0}}};
  }
  if (!wall) setup.structure.reset();
  if (elastic_mesh) setup.mesh_motion.method = MeshMotionMethod::nonlinear_elastic;
  auto mesh = fluid_and_wall_box(2);
  return build_scene<P1Tetrahedron>(setup, mesh);
}

/// Numbers that the monolithic driver stores for this scene.
std::int64_t stored(Scene<3>& scene) {
  System<3> system("coupled", scene, number_scene(scene));
  const auto blocks = system.blocks();
  std::size_t numbers = 0;
  const auto add = [&](const auto* matrix) { numbers += matrix ? matrix->values.size() : 0; };
  add(blocks.fluid);
  add(blocks.shape_derivatives);
  add(blocks.mesh_laplacian);
  add(blocks.mesh_tangent);
  add(blocks.wall);
  return static_cast<std::int64_t>(numbers);
}

/// What each row of nodes sums up where all numbers are one: how many there are in it.
std::vector<double> counted(const NodeGraph& graph, int rows, int columns) {
  std::vector<double> sums;
  for (int a = 0; a < graph.rows(); ++a)
    sums.insert(sums.end(), static_cast<std::size_t>(rows),
                static_cast<double>(columns * (graph.offsets[a + 1] - graph.offsets[a])));
  return sums;
}

/// Matrices of the media of which all numbers are one.
struct Ones {
  explicit Ones(const Scene<3>& scene) {
    constexpr std::size_t of_block = mixed * mixed;
    if (scene.fluid) fluid.assign(of_block * static_cast<std::size_t>(scene.fluid->graph()->blocks()), 1.0);
    if (scene.wall) wall.assign(of_block * static_cast<std::size_t>(scene.wall->graph()->blocks()), 1.0);
  }
  MatrixValues values() const { return {fluid.empty() ? nullptr : &fluid, wall.empty() ? nullptr : &wall}; }

  std::vector<double> fluid, wall;
};

TEST(WorkUnit, IsOfTheMatrixOfTheMonolithicDriver) {
  for (const bool elastic_mesh : {false, true}) {
    const auto scene = box(true, true, elastic_mesh);
    EXPECT_EQ(CoupledProduct<3>(*scene).entries(), stored(*scene));
    ASSERT_EQ(scene->nonlinear_mesh_motion != nullptr, elastic_mesh);
  }
}

TEST(WorkUnit, IsOfTheOneMediumThatThereIs) {
  for (const bool fluid : {true, false}) {
    const auto scene = box(fluid, !fluid);
    EXPECT_EQ(CoupledProduct<3>(*scene).entries(), stored(*scene));
    const Ones ones(*scene);
    CoupledProduct<3> product(*scene);
    product.multiply(ones.values());
    EXPECT_EQ(product.fluid_rows(), fluid ? counted(*scene->fluid->graph(), mixed, mixed) : std::vector<double>());
    EXPECT_EQ(product.wall_rows(), fluid ? std::vector<double>() : counted(*scene->wall->graph(), mixed, mixed));
    EXPECT_TRUE(product.mesh_rows().empty());
  }
}

TEST(WorkUnit, ReadsEachNumberOnce) {
  for (const bool elastic_mesh : {false, true}) {
    const auto scene = box(true, true, elastic_mesh);
    const Ones ones(*scene);
    CoupledProduct<3> product(*scene);
    for (int again = 0; again < 2; ++again) {  // rows are those of one product, however many there were
      product.multiply(ones.values());
      EXPECT_EQ(product.fluid_rows(), counted(*scene->fluid->graph(), mixed, mixed + n));
      EXPECT_EQ(product.mesh_rows(), counted(*scene->fluid->graph(), n, elastic_mesh ? n : 1));
      EXPECT_EQ(product.wall_rows(), counted(*scene->wall->graph(), mixed, mixed));
    }
  }
}

TEST(WorkUnit, LeavesTheJacobiansAlone) {
  const auto scene = box(true, true);
  System<3> system("coupled", *scene, number_scene(*scene));
  State state = scene->at_rest();
  StepData data;
  data.rates = scene->integrator->rates(state, 0.125);
  data.opening_pressures = {1.332, 0};
  system.work_on(state, data);
  system.linearise();
  const auto blocks = system.blocks();
  const auto fluid = blocks.fluid->values, shape = blocks.shape_derivatives->values, wall = blocks.wall->values,
             mesh = blocks.mesh_laplacian->values;
  WorkUnitMeter<3> meter(*scene);
  meter.measure(1e9, {system.fluid_values(), system.wall_values()});
  EXPECT_EQ(meter.unit().products, 1);
  EXPECT_EQ(blocks.fluid->values, fluid);
  EXPECT_EQ(blocks.shape_derivatives->values, shape);
  EXPECT_EQ(blocks.wall->values, wall);
  EXPECT_EQ(blocks.mesh_laplacian->values, mesh);
}

TEST(WorkUnit, TakesAFewProductsWhereTheRunIsLongEnough) {
  const auto scene = box(true, true);
  const Ones ones(*scene);
  WorkUnitMeter<3> meter(*scene);
  meter.measure(0, {});
  EXPECT_EQ(meter.unit().products, 0) << "there is no matrix";
  for (int step = 0; step < 3; ++step) {
    meter.measure(0, ones.values());
    EXPECT_EQ(meter.unit().products, 1) << "a run of no length has no room for a second one";
  }
  EXPECT_GT(meter.unit().seconds, 0);
  EXPECT_GE(meter.unit().spent, meter.unit().seconds);
  EXPECT_EQ(meter.unit().entries, CoupledProduct<3>(*scene).entries());
  for (int step = 0; step < 20; ++step) meter.measure(1e9, ones.values());
  EXPECT_EQ(meter.unit().products, WorkUnitMeter<3>::enough);
  EXPECT_GE(meter.unit().spent, WorkUnitMeter<3>::enough * meter.unit().seconds);
}

}  // namespace

}  // namespace fsi::test
