#include "run/cost_summary.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "math/pack.hpp"

namespace fsi::test {

namespace {

TEST(CostSummary, IsNullWithoutMeasurement) {
  EXPECT_TRUE(work_unit_json({}).is_null());
  EXPECT_TRUE(work_units_per_step({}, 3.0, 2).is_null());
  EXPECT_TRUE(work_units_per_step({0.25, 3, 100, 0.8}, 0.0, 0).is_null());
}

TEST(CostSummary, DividesTheSecondsOfAStep) {
  const WorkUnit unit{0.25, 3, 100, 0.8};
  EXPECT_EQ(work_units_per_step(unit, 3.0, 2), 6.0);
  EXPECT_EQ(work_unit_json(unit),
            (nlohmann::json{{"seconds", 0.25}, {"products", 3}, {"entries", 100}, {"measuring_s", 0.8}}));
}

TEST(CostSummary, NamesMachineAndBuild) {
  EXPECT_FALSE(machine_json().at("processor").get<std::string>().empty());
  EXPECT_EQ(build_json().at("doubles_per_pack"), pack_width);
  for (const char* key : {"compiler", "instruction_set"}) EXPECT_FALSE(build_json().at(key).get<std::string>().empty());
}

}  // namespace

}  // namespace fsi::test
