// Load steps that find no solution, or one off the path, are halved, and return to their grid.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "diagnostics/load_path.hpp"
#include "fem/elements.hpp"
#include "run/step_controller.hpp"
#include "support/element_meshes.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"

namespace fsi::test {

namespace {

/// A cube that hangs on a face, pulled at the other by 1 kPa in load steps.
struct PulledCube {
  explicit PulledCube(int load_steps) {
    auto mesh = irregular_mesh<P1Tetrahedron>(1, "wall");
    name_boundary(mesh, "low", [](const Point& x) { return std::abs(x[2]) < 1e-9; });
    name_boundary(mesh, "high", [](const Point& x) { return std::abs(x[2] - 1) < 1e-9; });
    setup.structure = StructureData{};
    setup.structure->density = 1;
    setup.structure->bulk_modulus = 1e3;
    setup.structure->layers["wall"] = layer_of("neo-hookean", {{"c10", 100.0}});
    setup.supports["low"].fixed = {"x", "y", "z"};
    for (const double t : {0.0, 0.0, 1.0}) setup.supports["high"].traction.push_back(PressureTable{{{0.0, t}}});
    setup.static_load = StaticData{load_steps};
    scene = build_scene<P1Tetrahedron>(setup, mesh);
  }
  Case setup;
  std::unique_ptr<Scene<3>> scene;
};

/// Stands for a solver: comes to a uniform stretch that a function of the load and of the length of the step says.
class Answers : public Stepper {
 public:
  using Function = std::function<double(double load, double length)>;
  Answers(const Scene<3>& scene, const Loads& loads, Function stretch, bool strays)
      : scene_(scene), loads_(loads), stretch_(std::move(stretch)), strays_(strays) {}

  StepReport advance(State& state) override {
    const double load = loads_.time_of(state.step + 1);
    taken.push_back(load);
    const double stretch = stretch_(load, load - state.time);
    if (std::isnan(stretch)) throw ConvergenceError("no solution", "another");
    for (int a = 0; a < scene_.wall->node_count(); ++a)
      state.now.wall[MixedLayout<3>::vector(a, 2)] =
          (stretch - 1) * scene_.wall->nodes().nodes[static_cast<std::size_t>(a)][2];
    state.finish_step(load);
    report_ = {};
    report_.strayed = strays_;
    return report_;
  }
  void keep(RestartArchive&) override {}

  std::vector<double> taken;

 private:
  const Scene<3>& scene_;
  const Loads& loads_;
  Function stretch_;
  bool strays_;
};

/// What a march did.
struct Marched {
  std::vector<double> levels;  ///< of the load
  std::string failure;
  Attempts attempts;
};

Marched march(PulledCube& cube, const Answers::Function& stretch, bool strays,
              std::vector<std::string>* said = nullptr) {
  Loads loads(cube.setup);
  Answers stepper(*cube.scene, loads, stretch, strays);
  StepController<3> march(cube.setup, *cube.scene, stepper, loads, [said](const std::string& line) {
    if (said != nullptr) said->push_back(line);
  });
  State state = cube.scene->at_rest();
  Marched marched;
  try {
    while (state.step < loads.steps()) {
      march.step(state);
      marched.levels.push_back(state.time);
    }
  } catch (const ConvergenceError& failure) {
    marched.failure = failure.what();
  }
  marched.attempts = march.attempts();
  return marched;
}

constexpr double young = 400.0 / 3;  // so that energy and work agree at small strains: the pressure is left at zero
double sound(double load, double) {
  return 1 + load / young;
}

TEST(LoadSteps, OneThatFailsIsHalvedAndTheGridIsMetAgain) {
  PulledCube cube(2);
  cube.setup.static_load->check_path = false;
  const auto fails_beyond = [](double load, double length) {
    return length > 0.2 && load > 0.6 ? NAN : sound(load, 0);
  };
  const Marched marched = march(cube, fails_beyond, false);
  EXPECT_EQ(marched.failure, "");
  EXPECT_EQ(marched.levels, (std::vector<double>{0.5, 0.625, 0.75, 0.875, 1}));
}

TEST(LoadSteps, HalvingHasAnEnd) {
  PulledCube cube(1);
  cube.setup.static_load->retries = 3;
  const auto fails = [](double load, double) { return load > 0.3 ? NAN : sound(load, 0); };
  const Marched marched = march(cube, fails, false);
  EXPECT_EQ(marched.levels, (std::vector<double>{0.25}));  // the next would end at 0.375, an eighth of the load behind
  EXPECT_NE(marched.failure.find("no solution"), std::string::npos);
  cube.setup.static_load->retries = 0;
  EXPECT_TRUE(march(cube, fails, false).levels.empty());
}

TEST(LoadSteps, ADoubtedOneStandsWhereItsHalvesComeToTheSameState) {
  PulledCube cube(2);
  const Marched marched = march(cube, sound, true);
  EXPECT_EQ(marched.failure, "");
  EXPECT_EQ(marched.levels, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(marched.attempts.checked, 2);
  EXPECT_EQ(marched.attempts.failed, 0);
}

TEST(LoadSteps, ADoubtedOneIsHalvedWhereItsHalvesComeToAnotherState) {
  PulledCube cube(2);
  const auto jumps = [](double load, double length) {
    return sound(load, 0) + (length > 0.3 ? 0.1 * load / young : 0);
  };
  const Marched marched = march(cube, jumps, true);
  EXPECT_EQ(marched.failure, "");
  EXPECT_EQ(marched.levels, (std::vector<double>{0.25, 0.5, 0.75, 1}));
  cube.setup.static_load->check_path = false;
  EXPECT_EQ(march(cube, jumps, true).levels, (std::vector<double>{0.5, 1}));
}

TEST(LoadSteps, StatesThatDependOnTheLengthOfStepsForEverAreNoSolution) {
  PulledCube cube(2);
  const auto erratic = [](double load, double length) { return 1 + load / young * (1 + 0.1 * std::log(length)); };
  const Marched marched = march(cube, erratic, true);
  EXPECT_NE(marched.failure.find("they come to another state"), std::string::npos) << marched.failure;
  EXPECT_NE(marched.failure.find("more static.load_steps"), std::string::npos);
}

TEST(LoadSteps, EnergyThatDoesNotFollowTheLoadIsDoubtedAndSaid) {
  PulledCube cube(2);
  std::vector<std::string> said;
  EXPECT_EQ(march(
                cube, [](double load, double) { return 1 - 5 * load / young; }, false, &said)
                .attempts.checked,
            2);
  ASSERT_EQ(said.size(), 2u);  // pressed where it is pulled: the halves agree, the energy does not
  EXPECT_NE(said[0].find("the wall's elastic energy changes by"), std::string::npos);
}

TEST(LoadPath, StableStepsLieBetweenTheWorksOfTheirLoads) {
  EXPECT_EQ((LoadPathEnergy{1.5, 1, 2}).excess(), 0);
  EXPECT_EQ((LoadPathEnergy{-1.5, -1, -2}).excess(), 0);  // unloading
  EXPECT_DOUBLE_EQ((LoadPathEnergy{2.5, 1, 2}).excess(), 0.2);
  EXPECT_DOUBLE_EQ((LoadPathEnergy{-1, 0, 1}).excess(), 1);
  EXPECT_EQ((LoadPathEnergy{0, 0, 0}).excess(), 0);
  EXPECT_FALSE((LoadPathEnergy{NAN, 0, 1}).follows_the_load());
}

TEST(LoadPath, OfAStretchedCube) {
  PulledCube cube(2);
  const Loads loads(cube.setup);
  Answers stepper(*cube.scene, loads, sound, false);
  State before = cube.scene->at_rest();
  stepper.advance(before);
  State after = before;
  stepper.advance(after);
  const LoadPathEnergy energy = load_path_energy(*cube.scene, loads, 2, before, after);
  // 0.5 and 1 kPa on 1 mm^2 along 0.5 / young mm.
  EXPECT_NEAR(energy.work_before, 0.25 / young, 1e-15);
  EXPECT_NEAR(energy.work_after, 0.5 / young, 1e-15);
}

}  // namespace

}  // namespace fsi::test
