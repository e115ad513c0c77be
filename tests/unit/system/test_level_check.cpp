// The end of a step is looked at before it becomes a level: with the midpoint rule it is extrapolated.

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "support/scenes.hpp"
#include "system/level_check.hpp"

namespace fsi::test {

namespace {

struct Squeezed {
  Squeezed() : setup(coupled_case("neo-hookean")), mesh(fluid_and_wall_box(2)) {
    setup.fluid.reset();
    setup.inlet.reset();
    // With ln J, which a folded element has not.
    for (auto& [name, layer] : setup.structure->layers)
      layer = layer_of("compressible-neo-hookean", {{"young", 300.0}, {"poisson", 0.4}});
    setup.load = PressureTable{{{0.0, 1.0}}};
    setup.time->scheme = "midpoint";
    setup.time->scheme_values["damping"] = 0;  // theta is 1/2
    scene = build_scene<P1Tetrahedron>(setup, mesh);
  }
  /// Takes a balance at which the wall is `part` shorter along z, and so 2 part at the step's end.
  void take(State& state, double part) {
    StepData data;
    data.time = 0.01;
    data.rates = scene->integrator->rates(state, data.time);
    for (int a = 0; a < scene->wall->node_count(); ++a)
      state.now.wall[MixedLayout<3>::vector(a, 2)] = -part * scene->wall->nodes().nodes[static_cast<std::size_t>(a)][2];
    State spare;
    accept_level(*scene, data, state, spare, report);
  }
  Case setup;
  TetrahedralMesh mesh;
  std::unique_ptr<Scene<3>> scene;
  StepReport report;
};

TEST(LevelCheck, TakesASoundLevel) {
  Squeezed squeezed;
  State state = squeezed.scene->at_rest();
  squeezed.take(state, 0.2);
  EXPECT_EQ(state.step, 1);
  ASSERT_EQ(squeezed.report.wall.size(), squeezed.setup.structure->layers.size());
  for (const auto& layer : squeezed.report.wall) {
    EXPECT_NEAR(layer.least.value, 0.6, 1e-12);
    EXPECT_NEAR(layer.greatest.value, 1, 1e-12);
  }
}

TEST(LevelCheck, NamesStepTimeAndFieldAndLeavesTheStateAsItWas) {
  Squeezed squeezed;
  State state = squeezed.scene->at_rest();
  const State before = state;
  std::string said;
  try {
    squeezed.take(state, 0.7);  // 30 % of its height at the balance, folded at the end
  } catch (const ConvergenceError& failure) {
    said = failure.what();
  }
  EXPECT_NE(said.find("step 1 (to t = 0.01 ms)"), std::string::npos) << said;
  EXPECT_NE(said.find("the wall is folded near ("), std::string::npos) << said;
  EXPECT_NE(said.find("where det F is -0.4"), std::string::npos) << said;
  EXPECT_EQ(state.step, 0);
  EXPECT_EQ(state.time, before.time);
  EXPECT_EQ(state.before[0].wall, before.before[0].wall);
}

}  // namespace

}  // namespace fsi::test
