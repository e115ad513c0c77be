// The impedance on the interface: its rows in the residual, its diagonal in the Jacobian, components without equations;
// and the fluid whose domain follows its interface.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/p1_tetrahedron.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "support/nodal_arrays.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "system/medium_system.hpp"
#include "system/numbering.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;
using Mixed = MixedLayout<3>;

/// The fluid of a box at a random state, its velocity free on the interface.
struct FreeFluid {
  std::unique_ptr<Scene<3>> scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(2));
  State state = scene->at_rest();
  StepData data;
  InterfaceImpedance impedance;

  FreeFluid() {
    data.rates = scene->integrator->rates(state, 0.125);
    data.opening_pressures = {1.332};
    state.now.fluid = random_field(scene->fluid->nodes().nodes, 4, 0.3, 1e-3, 1);
    Random random(2);
    for (const auto& node : scene->interface) {
      impedance.nodes.push_back(node.fluid);
      impedance.impedance.push_back(random());  // of both signs
      for (int k = 0; k < 3; ++k) impedance.velocity.push_back(random());
    }
    impedance.impedance.front() = 0;
  }
  std::unique_ptr<MediumSystem<3>> system(const InterfaceImpedance* with) {
    auto made = std::make_unique<MediumSystem<3>>("fluid", *scene, number_fluid(*scene, true), LinearSolverFactory<3>{},
                                                  SystemNorm::entries, with);
    made->work_on(state, data);
    return made;
  }
};

TEST(InterfaceImpedance, AddsItsRowsToTheResidualAndNotToTheFluids) {
  FreeFluid fluid;
  const auto plain = fluid.system(nullptr), tied = fluid.system(&fluid.impedance);
  plain->evaluate();
  tied->evaluate();
  EXPECT_EQ(plain->fluid_residual(), tied->fluid_residual());
  auto expected = plain->residual();
  int rows = 0;
  for (std::size_t i = 0; i < fluid.impedance.nodes.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::size_t entry = Mixed::vector(fluid.impedance.nodes[i], k);
      const auto row = tied->numbering().fluid_rows[entry].index;
      if (row < 0) continue;
      ++rows;
      expected[row] +=
          fluid.impedance.impedance[i] * (fluid.state.now.fluid[entry] - fluid.impedance.velocity[3 * i + k]);
    }
  EXPECT_GT(rows, 0);
  EXPECT_LT(largest(difference(tied->residual(), expected)), 1e-14);
}

TEST(InterfaceImpedance, TakesANewDatumWithTheRowsThatItKeeps) {
  FreeFluid fluid;
  const auto tied = fluid.system(&fluid.impedance);
  tied->evaluate();
  const auto before = tied->residual();
  for (double& v : fluid.impedance.velocity) v += 0.5;
  tied->keep_rows();
  const double norm = tied->evaluate();
  const auto kept = tied->residual();
  EXPECT_GT(largest(difference(kept, before)), 0.1);
  EXPECT_EQ(tied->evaluate(), norm);
  EXPECT_EQ(tied->residual(), kept) << "bit for bit what a whole evaluation gives";
  // Rows that are kept serve once, and those of another iterate never.
  tied->linearise();
  tied->keep_rows();
  tied->solve(1e-8);
  tied->move(1);
  tied->evaluate();
  const auto moved = tied->residual();
  EXPECT_GT(largest(difference(moved, kept)), 1e-6);
  tied->work_on(fluid.state, fluid.data);
  tied->evaluate();
  EXPECT_EQ(tied->residual(), moved);
}

TEST(InterfaceImpedance, IsTheDerivativeOfItsRows) {
  FreeFluid fluid;
  const auto tied = fluid.system(&fluid.impedance), plain = fluid.system(nullptr);
  plain->linearise();
  const auto without = plain->blocks().fluid->values;
  tied->linearise();
  const auto& with = *tied->blocks().fluid;
  auto rest = with.values;
  for (std::size_t i = 0; i < fluid.impedance.nodes.size(); ++i) {
    const int node = fluid.impedance.nodes[i], at = with.graph->find(node, node);
    for (int k = 0; k < 3; ++k)
      if (tied->numbering().fluid_rows[Mixed::vector(node, k)].index >= 0)
        rest[static_cast<std::size_t>(at) * 16 + k * 5] -= fluid.impedance.impedance[i];
  }
  EXPECT_LT(largest(difference(rest, without)), 1e-13);
  EXPECT_GT(largest(difference(with.values, without)), 0.1);
}

/// The domain hangs on the velocity of the interface, factor and all.
TEST(FluidAndDomain, JacobianIsTheDerivativeOfTheResidual) {
  FreeFluid fluid;
  System<3> system("fluid", *fluid.scene, number_fluid_and_domain(*fluid.scene));
  Random random(3);
  for (double& d : fluid.state.now.mesh) d = 1e-2 * random();
  system.work_on(fluid.state, fluid.data);
  system.evaluate();
  system.linearise();
  std::vector<double> x(static_cast<std::size_t>(system.numbering().size)), product;
  for (double& value : x) value = random();
  JacobianProduct<3>(system.blocks()).multiply(x, product);
  const auto residual_at = [&](double step) {
    const State before = fluid.state;
    add_to_field(system.numbering().mesh, x, step, fluid.state.now.mesh);
    add_to_field(system.numbering().fluid, x, step, fluid.state.now.fluid);
    system.evaluate();
    fluid.state = before;
    return system.residual();
  };
  std::vector<double> errors;
  for (const double step : {2e-3, 1e-3}) {
    auto quotient = difference(residual_at(step), residual_at(-step));
    for (double& value : quotient) value /= 2 * step;
    errors.push_back(largest(difference(quotient, product)) / largest(product));
  }
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
  // Without the factor, a step's length, the derivative would be another one.
  EXPECT_EQ(system.numbering().mesh[system.numbering().interface_displacements[0]].factor, 0.125);
}

TEST(InterfaceImpedance, NormsCanBeEuclidean) {
  FreeFluid fluid;
  const auto tied = fluid.system(&fluid.impedance);
  double sum = 0;
  for (double value : fluid.state.now.fluid) sum += value * value;
  EXPECT_DOUBLE_EQ(tied->size(), std::sqrt(sum));
}

}  // namespace

}  // namespace fsi::test
