#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case_reader.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

/// All in the right units, one key a line.
const std::string good_case = R"(element = "p1"
[mesh]
level = "coarse"
[fluid]
density = 1.06
viscosity = 3.5e-3
[structure]
density = 1.2
bulk_modulus = 1e5
[structure.layers.media]
material = "artery"
c10 = 3.0
k1 = 2.4
k2 = 0.8
alpha = 29
[structure.layers.adventitia]
material = "neo-hookean"
c10 = 0.3
[inlet]
pressure = 1.332
until = 0.125
[time]
step = 0.125
end = 12
)";

Lines warnings_with(const Lines& settings) {
  return parse_case(good_case, "case.toml", settings).warnings;
}

TEST(UnitWarnings, NameTheUnitAndTheValueThatWasMeant) {
  auto text = good_case;
  text.replace(text.find("1.06"), 4, "1060");
  EXPECT_EQ(parse_case(text, "case.toml").warnings,
            Lines{"case.toml:5: fluid.density: 1060 looks like a value in kg/m^3; did you mean 1.06 mg/mm^3?"});
  EXPECT_EQ(warnings_with({"inlet.pressure=1332"}),
            Lines{"--set: inlet.pressure: 1332 looks like a value in Pa; did you mean 1.33 kPa?"});
  EXPECT_EQ(
      warnings_with({"structure.layers.media.alpha=0.5"}),
      Lines{"--set: structure.layers.media.alpha: 0.5 looks like a value in radians; did you mean 28.6 degrees?"});
}

struct Slip {
  const char *setting, *unit, *meant;
};

TEST(UnitWarnings, ComeForTheUsualSlips) {
  for (const auto& slip :
       {Slip{"fluid.density=1000", "kg/m^3", "1 mg/mm^3"}, Slip{"fluid.density=1.05e-3", "g/mm^3", "1.05 mg/mm^3"},
        Slip{"fluid.density=1.06e-9", "t/mm^3", "1.06 mg/mm^3"},
        Slip{"fluid.viscosity=3.5", "mPa s (centipoise)", "0.0035 kPa ms"},
        Slip{"fluid.viscosity=4e-6", "kPa s", "0.004 kPa ms"}, Slip{"structure.bulk_modulus=1e8", "Pa", "1e+05 kPa"},
        Slip{"structure.bulk_modulus=2.2e9", "Pa", "2.2e+06 kPa"},
        Slip{"structure.layers.media.c10=3e5", "Pa", "300 kPa"},
        Slip{"structure.layers.media.k1=1e6", "Pa", "1e+03 kPa"}, Slip{"inlet.pressure=120", "mmHg", "16 kPa"},
        Slip{"inlet.pressure=-1332", "Pa", "-1.33 kPa"}, Slip{"inlet.pressure=13332", "Pa", "13.3 kPa"},
        Slip{"inlet.pressure=133320", "dyn/cm^2", "13.3 kPa"}, Slip{"inlet.until=1.25e-4", "s", "0.125 ms"}}) {
    const auto said = warnings_with({slip.setting});
    ASSERT_EQ(said.size(), 1u) << slip.setting;
    EXPECT_NE(said[0].find(fmt::format("looks like a value in {}; did you mean {}?", slip.unit, slip.meant)),
              std::string::npos)
        << said[0];
  }
  const auto seconds = warnings_with({"time.step=1.25e-4", "time.end=0.012"});
  ASSERT_EQ(seconds.size(), 1u);
  EXPECT_NE(seconds[0].find("time.step: 0.000125 looks like a value in s; did you mean 0.125 ms?"), std::string::npos);
}

/// A block under a load from outside.
Lines warnings_of_block(const std::string& layer, double traction) {
  return parse_case(fmt::format(R"(mesh.file = "block.msh"
static.load_steps = 5
structure = {{ density = 1, bulk_modulus = 1e5, layers.w = {{ {} }} }}
support.pull.traction = [0, 0, {}]
)",
                                layer, traction),
                    "case.toml")
      .warnings;
}

TEST(UnitWarnings, OfPressuresAskWhatTheWallBears) {
  const std::string stiff = R"(material = "artery", c10 = 7.64, k1 = 996.6, k2 = 524.6, alpha = 49.98)";
  EXPECT_EQ(warnings_of_block(stiff, 200), Lines{});
  EXPECT_EQ(warnings_of_block(stiff, 1333.333), Lines{});
  const Lines said = warnings_of_block(R"(material = "neo-hookean", c10 = 3)", 200);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("200 looks like a value in mmHg; did you mean 26.7 kPa?"), std::string::npos) << said[0];
  // In a vessel of R / h = 5 the strain is five times p / E: 200 kPa are half of it at 2,000 kPa.
  EXPECT_EQ(warnings_with({"structure.layers.media.c10=600", "inlet.pressure=200"}), Lines{});
  EXPECT_EQ(warnings_with({"structure.layers.media.c10=60", "inlet.pressure=200"}).size(), 1u);
}

TEST(UnitWarnings, OfTractionsInTablesComeOnce) {
  const Lines said = parse_case(R"(mesh.file = "block.msh"
time = { step = 1, end = 4 }
structure = { density = 1, bulk_modulus = 1e5, layers.w = { material = "neo-hookean", c10 = 3 } }
support.pull.traction = [[0, 0, 0, 0], [2, 0, 200, 0], [4, 0, 200, 200]]
)",
                                "case.toml")
                         .warnings;
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("support.pull.traction[1][2]: 200 looks like a value in mmHg; did you mean 26.7 kPa?"),
            std::string::npos)
      << said[0];
}

class PaintedConstants : public FolderTest {};

/// More than a pascal could be, and no other unit's typical value.
TEST_F(PaintedConstants, OfTensOfMillionsLookLikeDynes) {
  write_text(folder_ / "stiffness.csv", "x,y,z,c10\n0,0,0,2e7\n1,0,0,2e7\n");
  auto text = good_case;
  const std::string constant = "c10 = 3.0";
  text.replace(text.find(constant), constant.size(), R"(c10 = { file = "stiffness.csv", field = "c10" })");
  const Lines said = parse_case(text, folder_ / "case.toml").warnings;
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("2e+07 looks like a value in dyn/cm^2; did you mean 2000 kPa?"), std::string::npos) << said[0];
}

TEST(UnitWarnings, OfLongStepsAskWhatAPeriodHas) {
  EXPECT_EQ(warnings_with({"time.step=100", "time.end=12000"}), Lines{});
  const auto opened = [](double period) {
    return parse_case(good_case + fmt::format("[[opening]]\nsurface = \"outlet\"\nflow_rate = [[0, 0], [{0}, 1], [{1}, "
                                              "0]]\nperiod = {1}\n",
                                              period / 2, period),
                      "case.toml", {"time.step=125", "time.end=12000"})
        .warnings;
  };
  EXPECT_EQ(opened(800), Lines{});
  EXPECT_EQ(opened(400),
            Lines{"--set: time.step: 125 ms are 0.312 of the period of 400 ms, which looks like a step in us; did you "
                  "mean 0.125 ms?"});
}

TEST(UnitWarnings, DoubtTheWallsDensityOnlyWithoutAFluidInTheRightUnit) {
  EXPECT_EQ(warnings_with({"structure.density=1200"}), Lines{}) << "a study of the added mass";
  const auto both = warnings_with({"fluid.density=1060", "structure.density=1200"});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1], "--set: structure.density: 1200 looks like a value in kg/m^3; did you mean 1.2 mg/mm^3?");
  const std::string wall = R"(mesh.level = "coarse"
load.pressure = 2.0
static.load_steps = 5
structure = { density = 1200, bulk_modulus = 10, layers.w = { material = "neo-hookean", c10 = 1 } }
)";
  EXPECT_EQ(parse_case(wall, "case.toml").warnings,
            Lines{"case.toml:4: structure.density: 1200 looks like a value in kg/m^3; did you mean 1.2 mg/mm^3?"});
}

TEST(UnitWarnings, TellOncePerColumnOfATable) {
  const auto said = warnings_with({"inlet.pressure=[[0, 0], [1e-4, 1332], [2e-4, 1400], [3e-4, 1332]]"});
  ASSERT_EQ(said.size(), 2u);
  EXPECT_NE(said[0].find("inlet.pressure[1][0]: 0.0001 looks like a value in s"), std::string::npos) << said[0];
  EXPECT_NE(said[1].find("inlet.pressure[1][1]: 1332 looks like a value in Pa"), std::string::npos) << said[1];
}

TEST(UnitWarnings, AreSilentWhereAValueIsMerelyUnusual) {
  EXPECT_EQ(warnings_with({}), Lines{});
  for (const char* setting : {"fluid.density=13.6",
                              "fluid.density=0.0012",
                              "fluid.density=0.1",
                              "structure.density=1.2e-3",
                              "structure.density=1000",
                              "structure.density=12000",
                              "fluid.viscosity=1.4",
                              "fluid.viscosity=1",
                              "fluid.viscosity=3.5e-2",
                              "fluid.viscosity=1e-6",
                              "structure.bulk_modulus=100",
                              "structure.bulk_modulus=1e7",
                              "structure.bulk_modulus=1e9",
                              "structure.layers.media.c10=3e4",
                              "structure.layers.media.c10=0.003",
                              "structure.layers.media.alpha=0",
                              "structure.layers.media.alpha=2",
                              "structure.layers.media.alpha=90",
                              "inlet.pressure=0",
                              "inlet.pressure=1e-3",
                              "inlet.pressure=40",
                              "inlet.until=5",
                              "time.end=12000"})
    EXPECT_EQ(warnings_with({setting}), Lines{}) << setting;
  EXPECT_EQ(warnings_with({"time.step=0.0078125", "time.end=0.0234375"}), Lines{});
  EXPECT_EQ(warnings_with({"time.step=50", "time.end=1000"}), Lines{});
}

TEST(UnitWarnings, AreSilentOnEveryCaseOfTheRepository) {
  int cases = 0;
  for (const char* folder : {"meshes", "compare", "tests/integration"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(FSI_SOURCE) / folder)) {
      if (entry.path().extension() != ".toml") continue;
      std::ifstream stream(entry.path());
      const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
      if (text.find("\n[mesh]\n") == std::string::npos) continue;  // a study of cases
      ++cases;
      Lines said = read_case(entry.path()).warnings;
      // Small pressures against the paper's soft wall are meant.
      const auto of_start = [](const std::string& line) {
        return line.find("against a wall without load") != line.npos;
      };
      said.erase(std::remove_if(said.begin(), said.end(), of_start), said.end());
      EXPECT_EQ(said, Lines{}) << entry.path();
    }
  EXPECT_GE(cases, 9);
}

/// Entries of a TOML table by dotted key; a nested table under a quoted key "a.b" comes out alike.
void flatten(const toml::table& table, const std::string& path, Lines& settings) {
  for (const auto& [name, node] : table) {
    const auto key = path + (path.empty() ? "" : ".") + std::string(name.str());
    if (const auto* below = node.as_table())
      flatten(*below, key, settings);
    else
      node.visit([&, settings_key = key](const auto& value) {
        std::ostringstream text;
        text << settings_key << "=" << value;
        settings.push_back(text.str());
      });
  }
}

/// Calls `use` with the settings of each run that a study asks for: its tables `set`, and each value of its `vary`.
void for_each_setting(const toml::table& study, const std::function<void(const Lines&)>& use) {
  for (const auto& [name, node] : study) {
    if (const auto* array = node.as_array())
      for (const auto& element : *array)
        if (const auto* row = element.as_table()) for_each_setting(*row, use);
    const auto* table = node.as_table();
    if (table == nullptr) continue;
    for_each_setting(*table, use);
    if (name.str() == "set") {
      Lines settings;
      flatten(*table, "", settings);
      use(settings);
    } else if (name.str() == "vary") {
      for (const auto& [key, values] : *table)
        if (values.is_array())
          for (const auto& value : *values.as_array()) {
            Lines settings;
            flatten(toml::table{{key, value}}, "", settings);
            use(settings);
          }
    }
  }
}

TEST(StabilisationWarnings, NameKeysThatTheElementDoesNotUse) {
  const std::string advice = "not used: the element p2p1 needs no stabilisation; leave this key out, or set element = ";
  EXPECT_EQ(warnings_with({"element=p2p1", "structure.stabilisation=0.1"}),
            Lines{"--set: structure.stabilisation: " + advice + "\"p1\""});
  EXPECT_EQ(warnings_with({"element=p2p1", "fluid.grad_div=true"}),
            Lines{"--set: fluid.grad_div: " + advice + "\"p1\""});
  EXPECT_EQ(warnings_with({"element=p2p1", "fluid.grad_div=false"}), Lines{});
  EXPECT_EQ(warnings_with({"structure.stabilisation=0.1", "fluid.grad_div=true"}), Lines{});
}

TEST(UnitWarnings, AreSilentOnTheSettingsOfEveryStudy) {
  int tried = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(FSI_SOURCE) / "compare/research/studies")) {
    if (entry.path().extension() != ".toml") continue;
    const auto study = toml::parse_file(entry.path().string());
    for_each_setting(study, [&](const Lines& settings) {
      for (auto setting : settings) {
        if (setting.rfind("load.", 0) == 0) setting.replace(0, 4, "inlet");
        if (setting.rfind("time.end", 0) == 0 || setting.find('[') != std::string::npos) continue;
        try {
          EXPECT_EQ(warnings_with({setting}), Lines{}) << entry.path();
          ++tried;
        } catch (const InputError&) {  // no setting of this wall, or one of fsi-compare
        }
      }
    });
  }
  EXPECT_GT(tried, 60);
}

TEST(MeshWarnings, AnErrorHoldsForTheWavesThatTheStepsLeave) {
  std::string text = good_case;
  const std::string level = "level = \"coarse\"";
  text.replace(text.find(level), level.size(), "error = \"1%\"");
  const auto read = [&](const Lines& settings) { return parse_case(text, "case.toml", settings); };
  for (const Lines& damped :
       {Lines{"time.scheme=midpoint", "time.step=0.125"}, Lines{"time.scheme=euler", "time.step=0.03125"}}) {
    const auto scene = read(damped);
    EXPECT_EQ(scene.mesh.waves, Waves::damped);
    EXPECT_EQ(scene.warnings, Lines());
    EXPECT_EQ(scene.remarks, Lines());
  }
  for (const Lines& short_steps :
       {Lines{"time.scheme=midpoint", "time.step=0.03125"}, Lines{"time.scheme=tr-bdf2", "time.step=adaptive"}}) {
    const auto scene = read(short_steps);
    EXPECT_EQ(scene.mesh.waves, Waves::resolved);
    EXPECT_EQ(scene.warnings, Lines());
    ASSERT_EQ(scene.remarks.size(), 1u);
    EXPECT_NE(scene.remarks[0].find("mesh.error: taken for resolved waves"), std::string::npos) << scene.remarks[0];
  }
  const auto named = read({"time.scheme=midpoint", "time.step=0.03125", "mesh.waves=resolved"});
  EXPECT_EQ(named.warnings, Lines());
  EXPECT_EQ(named.remarks, Lines());
  const auto against = read({"time.scheme=midpoint", "time.step=0.03125", "mesh.waves=damped"});
  EXPECT_EQ(against.mesh.waves, Waves::damped);
  ASSERT_EQ(against.warnings.size(), 1u);
  EXPECT_NE(against.warnings[0].find("mesh.waves: is for backward Euler"), std::string::npos) << against.warnings[0];
}

}  // namespace

}  // namespace fsi::test
