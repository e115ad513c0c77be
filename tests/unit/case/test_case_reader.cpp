#include "case/case_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "case/case_keys.hpp"
#include "case/choices.hpp"
#include "linear/policy/solver_policy.hpp"
#include "materials/material.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

using Points = std::vector<std::pair<double, double>>;

TEST(CaseReader, AxisymmetricTwinsDifferFromThePapersCasesInDiscretisationAlone) {
  const fs::path folder = FSI_CASE_FILES;
  for (const char* name : {"neo-hookean.toml", "mooney-rivlin.toml", "artery.toml"}) {
    const auto tube = read_case(folder / name), twin = read_case(folder / "axisymmetric" / name);
    EXPECT_EQ(twin.geometry, Geometry::axisymmetric);
    EXPECT_EQ(twin.element, ElementPair::p2p1);
    EXPECT_EQ(twin.structure->layer_pressure, LayerPressure::separate);
    EXPECT_EQ(twin.mesh.error, 2);
    EXPECT_EQ(twin.fluid->density, tube.fluid->density);
    EXPECT_EQ(twin.fluid->viscosity, tube.fluid->viscosity);
    EXPECT_EQ(twin.structure->density, tube.structure->density);
    EXPECT_EQ(twin.structure->bulk_modulus, tube.structure->bulk_modulus);
    for (const auto& [layer, material] : tube.structure->layers) {
      EXPECT_EQ(twin.structure->layers.at(layer).material, material.material);
      EXPECT_EQ(twin.structure->layers.at(layer).values, material.values);
    }
    EXPECT_EQ(twin.inlet->points, tube.inlet->points);
    EXPECT_EQ(twin.time->steps(), tube.time->steps());
  }
}

TEST(CaseReader, ACaseThatNamesNoElementGetsTheMoreAccurateOne) {
  const auto scene = parse_case(
      "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1\nviscosity = 1\n[inlet]\npressure = 1\n[time]\nstep = 1\nend = "
      "1\n",
      "case.toml");
  EXPECT_EQ(scene.element, ElementPair::p2p1);
}

TEST(CaseReader, ReadsThePapersCases) {
  const fs::path folder = FSI_CASE_FILES;
  const auto neo = read_case(folder / "neo-hookean.toml");
  EXPECT_EQ(neo.element, ElementPair::p1);
  EXPECT_EQ(neo.mesh.level, "coarse");
  ASSERT_TRUE(neo.fluid && neo.structure && neo.inlet && neo.time);
  EXPECT_EQ(neo.fluid->viscosity, 3.5e-3);
  EXPECT_EQ(neo.structure->bulk_modulus, 1e5);
  EXPECT_EQ(neo.structure->layers.at("media").values.at("c10"), 3.0);
  EXPECT_EQ(neo.inlet->points, (Points{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}));
  EXPECT_EQ(neo.time->steps(), 96);
  EXPECT_FALSE(neo.load || neo.static_load);

  for (const char* name : {"neo-hookean.toml", "mooney-rivlin.toml", "artery.toml"}) {
    const auto scene = read_case(folder / name);
    EXPECT_EQ(scene.stabilisation, Stabilisation::paper) << name;
    EXPECT_EQ(scene.structure->stabilisation, 0.5) << name << ": the paper's standard";
    EXPECT_EQ(scene.structure->layer_pressure, LayerPressure::continuous) << name << ": as in the paper";
  }

  const auto rivlin = read_case(folder / "mooney-rivlin.toml");
  EXPECT_EQ(rivlin.structure->layers.at("adventitia").values.at("c01"), 0.2);

  const auto artery = read_case(folder / "artery.toml");
  EXPECT_EQ(artery.structure->layers.at("media").values.at("k1"), 2.3632);
  EXPECT_EQ(artery.structure->layers.at("adventitia").values.at("alpha"), 62.0);
  EXPECT_EQ(artery.structure->layers.at("media").values.count("fibre_scale"), 0u) << "left to its default";
}

const std::string minimal_fluid = R"(
[mesh]
file = "tube.msh"
[fluid]
density = 1
viscosity = 0.01
[inlet]
pressure = [[0, 0], [1, 2.5], [1, 0]]
[time]
step = 0.1
end = 0.3
)";

TEST(CaseReader, FillsInDefaults) {
  const auto scene = parse_case(minimal_fluid, "folder/case.toml");
  EXPECT_EQ(scene.path, "folder/case.toml");
  EXPECT_EQ(scene.mesh.file, "folder/tube.msh");
  EXPECT_EQ(scene.title, "");
  EXPECT_FALSE(scene.structure);
  EXPECT_EQ(scene.inlet->points, (Points{{0, 0}, {1, 2.5}, {1, 0}}));
  EXPECT_EQ(scene.time->steps(), 3);
  EXPECT_TRUE(scene.time->scheme_values.empty());
  EXPECT_EQ(scene.monolithic.linear_solver, "fast");
  EXPECT_EQ(scene.partitioned.max_iterations, 200);
  EXPECT_EQ(scene.output.fields.size(), 3u);
  EXPECT_TRUE(scene.output.energy);
  EXPECT_TRUE(scene.economy.keep_constant_operators);
}

TEST(CaseReader, ReadsEveryKey) {
  const auto scene = parse_case(R"(
title = "all of it"
element = "p1"
[mesh]
level = "fine"
[structure]
density = 1.1
bulk_modulus = 1e7
stabilisation = 0.05
axis_origin = [1, 2, 3]
axis_direction = [0, 1.5, 0]
[structure.layers.inside]
material = "artery"
c10 = 1
k1 = 2
k2 = 3
alpha = 45
fibre_scale = 0.5
[load]
pressure = 4
[time]
step = 0.5
end = 2
scheme = "euler"
newmark_beta = 0.25
newmark_gamma = 0.5
predictor = 2
[newton]
mode = "full"
tolerance = 1e-9
residual_tolerance = 1e-7
max_iterations = 7
[linear]
tolerance = 1e-6
max_iterations = 70
restart = 40
direct_below = 77
[monolithic]
linear_solver = "direct"
[monolithic.multigrid]
cycle = "v"
pre_smoothing = 8
post_smoothing = 0
damping = 0.3
levels = 4
coarsest_nodes = 99
coarsening = "aggregation"
fluid_smoother = "vanka"
wall_smoother = "vanka"
sub_cycle = "v"
sub_smoothing = 3
[partitioned]
scheme = "constant"
tolerance = 1e-5
relaxation = 0.2
max_iterations = 50
absolute_tolerance = 1e-9
force_tolerance = 1e-4
reused_steps = 3
columns = 30
filter = 0.1
linear_solver = "direct"
[output]
fields = []
every = 0
checkpoint_every = 5
energy = false
[economy]
constant_operators = "rebuilt"
)",
                                "case.toml");
  EXPECT_EQ(scene.title, "all of it");
  EXPECT_FALSE(scene.economy.keep_constant_operators);
  EXPECT_EQ(scene.mesh.level, "fine");
  EXPECT_TRUE(scene.mesh.file.empty());
  EXPECT_EQ(scene.structure->stabilisation, 0.05);
  EXPECT_EQ(scene.structure->axis_origin, (Point{1, 2, 3}));
  EXPECT_EQ(scene.structure->axis_direction, (Point{0, 1.5, 0}));
  const auto& layer = scene.structure->layers.at("inside");
  EXPECT_EQ(layer.material, "artery");
  EXPECT_EQ(layer.values.at("k2"), 3);
  EXPECT_EQ(layer.values.at("fibre_scale"), 0.5);
  EXPECT_EQ(scene.load->points, (Points{{0, 4}}));
  EXPECT_EQ(scene.time->scheme, "euler");
  EXPECT_EQ(scene.time->scheme_values.at("newmark_gamma"), 0.5);
  EXPECT_EQ(scene.time->predictor, 2);
  EXPECT_EQ(scene.newton.mode, NewtonMode::full);
  EXPECT_EQ(scene.newton.residual_tolerance, 1e-7);
  EXPECT_EQ(scene.newton.max_iterations, 7);
  EXPECT_EQ(scene.newton.linear_tolerance, 1e-6);
  EXPECT_EQ(scene.linear.krylov.max_iterations, 70);
  EXPECT_EQ(scene.linear.krylov.restart, 40);
  const auto& multigrid = scene.monolithic.multigrid;
  EXPECT_EQ(multigrid.cycle.kind, CoupledCycleKind::v);
  EXPECT_EQ(multigrid.smoothing.pre_smoothing, 8);
  EXPECT_EQ(multigrid.smoothing.post_smoothing, 0);
  EXPECT_EQ(multigrid.smoothing.damping, 0.3);
  EXPECT_EQ(multigrid.coarsening.max_levels, 4);
  EXPECT_EQ(multigrid.coarsening.coarsest_nodes, 99);
  EXPECT_EQ(multigrid.coarsening.kind, CoarseningKind::aggregation);
  EXPECT_EQ(multigrid.sub_problems.fluid_smoother, SaddleSmootherKind::vanka);
  EXPECT_EQ(multigrid.sub_problems.wall_smoother, SaddleSmootherKind::vanka);
  EXPECT_EQ(multigrid.sub_problems.kind, CycleKind::v);
  EXPECT_EQ(multigrid.sub_problems.smoothing, 3);
  EXPECT_EQ(scene.partitioned.relaxation, 0.2);
  EXPECT_EQ(scene.partitioned.absolute_tolerance, 1e-9);
  EXPECT_EQ(scene.partitioned.force_tolerance, 1e-4);
  EXPECT_EQ(scene.partitioned.quasi_newton.reused_steps, 3);
  EXPECT_EQ(scene.partitioned.quasi_newton.columns, 30);
  EXPECT_EQ(scene.partitioned.quasi_newton.filter, 0.1);
  EXPECT_EQ(scene.partitioned.linear_solver, "direct");
  EXPECT_EQ(scene.linear.fast.direct_below, 77);
  EXPECT_EQ(scene.partitioned.fast.direct_below, 77);
  EXPECT_TRUE(scene.output.fields.empty());
  EXPECT_EQ(scene.output.every, 0);
  EXPECT_EQ(scene.output.checkpoint_every, 5);
  EXPECT_FALSE(scene.output.energy);
}

// Version 0.2 had the keys of [newton] and [linear] in [monolithic] and [partitioned].
TEST(CaseReader, ReadsFormerNamesAndSaysSo) {
  const std::string flow =
      "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1\nviscosity = 1\n[inlet]\npressure = 1\n[time]\nstep = 0.5\nend "
      "= 1\n";
  const auto former =
      parse_case(flow +
                     "[monolithic]\nmode = \"full\"\nnewton_tolerance = 1e-9\nerror_tolerance = 1e-4\n"
                     "residual_tolerance = 1e-7\nmax_iterations = 7\nlinear_tolerance = 1e-6\n"
                     "max_linear_iterations = 70\nkrylov_restart = 40\n[partitioned]\ndirect_below = 77\n",
                 "case.toml");
  const auto present = parse_case(flow +
                                      "[newton]\nmode = \"full\"\ntolerance = 1e-9\nerror_tolerance = 1e-4\n"
                                      "residual_tolerance = 1e-7\nmax_iterations = 7\n[linear]\ntolerance = 1e-6\n"
                                      "max_iterations = 70\nrestart = 40\ndirect_below = 77\n",
                                  "case.toml");
  const auto texts = [](const Case& scene) {
    std::string text;
    for (const auto& value : values_of_case(scene)) text += value.key + " = " + value.value + "\n";
    return text;
  };
  EXPECT_EQ(texts(former), texts(present));
  EXPECT_NE(texts(former).find("newton.tolerance = 1e-09\n"), std::string::npos);
  EXPECT_NE(texts(former).find("linear.direct_below = 77\n"), std::string::npos);
  EXPECT_EQ(former.remarks.size(), present.remarks.size() + 9);
  EXPECT_EQ(
      former.remarks.at(1),
      "case.toml:13: monolithic.newton_tolerance: is read as newton.tolerance, which is its name now; this one is "
      "valid in this version for the last time");
  EXPECT_TRUE(present.remarks.empty());
}

// What is set stands above what the file says, whichever name either uses.
TEST(CaseReader, SetsKeysUnderEitherName) {
  const std::string flow =
      "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1\nviscosity = 1\n[inlet]\npressure = 1\n[time]\nstep = 0.5\nend "
      "= 1\n";
  const auto tolerance = [&](const std::string& more, const std::vector<std::string>& set) {
    return parse_case(flow + more, "case.toml", set).newton.tolerance;
  };
  const std::string former = "[monolithic]\nnewton_tolerance = 1e-5\n", present = "[newton]\ntolerance = 1e-6\n";
  EXPECT_EQ(tolerance(former, {"newton.tolerance=1e-3"}), 1e-3);
  EXPECT_EQ(tolerance(present, {"monolithic.newton_tolerance=1e-4"}), 1e-4);
  EXPECT_EQ(tolerance(former, {"monolithic.newton_tolerance=1e-4"}), 1e-4);
  EXPECT_EQ(tolerance("", {"monolithic.newton_tolerance=1e-4"}), 1e-4);
  EXPECT_THROW(tolerance(former + present, {}), InputError);
  EXPECT_THROW(tolerance("", {"monolithic.newton_tolerance=1e-4", "newton.tolerance=1e-4"}), InputError);
}

TEST(CaseReader, ReadsAStaticWall) {
  const auto scene = parse_case(
      "mesh.level = 'coarse'\nload.pressure = 2.0\nstatic.load_steps = 5\n"
      "structure = { density = 1, bulk_modulus = 10, layers.w = { material = 'neo-hookean', c10 = 1 } }\n",
      "case.toml");
  EXPECT_EQ(scene.static_load->load_steps, 5);
  EXPECT_EQ(scene.load->at_end(), 2.0);
  EXPECT_EQ(scene.structure->layers.count("w"), 1u);
}

// By the estimated error where later steps see what one leaves, by increments elsewhere and where the case says so.
TEST(CaseReader, ChoosesWhenAStepIsSolved) {
  const std::string flow =
      "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1\nviscosity = 1\n[inlet]\npressure = 1\n[time]\nend = 1\n";
  const auto demanded = [&](const std::string& more) {
    return parse_case(flow + more, "case.toml").newton.error_tolerance;
  };
  EXPECT_EQ(demanded("step = 0.5\n"), NewtonStandards::error_tolerance);
  EXPECT_EQ(demanded("step = 0.5\n[newton]\nmax_iterations = 9\n"), NewtonStandards::error_tolerance);
  EXPECT_EQ(demanded("step = 0.5\n[newton]\ntolerance = 1e-5\n"), 0);
  EXPECT_EQ(demanded("step = 0.5\n[newton]\nerror_tolerance = 0.1\n"), 0.1);
  EXPECT_EQ(demanded("step = 0.5\n[newton]\nerror_tolerance = 0\n"), 0);
  EXPECT_EQ(demanded("step = \"adaptive\"\n"), 0);
  const auto wall = parse_case(
      "mesh.level = 'coarse'\nload.pressure = 2.0\ntime = { step = 0.5, end = 1 }\n"
      "structure = { density = 1, bulk_modulus = 10, layers.w = { material = 'neo-hookean', c10 = 1 } }\n",
      "case.toml");
  EXPECT_EQ(wall.newton.error_tolerance, NewtonStandards::error_tolerance_of_wall);
  EXPECT_EQ(read_case(fs::path(FSI_CASE_FILES) / "neo-hookean.toml").newton.error_tolerance, 0);
}

TEST(CaseReader, OverridesEntries) {
  const auto scene =
      parse_case(minimal_fluid, "case.toml",
                 {"fluid.density=2", "title=no quotes needed", "output.fields=[\"pressure\"]", "newton.mode=full",
                  "inlet.pressure=3.5", " inlet.until = 0.2 ", "time.end=0.4", "time.end=0.5"});
  EXPECT_EQ(scene.fluid->density, 2);
  EXPECT_EQ(scene.title, "no quotes needed");
  EXPECT_EQ(scene.output.fields, std::vector<std::string>{"pressure"});
  EXPECT_EQ(scene.newton.mode, NewtonMode::full);
  EXPECT_EQ(scene.inlet->points, (Points{{0, 3.5}, {0.2, 3.5}, {0.2, 0}}));
  EXPECT_EQ(scene.time->steps(), 5);
}

TEST(CaseReader, OverriddenEntriesReplaceTheirRivals) {
  const auto other_level = parse_case(minimal_fluid, "case.toml", {"mesh.level=fine"});
  EXPECT_EQ(other_level.mesh.level, "fine");
  EXPECT_TRUE(other_level.mesh.file.empty());
  const auto by_error = parse_case(minimal_fluid, "case.toml", {"mesh.error=2.5 %"});
  EXPECT_EQ(by_error.mesh.error, 2.5);
  EXPECT_TRUE(by_error.mesh.file.empty());
  auto recommended = minimal_fluid;  // which waves the error holds for goes with the error
  const std::string file = "file = \"tube.msh\"";
  ASSERT_NE(recommended.find(file), std::string::npos);
  recommended.replace(recommended.find(file), file.size(), "error = \"10%\"\nwaves = \"resolved\"");
  const auto by_file = parse_case(recommended, "case.toml", {"mesh.file=other.msh"});
  EXPECT_EQ(by_file.mesh.file, "other.msh");
  EXPECT_EQ(by_file.mesh.error, 0);
  EXPECT_EQ(parse_case(recommended, "case.toml", {"mesh.level=coarse"}).mesh.level, "coarse");

  auto pulse = minimal_fluid;
  const std::string table = "pressure = [[0, 0], [1, 2.5], [1, 0]]";
  pulse.replace(pulse.find(table), table.size(), "pressure = 1\nuntil = 2");
  const auto with_table = parse_case(pulse, "case.toml", {"inlet.pressure=[[0, 0], [1, 1]]"});
  EXPECT_EQ(with_table.inlet->points, (Points{{0, 0}, {1, 1}}));
  const auto with_number = parse_case(pulse, "case.toml", {"inlet.pressure=7"});
  EXPECT_EQ(with_number.inlet->points, (Points{{0, 7}, {2, 7}, {2, 0}}));
}

TEST_F(FolderTest, CaseReaderLooksForAnOverriddenMeshInTheWorkingDirectoryFirst) {
  const auto back = fs::current_path();
  write_text(folder_ / "here.msh", "");
  fs::create_directories(folder_ / "cases");
  write_text(folder_ / "cases" / "case.toml", minimal_fluid);
  fs::current_path(folder_);
  const auto here = read_case("cases/case.toml", {"mesh.file=here.msh"});
  const auto there = read_case("cases/case.toml", {"mesh.file=there.msh"});
  const auto unchanged = read_case("cases/case.toml");
  fs::current_path(back);
  EXPECT_EQ(here.mesh.file, "here.msh");
  EXPECT_EQ(there.mesh.file, "cases/there.msh");
  EXPECT_EQ(unchanged.mesh.file, "cases/tube.msh");
}

TEST_F(FolderTest, CaseReaderLooksForAnOverriddenPrestressThereToo) {
  const auto back = fs::current_path();
  write_text(folder_ / "prestress.h5", "");
  fs::create_directories(folder_ / "cases");
  write_text(folder_ / "cases" / "case.toml",
             "mesh.file = \"a.msh\"\nstatic.load_steps = 1\nload.pressure = 1\nstructure = { density = 1, "
             "bulk_modulus = 1e5, layers.w = { material = \"neo-hookean\", c10 = 3 } }\n[prestress]\npressure = 1\n"
             "file = \"prestress.h5\"\n");
  fs::current_path(folder_);
  const auto here = read_case("cases/case.toml", {"prestress.file=prestress.h5"});
  const auto unchanged = read_case("cases/case.toml");
  fs::current_path(back);
  EXPECT_EQ(here.prestress->file, "prestress.h5");
  EXPECT_EQ(unchanged.prestress->file, "cases/prestress.h5");
}

TEST(CaseReader, FieldsOfAnyCaseCanBeSwitchedOff) {
  const std::string scene = minimal_fluid + "[output]\ninterval = 0.5\n";
  EXPECT_EQ(parse_case(scene, "case.toml", {"output.every=0"}).output.every, 0);
}

TEST(CaseReader, HelpNamesTheKeysOfEverySection) {
  const auto help = case_keys_help();
  for (const auto* key :
       {"mesh.file", "fluid.viscosity", "structure.layers.NAME.c10", "structure.layers.NAME.CONSTANT.unit",
        "structure.layers.NAME.CONSTANT.length_unit", "inlet.until", "time.step", "static.load_steps", "newton.mode",
        "partitioned.scheme", "output.every", "economy.constant_operators"})
    EXPECT_NE(help.find(key), std::string::npos) << key;
}

TEST(CaseReader, HelpHasUnitsNamesAndDefaultsFromWhereTheyAreOwned) {
  const auto help = case_keys_help();
  const auto line = [&](const std::string& key) {
    const auto begin = help.find(" " + key + " ");
    return begin == std::string::npos ? std::string() : help.substr(begin, help.find('\n', begin) - begin);
  };
  const auto says = [&](const std::string& key, const std::string& text) {
    EXPECT_NE(line(key).find(text), std::string::npos) << line(key) << "\nlacks: " << text;
  };
  says("fluid.density", "mg/mm^3");
  says("linear.direct_below", fmt::format("default {}", SolverPolicy::standard_limit(SolvedSystem::jacobian, 3)));
  says("linear.restart", fmt::format("default {}", KrylovOptions().restart));
  says("newton.max_iterations", fmt::format("default {}", NewtonOptions().max_iterations));
  says("partitioned.columns", fmt::format("default {}", QuasiNewtonOptions().columns));
  says("monolithic.multigrid.cycle", "v, w (default) or k");
  for (const auto& name : linear_solver_names()) says("monolithic.linear_solver", name);
  for (const auto& name : coupling_scheme_names()) says("partitioned.scheme", name);
  for (const auto& [name, kind] : materials().rows())
    for (const auto& parameter : kind.parameters) {
      const auto found = help.find(name + ": " + parameter.about);
      ASSERT_NE(found, std::string::npos) << name << " " << parameter.name;
      const std::string unit = parameter.quantity->unit;
      if (!unit.empty()) {
        EXPECT_EQ(help.substr(found + name.size() + 2 + parameter.about.size(), 4 + unit.size()), " in " + unit);
      }
    }
  EXPECT_EQ(help.find("{}"), std::string::npos) << "a default that nobody filled in";
  EXPECT_EQ(help.find("{unit}"), std::string::npos);
}

TEST(CaseReader, EveryMaterialIsReadFromItsDeclaration) {
  for (const auto& [name, kind] : materials().rows())
    for (const auto& set : kind.sets.empty() ? ParameterSets{{}} : kind.sets) {
      std::string layer = "structure.layers.w.material = '" + name + "'\n";
      ParameterValues given;
      for (const auto& parameter : kind.parameters) {
        if (parameter.of_a_set && std::find(set.begin(), set.end(), parameter.name) == set.end()) continue;
        const double free = 2.5 + 0.5 * static_cast<double>(given.size());
        given[parameter.name] = parameter.bounds.contains(free) ? free : 0.25;
        layer += fmt::format("structure.layers.w.{} = {}\n", parameter.name, given[parameter.name]);
      }
      if (needs_bulk_modulus(make_material(name, given))) layer += "structure.bulk_modulus = 10\n";
      const auto scene = parse_case(
          "mesh.level = 'coarse'\nload.pressure = 2.0\nstatic.load_steps = 5\nstructure.density = 1\n" + layer,
          "case.toml");
      EXPECT_EQ(scene.structure->layers.at("w").material, name);
      EXPECT_EQ(scene.structure->layers.at("w").values, given) << name;
    }
}

}  // namespace

}  // namespace fsi::test
