// Tables of samples: their text, and what a restart believes of them.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "io/earlier_tables.hpp"
#include "io/result_folder.hpp"
#include "sample_tables.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

const ResultTable points{"points.csv",
                         "time_ms,point,x_mm,y_mm,pressure_Pa,velocity_x_mm_per_ms",
                         RowsPer::level,
                         {"a,0,1.5", "b,2,-1"},
                         {},
                         {Measure::pressure, Measure::velocity},
                         true,
                         ResultTable::Missing{"output", "the earlier run wrote none", "continue without"}};

std::vector<ResultTable> tables_of(const ResultTable& sampled = points) {
  return {steps_table, flow_table, sampled};
}

class SampledTables : public FolderTest {
 protected:
  static constexpr int written = 3, step = 2;  // the checkpoint is of step 2

  void SetUp() override {
    FolderTest::SetUp();
    ResultFolder results(folder_ / "run", tables_of(), {});
    for (int k = 1; k <= written; ++k) {
      const double time = 0.1 * k;
      results.write({iterations_file, {1.0 * k, time}, {{3, 0.5}}});
      results.write({"flow.csv", {time}, {{1.0 * k, 2}}});
      results.write({points.file, {time}, {{100.0 * k, std::nullopt}, {-1e-3, 0.25 * k}}});
    }
  }

  EarlierTables read(const ResultTable& sampled = points) const {
    return EarlierTables(folder_ / "run", tables_of(sampled), {step, 0.1 * step, step});
  }
  std::string refusal(const ResultTable& sampled = points) const {
    try {
      read(sampled);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  void replace(const std::string& from, const std::string& to) {
    std::string text = contents_of(folder_ / "run" / points.file);
    ASSERT_NE(text.find(from), std::string::npos);
    write_text(folder_ / "run" / points.file, text.replace(text.find(from), from.size(), to));
  }
};

TEST_F(SampledTables, EmptyCellsStandForWhatDoesNotExist) {
  EXPECT_EQ(contents_of(folder_ / "run" / points.file),
            points.header + "\n0.1,a,0,1.5,100,\n0.1,b,2,-1,-0.001,0.25\n0.2,a,0,1.5,200,\n0.2,b,2,-1,-0.001,0.5\n" +
                "0.30000000000000004,a,0,1.5,300,\n0.30000000000000004,b,2,-1,-0.001,0.75\n");
}

TEST_F(SampledTables, ARestartTakesOverTheRowsUpToItsCheckpoint) {
  const auto earlier = read();
  const auto& last = earlier.last_level(points.file);
  ASSERT_EQ(last.size(), 4u);
  EXPECT_EQ(last[0], 200);
  EXPECT_TRUE(std::isnan(last[1]));
  EXPECT_EQ(last[3], 0.5);
  { const ResultFolder again(folder_ / "again", tables_of(), {}, earlier); }
  EXPECT_EQ(contents_of(folder_ / "again" / points.file),
            points.header + "\n0.1,a,0,1.5,100,\n0.1,b,2,-1,-0.001,0.25\n0.2,a,0,1.5,200,\n0.2,b,2,-1,-0.001,0.5\n");
}

TEST_F(SampledTables, OtherSamplesAreRefused) {
  ResultTable other = points;
  other.names[1] = "b,2,-1.5";
  EXPECT_NE(refusal(other).find("is of 'b,2,-1', not of 'b,2,-1.5'"), std::string::npos) << refusal(other);
  other = points;
  other.names.push_back("c,0,0");
  EXPECT_NE(refusal(other).find("rows are missing, doubled or out of order"), std::string::npos) << refusal(other);
  other = points;
  other.file = "lines.csv";
  EXPECT_NE(refusal(other).find("the earlier run wrote none"), std::string::npos) << refusal(other);
}

TEST_F(SampledTables, DamagedRowsAreRefused) {
  replace("0.2,b,2,-1,-0.001,0.5\n", "");
  EXPECT_NE(refusal().find("line 5: is of the time 0.3"), std::string::npos) << refusal();
}

TEST_F(SampledTables, WordsForNumbersAreRefused) {
  replace("200", "nan");
  EXPECT_NE(refusal().find("line 4: holds a number that is not finite"), std::string::npos) << refusal();
  replace("nan", "2x0");
  EXPECT_NE(refusal().find("line 4: is no row of this table"), std::string::npos) << refusal();
  replace(",2x0,", ",");
  EXPECT_NE(refusal().find("line 4: is no row of this table"), std::string::npos) << refusal();
}

TEST_F(SampledTables, NumbersThatAreNotFiniteAreNotWritten) {
  ResultFolder results(folder_ / "other", tables_of(), {});
  EXPECT_THROW(results.write({points.file, {0.1}, {{1, 2}, {std::numeric_limits<double>::infinity(), std::nullopt}}}),
               ConvergenceError);
  EXPECT_EQ(contents_of(folder_ / "other" / points.file), points.header + "\n");
}

}  // namespace

}  // namespace fsi::test
