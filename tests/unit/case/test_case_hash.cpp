#include "case/case_hash.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "case/case_reader.hpp"

namespace fsi::test {

namespace {

Case example() {
  Case scene;
  scene.fluid = FluidData{1.0, 3.5e-3};
  scene.structure.emplace();
  scene.structure->layers["media"] = {"neo-hookean", {{"c10", 3.0}}};
  scene.inlet = PressureTable{{{0, 1.332}}};
  scene.time = TimeData{0.125, 12.0, 1};
  return scene;
}

TEST(CaseHash, IgnoresWhatMayChangeOnRestart) {
  auto scene = example();
  const auto hash = hash_of_case(scene);
  scene.title = "extended";
  scene.time->end = 24.0;
  scene.time->step = 0.0625;
  scene.time->predictor = 0;
  scene.mesh.file = "elsewhere.msh";
  scene.output.every = 1;
  scene.partitioned.relaxation = 0.1;
  scene.newton.mode = NewtonMode::full;
  scene.linear.fast.direct_below = 1;
  scene.economy.keep_constant_operators = false;
  EXPECT_EQ(hash_of_case(scene), hash);
}

TEST(CaseHash, NoticesWhatChangesTheEquations) {
  const auto hash = hash_of_case(example());
  const auto changed = [&](auto change) {
    auto scene = example();
    change(scene);
    return hash_of_case(scene) != hash;
  };
  EXPECT_TRUE(changed([](Case& c) { c.fluid->density += 1e-15; }));
  EXPECT_TRUE(changed([](Case& c) { c.structure->layers["media"].values["c10"] = 3.1; }));
  EXPECT_TRUE(changed([](Case& c) { c.structure->layers["adventitia"] = c.structure->layers["media"]; }));
  EXPECT_TRUE(changed([](Case& c) { c.inlet->points[0].second = 1; }));
  EXPECT_TRUE(changed([](Case& c) { c.time->scheme_values["newmark_gamma"] = 0.5; }));
  EXPECT_TRUE(changed([](Case& c) {
    c.time.reset();
    c.static_load = StaticData{};
  }));
  EXPECT_TRUE(changed([](Case& c) { c.mesh_motion.method = MeshMotionMethod::stiffened; }));
  EXPECT_TRUE(changed([](Case& c) { c.structure.reset(); }));
}

TEST(CaseHash, KeepsTheStepsApart) {
  auto scene = example();
  const auto hash = hash_of_case(scene);
  scene.time->step = 0.0625;
  EXPECT_EQ(hash_of_case(scene), hash);

  Case wall = example();
  wall.time.reset();
  wall.static_load = StaticData{7};
  const auto of_wall = hash_of_case(wall);
  EXPECT_NE(of_wall, hash);
  wall.static_load->load_steps = 9;
  EXPECT_EQ(hash_of_case(wall), of_wall);
}

TEST(CaseHash, LeavesOutWhatTheRunDoesNotRead) {
  auto scene = example();
  scene.element = ElementPair::p2p1;
  const auto hash = hash_of_case(scene);
  scene.fluid->grad_div = true;
  scene.structure->stabilisation = 0.25;
  scene.stabilisation = Stabilisation::paper;
  EXPECT_EQ(hash_of_case(scene), hash) << "Taylor-Hood elements have no stabilisation";
  scene.element = ElementPair::p1;
  EXPECT_NE(hash_of_case(scene), hash);
}

TEST(CaseHash, TellsHowCasesDiffer) {
  auto scene = example();
  const auto before = readable_dump(scene);
  EXPECT_EQ(difference_of_cases(before, before), "");
  scene.fluid->density = 2;
  EXPECT_EQ(difference_of_cases(before, readable_dump(scene)), "fluid.density was 1 and is 2");
  scene.structure.reset();
  const auto said = difference_of_cases(before, readable_dump(scene));
  EXPECT_EQ(said.rfind("fluid.density was 1 and is 2, and so on for ", 0), 0u) << said;
  scene = example();
  for (int i = 0; i < 100; ++i) scene.inlet->points.emplace_back(i, 1.0 / 3);
  const auto dump = readable_dump(scene);
  EXPECT_LT(dump.size(), 2000u);
  scene.inlet->points.back().second = 1;
  EXPECT_NE(difference_of_cases(dump, readable_dump(scene)), "") << "long values differ by their hash";
  EXPECT_EQ(difference_of_cases("", before).rfind("element was not there and is p2p1", 0), 0u);
}

TEST(CaseHash, DoesNotDependOnHowACaseIsWritten) {
  const std::string start =
      "element = 'p1'\nmesh.level = 'coarse'\nload.pressure = 2\nstructure.density = 1\nstructure.bulk_modulus = 10\n"
      "structure.layers.w = { material = 'neo-hookean', c10 = 1 }\n";
  const auto hash = [](const std::string& text) { return hash_of_case(parse_case(text, "case.toml")); };
  const auto given = hash(start + "static.load_steps = 10\nstructure.stabilisation = 0.5\ntitle = 'a'\n");
  EXPECT_EQ(hash("# a comment\n" + start + "[static]\n"), given) << "defaults count as if they were given";
  EXPECT_NE(hash(start + "structure.stabilisation = 0.25\n[static]\n"), given);
  EXPECT_NE(hash("stabilisation = 'paper'\n" + start + "structure.stabilisation = 0.5\n[static]\n"), given);
  EXPECT_EQ(hash(start + "structure.layer_pressure = 'separate'\n[static]\n"), given);
  EXPECT_NE(hash(start + "structure.layer_pressure = 'continuous'\nstructure.stabilisation = 0.5\n[static]\n"), given);
}

/// Every key that can be given but for those of solvers, output and the like is part of the hash: nobody lists them.
TEST(CaseHash, HasEveryKeyOfThePhysics) {
  const auto scene = parse_case(R"(
element = "p1"
mesh.level = "coarse"
fluid = { density = 1, viscosity = 2, grad_div = true }
inlet.pressure = 4
[structure]
density = 1.1
bulk_modulus = 1e4
[structure.layers.inside]
material = "artery"
c10 = 1
k1 = 2
k2 = 3
alpha = 45
[time]
step = 0.5
end = 2
)",
                                "case.toml");
  const std::string expected = R"(element = p1
geometry = 3d
stabilisation = projected
fluid.density = 1
fluid.viscosity = 2
fluid.outlet = true
fluid.grad_div = true
structure.density = 1.1
structure.bulk_modulus = 10000
structure.stabilisation = 0.5
structure.layer_pressure = separate
structure.fibre_frame = cylinder
structure.gravity = [0, 0, 0]
structure.axis_origin = [0, 0, 0]
structure.axis_direction = [0, 0, 1]
structure.layers.inside.material = artery
structure.layers.inside.c10 = 1
structure.layers.inside.k1 = 2
structure.layers.inside.k2 = 3
structure.layers.inside.alpha = 45
structure.layers.inside.fibre_scale = 1
structure.layers.inside.kappa = 0
inlet.pressure = [[0, 4]]
time.scheme = chosen
time.damping = chosen
time.spectral_radius = 0.5
time.newmark_beta = 1
time.newmark_gamma = 1
mesh_motion.method = harmonic
mesh_motion.size_exponent = 1
mesh_motion.distance_exponent = 1
mesh_motion.poisson = 0
)";
  EXPECT_EQ(canonical_dump(scene), expected);
}

TEST(Hash, HasThePublishedValues) {
  // From the test suite of the algorithm's authors, http://www.isthe.com/chongo/src/fnv/test_fnv.c
  Fnv1a empty, a, foobar;
  a.add("a");
  foobar.add("foo");
  foobar.add("bar");
  EXPECT_EQ(empty.hex(), "cbf29ce484222325");
  EXPECT_EQ(a.hex(), "af63dc4c8601ec8c");
  EXPECT_EQ(foobar.hex(), "85944171f73967e8");
}

}  // namespace

}  // namespace fsi::test
