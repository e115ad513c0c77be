// What a case file can say wrong about the Maxwell branches of a layer: one clear line each.

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"
#include "example_cases.hpp"

namespace fsi::test {

namespace {

std::string with_branches(const std::string& branches) {
  return with(coupled_case, "c01 = 0.2", "c01 = 0.2\nmaxwell = " + branches);
}
std::string complaint_about(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BadBranches, AreRefusedInOneLine) {
  const std::string here = "case.toml:21: structure.layers.adventitia.maxwell";
  const std::string form = "give [{ shear = 20.0, time = 5.0 }, ...]";
  const auto complaint = [](const std::string& branches) { return complaint_about(with_branches(branches)); };
  EXPECT_EQ(complaint("3.0"), here + ": 3 is no list of branches; " + form);
  EXPECT_EQ(complaint("[]"), here + ": [] has no branch; " + form + ", or leave it out");
  EXPECT_EQ(complaint("[3.0]"), here + "[0]: 3 is no branch; give { shear = ..., time = ... }");
  EXPECT_EQ(complaint("[{ shear = 1.0, tim = 2.0 }]"),
            here + "[0].tim: unknown key; did you mean structure.layers.adventitia.maxwell[0].time?");
  EXPECT_EQ(complaint("[{ shear = 1.0, time = 2.0 }, { shear = 1.0 }]"),
            here + "[1].time: missing; add it (time in ms in which the branch's stress relaxes)");
  EXPECT_EQ(complaint("[{ shear = -1.0, time = 2.0 }]"),
            here + "[0].shear: -1 is not positive; give a number > 0 (shear modulus of the branch's spring in kPa)");
  EXPECT_EQ(complaint("[{ shear = 1.0, time = 0.0 }]"),
            here + "[0].time: 0 is not positive; give a number > 0 (time in ms in which the branch's stress relaxes)");
  std::string many = "[{ shear = 1.0, time = 1.0 }";
  for (int i = 0; i < 16; ++i) many += ", { shear = 1.0, time = 1.0 }";
  EXPECT_EQ(complaint(many + "]"), here + ": 17 branches; give at most 16");
  EXPECT_EQ(
      complaint_about(with(static_case, "c10 = 3", "c10 = 3\nmaxwell = [{ shear = 1.0, time = 1.0 }]")),
      "case.toml:10: structure.layers.wall.maxwell: relaxes in time, which a static case has none of; remove it: at "
      "rest its branches bear nothing; or replace [static] by [time]");
}

TEST(Branches, ArePartOfTheHash) {
  const auto hash = [](const std::string& branches) {
    return hash_of_case(parse_case(with_branches(branches), "case.toml"));
  };
  const Case two = parse_case(with_branches("[{ shear = 1.0, time = 2.0 }, { shear = 3.0, time = 0.5 }]"), "case.toml");
  const auto& branches = two.structure->layers.at("adventitia").maxwell;
  ASSERT_EQ(branches.size(), 2u);
  EXPECT_EQ(branches[1].shear, 3);
  EXPECT_EQ(branches[1].time, 0.5);
  EXPECT_TRUE(two.structure->layers.at("media").maxwell.empty());
  EXPECT_NE(hash("[{ shear = 1.0, time = 2.0 }]"), hash_of_case(parse_case(coupled_case, "case.toml")));
  EXPECT_NE(hash("[{ shear = 1.0, time = 2.0 }]"), hash("[{ shear = 1.0, time = 2.5 }]"));
}

}  // namespace

}  // namespace fsi::test
