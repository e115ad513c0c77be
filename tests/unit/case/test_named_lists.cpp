#include "case/named_lists.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case_overrides.hpp"

namespace fsi::test {

namespace {

const CaseSource source{"case.toml", {}, {}};

std::string refusal(const std::string& text) {
  auto document = toml::parse(text);
  try {
    name_lists(document, source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NamedLists, BecomeSectionsInTheOrderOfTheFileWithTheirLines) {
  auto document = toml::parse(
      "[[opening]]\nsurface = \"right\"\npressure = 1\n"
      "[[opening]]\nsurface = \"left\"\npressure = 2\n[[support]]\nsurface = \"right\"\nspring = 3\n");
  name_lists(document, source);
  const CaseEntry whole(document, "", "", source);
  const auto openings = whole.child("opening").children();
  ASSERT_EQ(openings.size(), 2u);
  EXPECT_EQ(openings[0].key(), "opening.right");
  EXPECT_EQ(openings[1].key(), "opening.left");
  EXPECT_FALSE(openings[1].has("surface"));
  EXPECT_EQ(openings[1].child("pressure").number(), 2);
  EXPECT_EQ(whole.child("support").child("right").child("spring").number(), 3);
  try {
    openings[1].child("pressure").refuse("is wrong", "mend it");
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("case.toml:6"), std::string::npos) << error.what();
  }
}

TEST(NamedLists, AreOverriddenByName) {
  auto document = toml::parse("[[opening]]\nsurface = \"out\"\nresistance = 1\n");
  name_lists(document, source);
  CaseSource overridden = source;
  apply_overrides({"opening.out.resistance=5"}, document, overridden);
  EXPECT_EQ(document["opening"]["out"]["resistance"].value<int>(), 5);
}

TEST(NamedLists, RefuseEntriesWithoutASurfaceOfTheirOwn) {
  EXPECT_EQ(refusal("[[opening]]\nsurface = \"a\"\n[[opening]]\nsurface = \"b\"\n"), "accepted");
  EXPECT_EQ(refusal("[opening.a]\npressure = 1\n"), "accepted");
  const auto none = refusal("[[opening]]\npressure = 1\n");
  EXPECT_NE(none.find("opening[1].surface"), std::string::npos) << none;
  EXPECT_NE(none.find("missing"), std::string::npos) << none;
  const auto twice = refusal("[[support]]\nsurface = \"a\"\n[[support]]\nsurface = \"a\"\n");
  EXPECT_NE(twice.find("support[2].surface"), std::string::npos) << twice;
  EXPECT_NE(twice.find("already"), std::string::npos) << twice;
  EXPECT_NE(refusal("opening = [1]\n").find("[[opening]]"), std::string::npos);
  EXPECT_NE(refusal("[[opening]]\nsurface = \"\"\n").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("[[opening]]\nsurface = 3\n").find("string"), std::string::npos);
}

}  // namespace

}  // namespace fsi::test
