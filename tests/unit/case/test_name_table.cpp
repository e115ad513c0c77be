#include "base/name_table.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "case/choices.hpp"
#include "case/multigrid_kinds.hpp"
#include "materials/material.hpp"
#include "nonlinear/newton.hpp"

namespace fsi::test {

namespace {

const NameTable<int> fruits{"fruit", {{"apple", 1}, {"pear", 2}, {"plum", 2}}};

TEST(NameTable, FindsValuesAndNames) {
  EXPECT_EQ(fruits.at("pear"), 2);
  EXPECT_EQ(*fruits.find("apple"), 1);
  EXPECT_EQ(fruits.find("apples"), nullptr);
  EXPECT_EQ(fruits.name_of(2), "pear") << "the first of two names";
  EXPECT_EQ(fruits.name_of(3), "");
  EXPECT_EQ(fruits.names(), (std::vector<std::string>{"apple", "pear", "plum"}));
}

std::string complaint(const std::function<void()>& what) {
  try {
    what();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NameTable, RefusesAnUnknownNameWithTheNearest) {
  EXPECT_EQ(complaint([] { fruits.at("paer"); }),
            "fruit: \"paer\" is unknown; did you mean pear? There are apple, pear or plum");
}

// None of these falls back on some other choice.
TEST(NameTable, EveryChoiceRefusesAnUnknownName) {
  for (const auto& said :
       {complaint([] { materials().at("steel"); }), complaint([] { make_material("steel", {}); }),
        complaint([] { coarsening_kinds().at("coloring"); }), complaint([] { cycle_kinds().at("W"); }),
        complaint([] { linear_cycle_kinds().at("k"); }), complaint([] { saddle_smoother_kinds().at("uzawa"); }),
        complaint([] { newton_modes().at("keep"); }), complaint([] { constant_operator_modes().at("keep"); })}) {
    EXPECT_NE(said.find("is unknown; did you mean"), std::string::npos) << said;
  }
}

struct Row {
  std::string_view name;
};

TEST(NamesMatch, NoticesAMissingASwappedAndAMisspeltRow) {
  constexpr std::array<std::string_view, 2> names{"a", "b"};
  EXPECT_TRUE(names_match(names, std::array<Row, 2>{{{"a"}, {"b"}}}));
  EXPECT_FALSE(names_match(names, std::array<Row, 1>{{{"a"}}}));
  EXPECT_FALSE(names_match(names, std::array<Row, 2>{{{"b"}, {"a"}}}));
  EXPECT_FALSE(names_match(names, std::array<Row, 2>{{{"a"}, {"c"}}}));
}

}  // namespace

}  // namespace fsi::test
