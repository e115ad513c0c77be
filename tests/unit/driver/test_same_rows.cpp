#include "driver/same_rows.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/level_columns.hpp"
#include "io/result_folder.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

const std::vector<FlowRecord> flow{{1, 2, 3e-9, 4}};

class SameRows : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    ResultTables tables;
    tables.flow = true;
    {
      ResultFolder results(folder_ / "run", tables);
      results.write_iterations({1, 0.5, 1, 3, 0, 0.5, 1e-4});
      results.write_flow(0.5, flow[0]);
      results.close();
    }
    earlier_.emplace(folder_ / "run", tables, EarlierSteps{1, 0.5, 1, {}, {}, {}});
  }
  void compare(const FlowRecord& seen) const {
    require_same_rows(*earlier_, "flow.csv", 0.5, flow_columns(), std::vector<FlowRecord>{seen});
  }
  std::optional<EarlierTables> earlier_;
};

}  // namespace

TEST_F(SameRows, TakesWhatTheStateGivesAgain) {
  EXPECT_NO_THROW(compare(flow[0]));
}

TEST_F(SameRows, ComparesByTheLargestNumberOfAMeasure) {
  FlowRecord seen = flow[0];
  seen.inlet_pressure = 6e-9;  // beside 4 kPa
  EXPECT_NO_THROW(compare(seen));
  seen = flow[0];
  seen.inlet_flow *= 1 + 1e-5;
  EXPECT_THROW(compare(seen), InputError);
  seen = flow[0];
  seen.outlet_pressure *= 1 + 1e-5;
  EXPECT_THROW(compare(seen), InputError);
}

}  // namespace fsi::test
