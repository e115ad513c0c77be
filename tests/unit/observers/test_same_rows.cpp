#include "observers/same_rows.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/result_folder.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

const ResultTable steps{iterations_file, "step,time_ms,wall_s", RowsPer::step};
const ResultTable flow{"flow.csv",
                       "time_ms,in,out,p_in,p_out",
                       RowsPer::level,
                       {},
                       {},
                       {Measure::flow, Measure::flow, Measure::pressure, Measure::pressure},
                       true};
const TableRow row{1, 2, 3e-6, 4000};

class SameRows : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    {
      ResultFolder results(folder_ / "run", {steps, flow}, {});
      results.write({steps.file, {1, 0.5}, {{0.5}}});
      results.write({flow.file, {0.5}, {row}});
      results.close();
    }
    earlier_.emplace(folder_ / "run", std::vector<ResultTable>{steps, flow}, EarlierSteps{1, 0.5, 1, {}});
  }
  void compare(const TableRow& seen) const { require_same_rows(*earlier_, flow, 0.5, {seen}); }
  std::optional<EarlierTables> earlier_;
};

}  // namespace

TEST_F(SameRows, TakesWhatTheStateGivesAgain) {
  EXPECT_NO_THROW(compare(row));
}

TEST_F(SameRows, ComparesByTheLargestNumberOfAMeasure) {
  TableRow seen = row;
  seen[2] = 6e-6;  // beside 4 kPa
  EXPECT_NO_THROW(compare(seen));
  seen = row;
  seen[0] = 1 + 1e-5;
  EXPECT_THROW(compare(seen), InputError);
  seen = row;
  seen[3] = 4000 * (1 + 1e-5);
  EXPECT_THROW(compare(seen), InputError);
  seen = row;
  seen[1].reset();
  EXPECT_THROW(compare(seen), InputError) << "an empty place on one side";
}

}  // namespace fsi::test
