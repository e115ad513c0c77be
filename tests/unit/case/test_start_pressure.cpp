// What begins with a pressure that the wall does not carry is named with its remedy.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "case/case_reader.hpp"

namespace fsi::test {

namespace {

constexpr const char* start = "opening.outlet.windkessel.initial_pressure=10.7";

/// A bend of 300 kPa, a flow that enters and a Windkessel.
std::vector<std::string> warnings(const std::vector<std::string>& settings, const std::string& more = "",
                                  bool wall = true, const std::string& outlet = "outlet") {
  return parse_case(std::string("[mesh]\nfile = \"a.msh\"\n[fluid]\ndensity = 1.0\nviscosity = 3.5e-3\n") +
                        (wall ? "[structure]\ndensity = 1.2\n[structure.layers.wall]\nmaterial = "
                                "\"compressible-neo-hookean\"\nyoung = 300.0\npoisson = 0.4\n"
                              : "") +
                        "[[opening]]\nsurface = \"inlet\"\nflow_rate = [[0, 0], [4, 1.5], [8, 0]]\nperiod = 8\n"
                        "[[opening]]\nsurface = \"" +
                        outlet +
                        "\"\nwindkessel = { proximal = 0.1, compliance = 10.0, "
                        "distal = 1.0 }\n[time]\nstep = 0.5\nend = 24.0\n" +
                        more,
                    "case.toml", settings)
      .warnings;
}

TEST(StartPressure, OfAWindkesselAgainstAnUnloadedWallIsNamed) {
  const auto said = warnings({start});
  ASSERT_EQ(said.size(), 1u);
  for (const char* part : {"opening.outlet.windkessel: begins with 10.7 kPa against a wall without load: the vessel is "
                           "filled through this "
                           "opening",
                           "add prestress.pressure = 10.7", "begin with 0 kPa here", "time.start = \"lumped\""})
    EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
}

TEST(StartPressure, ThatTheWallCarriesIsRight) {
  EXPECT_TRUE(warnings({start}, "[prestress]\npressure = 10.7\n").empty());
  EXPECT_TRUE(warnings({start}, "[prestress]\npressure = 11.2\n").empty()) << "half a kPa widens by 1.5 %";
  EXPECT_TRUE(warnings({}).empty());
  EXPECT_TRUE(warnings({start}, "", false).empty()) << "a rigid wall is not filled";
  EXPECT_TRUE(warnings({"opening.outlet.windkessel.initial_pressure=0.5"}).empty());
}

TEST(StartPressure, OfOtherKindsIsNamedToo) {
  const std::string prestress = "[prestress]\npressure = 10.7\n";
  const auto emptied = warnings({}, prestress);
  ASSERT_EQ(emptied.size(), 1u);
  EXPECT_NE(emptied[0].find("begins with 0 kPa against a wall that carries 10.7 kPa: the vessel is emptied"),
            std::string::npos)
      << emptied[0];
  const auto distal =
      warnings({start}, prestress + "[[opening]]\nsurface = \"side\"\nresistance = 2\ndistal_pressure = 2\n");
  ASSERT_EQ(distal.size(), 1u);
  EXPECT_NE(distal[0].find("opening.side.resistance: begins with 2 kPa"), std::string::npos) << distal[0];
  const auto beat =
      warnings({}, "[[opening]]\nsurface = \"side\"\npressure = [[0, 10], [4, 16], [8, 10]]\nperiod = 8\n");
  ASSERT_EQ(beat.size(), 1u);
  EXPECT_NE(beat[0].find("opening.side.pressure: begins with 10 kPa"), std::string::npos) << beat[0];
  const auto jumping = warnings({}, "[[opening]]\nsurface = \"side\"\npressure = [[0, 10], [8, 0]]\nperiod = 8\n");
  ASSERT_EQ(jumping.size(), 1u) << "not with the end of a period";
  EXPECT_NE(jumping[0].find("opening.side.pressure: begins with 10 kPa"), std::string::npos) << jumping[0];
  EXPECT_TRUE(warnings({}, "[[opening]]\nsurface = \"side\"\npressure = 10\nuntil = 3\n").empty())
      << "a pulse is meant";
  // With a prestress no pressure of an opening is a pulse, and one without traction does not hold it.
  const auto held = warnings({start}, prestress + "[[opening]]\nsurface = \"side\"\npressure = [[0, 0], [4, 5]]\n");
  ASSERT_EQ(held.size(), 1u);
  EXPECT_NE(held[0].find("opening.side.pressure: begins with 0 kPa against a wall that carries 10.7 kPa"),
            std::string::npos)
      << held[0];
  const auto open = warnings({start}, prestress + "[[opening]]\nsurface = \"side\"\n");
  ASSERT_EQ(open.size(), 1u);
  EXPECT_NE(open[0].find("is emptied through side, which is free of traction,"), std::string::npos) << open[0];
  EXPECT_TRUE(warnings({"opening.distal.windkessel.initial_pressure=10.7"}, prestress, true, "distal").empty())
      << "the mesh need not have a surface outlet";
  // What was found by the openings alone is compared with the wall as well.
  const auto lumped = warnings({"time.start=\"lumped\"", "opening.outlet.windkessel.distal=30"});
  ASSERT_EQ(lumped.size(), 1u);
  EXPECT_EQ(lumped[0].find("time.start"), std::string::npos) << lumped[0];
}

}  // namespace

}  // namespace fsi::test
