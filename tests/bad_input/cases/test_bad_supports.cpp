// What a case file can say wrong about supports and prestress: one clear line each.

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "case/case_reader.hpp"
#include "example_cases.hpp"

namespace fsi::test {

namespace {

std::string complaint(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
/// Of the static case with lines at its end, in a section [support.outer].
std::string support_complaint(const std::string& lines) {
  return complaint(static_case + "[[support]]\nsurface = \"outer\"\n" + lines);
}

TEST(BadSupport, IsRefusedInOneLine) {
  EXPECT_EQ(support_complaint("spring = 2.0\npressure = 0.5\nfixed = [\"normal\"]\n"), "");
  EXPECT_EQ(support_complaint("sprong = 2.0\n"),
            "case.toml:16: support.outer.sprong: unknown key; did you mean support.outer.spring?");
  EXPECT_EQ(support_complaint("spring = -2.0\n"),
            "case.toml:16: support.outer.spring: -2 is negative; give a number >= 0 (stiffness in kPa/mm of a "
            "bedding that resists displacement, default 0)");
  EXPECT_EQ(
      support_complaint("traction = [1.0, 0.0]\n"),
      "case.toml:16: support.outer.traction: has 2 components, the scene 3 directions; give one per direction: x, "
      "y, z");
  EXPECT_EQ(support_complaint("fixed = [\"r\"]\n"),
            "case.toml:16: support.outer.fixed: \"r\" is no direction of this scene; give some of x, y, z or normal");
  EXPECT_NE(support_complaint("fixed = [\"nomral\"]\n").find("did you mean normal?"), std::string::npos);
  EXPECT_EQ(support_complaint("pressure = [[0, 1], [1, 2]]\n"),
            "case.toml:16: support.outer.pressure: changes in time, but the case is static; give one value, without "
            "until");
  EXPECT_EQ(support_complaint("damper = 1.0\n"),
            "case.toml:16: support.outer.damper: resists velocity, which a static case has none of; remove it, or "
            "replace [static] by [time]");
  EXPECT_EQ(support_complaint("until = 1.0\n"),
            "case.toml:16: support.outer.until: there is no load that it could be of; add pressure or traction");
  EXPECT_EQ(
      support_complaint("pressure = [[1, 2], [0, 1]]\n"),
      "case.toml:16: support.outer.pressure[1]: [0, 1] comes before the time 1 of the row above; sort the table by "
      "time");
}

TEST(BadSupport, JumpsNoMoreOftenThanStepsMayEnd) {
  const std::string scene =
      with(coupled_case, "end = 12.0", "end = 12000.0") + "[[support]]\nsurface = \"outer\"\nperiod = 0.001\n";
  const auto said = [](const std::string& jumps) {
    return "case.toml:38: support.outer.period: the table would jump " + jumps +
           " times in 12000 ms, and end a step each time; give a longer period, or a table without jumps whose last "
           "value is its first";
  };
  EXPECT_EQ(complaint(scene + "pressure = [[0, 1], [0.0005, 1], [0.0005, 0]]\n"), said("2.4e+07"));
  EXPECT_EQ(complaint(scene + "traction = [[0, 0, 0, 0], [0.001, 0, 0, 1]]\n"), said("1.2e+07"));
}

TEST(BadSupport, NeedsAWall) {
  const std::string no_wall =
      "[mesh]\nfile = \"a.msh\"\n[fluid]\ndensity = 1\nviscosity = 1\n[inlet]\npressure = 1\n[time]\n"
      "step = 1\nend = 1\n";
  EXPECT_EQ(complaint(no_wall + "[support.outer]\nspring = 1\n"),
            "case.toml:11: support: stands in a case without a wall; remove it, or add [structure]");
  EXPECT_EQ(complaint(no_wall + "[prestress]\npressure = 1\n"),
            "case.toml:11: prestress: stands in a case without a wall; remove it, or add [structure]");
}

TEST(BadPrestress, NeedsItsPressure) {
  EXPECT_NE(complaint(static_case + "[prestress]\n").find("case.toml:14: prestress.pressure: missing"),
            std::string::npos);
}

}  // namespace

}  // namespace fsi::test
