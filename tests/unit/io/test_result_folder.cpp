#include "io/result_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "io/summary.hpp"
#include "sample_tables.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

const std::vector<ResultTable> all_tables{steps_table, centre_table({0, 0.1}), wall_table({0.5}), flow_table,
                                          energy_table};
const std::vector<std::string> known = files_of(all_tables);

void write_step(ResultFolder& results, int step) {
  const double time = 0.1 * step;
  results.write({"centerline_pressure.csv", {time}, {{0, 1332.0 / step}, {0.1, 1000.0 / 3}}});
  results.write({"wall_displacement.csv", {time}, {{0.5, 1e-17, -0.25}}});
  results.write({"flow.csv", {time}, {{1, 3}}});
  results.write({iterations_file, {1.0 * step, time}, {{9, 0.75}}});
  results.write({"energy.csv", {1.0 * step, time}, {{0.25 * step}}});
}

/// What the checkpoint of a step says of these tables.
EarlierSteps earlier(int step) {
  return {step, 0.1 * step, step};
}

class Results : public FolderTest {
 protected:
  fs::path run_ = "";
  void SetUp() override {
    FolderTest::SetUp();
    run_ = folder_ / "run";
  }
};

/// What the refusal says; empty: none.
std::string refusal(const fs::path& folder) {
  try {
    require_no_results(folder, known, "GO ON");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Results, OfFinishedStepsAreNotToBeReplaced) {
  EXPECT_EQ(refusal(run_), "");
  ResultFolder results(run_, all_tables, known);
  write_summary(run_, {{"program", "fsi-x"}, {"status", "running"}});
  EXPECT_EQ(refusal(run_), "") << "no step is finished";
  write_step(results, 1);
  write_step(results, 2);
  EXPECT_EQ(refusal(run_), run_.string() +
                               ": holds an unfinished run of fsi-x (status \"running\", 2 steps); give -o another "
                               "folder, or replace it with --force");
  write_text(run_ / "checkpoint.h5", "");
  EXPECT_NE(refusal(run_).find("; continue it with GO ON, give -o another"), std::string::npos);
  write_summary(run_, {{"program", "fsi-x"}, {"status", "done"}});
  EXPECT_EQ(
      refusal(run_),
      run_.string() + ": holds a finished run of fsi-x (2 steps); give -o another folder, or replace it with --force");
  write_text(run_ / "summary.json", "{cut");
  EXPECT_NE(refusal(run_).find("holds an unfinished run (status \"unknown\", 2 steps)"), std::string::npos);
}

TEST_F(Results, WithoutTheirTableOfStepsAreNotToBeReplaced) {
  {
    ResultFolder results(run_, all_tables, known);
    write_step(results, 1);
  }
  write_text(run_ / "checkpoint.h5", "");
  for (const auto* table : {"", "step,time", "step,time_ms\n", "\xff\n"}) {
    write_text(run_ / "iterations.csv", table);
    EXPECT_NE(refusal(run_).find(": holds a checkpoint, but no iterations.csv with their steps; give -o another"),
              std::string::npos)
        << table;
  }
  fs::remove(run_ / "checkpoint.h5");
  EXPECT_NE(refusal(run_).find(": holds "), std::string::npos) << "a table that is not this program's";
  fs::remove(run_ / "iterations.csv");
  EXPECT_NE(refusal(run_).find(".csv, but no iterations.csv"), std::string::npos);
  for (const auto& file : fs::directory_iterator(run_)) fs::remove(file);
  EXPECT_EQ(refusal(run_), "");
  write_summary(run_, {{"status", "done"}});
  EXPECT_NE(refusal(run_).find(": holds a finished run, but no iterations.csv"), std::string::npos);
}

TEST_F(Results, AreRegularFilesOnly) {
  EXPECT_NO_THROW(require_results_only(run_, known));
  EXPECT_NO_THROW(require_regular_results(run_, known, false));
  { ResultFolder results(run_, all_tables, known); }
  write_text(run_ / "run.lock", "");
  EXPECT_NO_THROW(require_results_only(run_, known));
  fs::rename(run_ / "flow.csv", folder_ / "elsewhere.csv");
  fs::create_symlink(folder_ / "elsewhere.csv", run_ / "flow.csv");
  EXPECT_THROW(require_results_only(run_, known), InputError);
  EXPECT_THROW(require_regular_results(run_, known, false), InputError);
  EXPECT_NO_THROW(require_regular_results(run_, known, true)) << "can be read";
  fs::remove(run_ / "flow.csv");
  fs::create_directory(run_ / "flow.csv");
  EXPECT_THROW(require_regular_results(run_, known, true), InputError);
  EXPECT_THROW(ResultFolder(run_, all_tables, known), InputError);
  EXPECT_TRUE(fs::is_directory(run_ / "flow.csv"));
}

TEST_F(Results, RowsAreThereWhenTheirStepIsDone) {
  ResultFolder results(run_, all_tables, known);
  write_step(results, 1);
  EXPECT_EQ(contents_of(run_ / "centerline_pressure.csv"),
            "time_ms,z_mm,pressure_Pa\n0.1,0,1332\n0.1,0.1,333.3333333333333\n");
  EXPECT_EQ(contents_of(run_ / "wall_displacement.csv"), "time_ms,z_mm,radial_mm,axial_mm\n0.1,0.5,1e-17,-0.25\n");
  EXPECT_EQ(contents_of(run_ / "iterations.csv"), "step,time_ms,newton_iterations,wall_s\n1,0.1,9,0.75\n");
}

TEST_F(Results, ContinueWithoutAnEarlierTableOnlyWhenNoneIsWanted) {
  const std::vector<ResultTable> tables{steps_table};
  { ResultFolder results(run_, tables, known); }
  EXPECT_NO_THROW(ResultFolder(folder_ / "other", tables, known, EarlierTables(run_, tables, {})));
  try {
    EarlierTables(run_, {steps_table, energy_table}, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), (run_ / "energy.csv").string() +
                                ": output.energy: is wanted, but the earlier run wrote none; continue without");
  }
}

TEST_F(Results, HoldOnlyTheTablesOfTheScene) {
  ResultFolder results(run_, {steps_table, wall_table({0.5})}, known);
  EXPECT_FALSE(fs::exists(run_ / "centerline_pressure.csv"));
  EXPECT_FALSE(fs::exists(run_ / "flow.csv"));
  EXPECT_TRUE(fs::exists(run_ / "wall_displacement.csv"));
  EXPECT_TRUE(fs::exists(run_ / "iterations.csv"));
}

TEST_F(Results, ReplaceThoseOfAnEarlierRun) {
  {
    ResultFolder results(run_, all_tables, known);
    write_step(results, 1);
    write_text(run_ / "checkpoint.h5", "old");
    write_text(run_ / "fields.h5.tmp", "old");
  }
  ResultFolder results(run_, {steps_table}, known);
  EXPECT_FALSE(fs::exists(run_ / "flow.csv"));
  EXPECT_FALSE(fs::exists(run_ / "checkpoint.h5"));
  EXPECT_FALSE(fs::exists(run_ / "fields.h5.tmp"));
}

TEST_F(Results, NeverReplaceOtherFiles) {
  fs::create_directories(run_);
  write_text(run_ / "flow.csv", "old");
  write_text(run_ / "thesis.tex", "dear");
  try {
    ResultFolder results(run_, all_tables, known);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), run_.string() +
                                ": holds 'thesis.tex', which is no result file; give -o a new folder, or one "
                                "with nothing but the results of an earlier run");
  }
  EXPECT_EQ(contents_of(run_ / "flow.csv"), "old");
}

TEST_F(Results, RefuseAFolderThatIsAFileOrCannotBeWritten) {
  write_text(folder_ / "file", "");
  EXPECT_THROW(ResultFolder(folder_ / "file", all_tables, known), InputError);
  EXPECT_THROW(ResultFolder(folder_ / "file" / "below", all_tables, known), InputError);
  EXPECT_THROW(ResultFolder("/proc/fsi", all_tables, known), InputError);
}

TEST_F(Results, ContinueAfterTheCheckpointInPlace) {
  {
    ResultFolder results(run_, all_tables, known);
    for (int step = 1; step <= 4; ++step) write_step(results, step);
  }
  // As a kill leaves it: rows of a step beyond the checkpoint, the last one torn.
  write_text(run_ / "flow.csv", contents_of(run_ / "flow.csv") + "0.5,1,2,3");
  {
    ResultFolder results(run_, all_tables, known, EarlierTables(run_, all_tables, earlier(3)));
    for (int step = 4; step <= 5; ++step) write_step(results, step);
  }
  ResultFolder whole(folder_ / "whole", all_tables, known);
  for (int step = 1; step <= 5; ++step) write_step(whole, step);
  for (const auto* table :
       {"centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "iterations.csv", "energy.csv"})
    EXPECT_EQ(contents_of(run_ / table), contents_of(folder_ / "whole" / table)) << table;
}

TEST_F(Results, ContinueInAnotherFolderAndLeaveTheFirst) {
  {
    ResultFolder results(run_, all_tables, known);
    for (int step = 1; step <= 3; ++step) write_step(results, step);
  }
  const auto before = contents_of(run_ / "flow.csv");
  {
    ResultFolder results(folder_ / "other", all_tables, known, EarlierTables(run_, all_tables, earlier(2)));
    write_step(results, 3);
  }
  EXPECT_EQ(contents_of(run_ / "flow.csv"), before);
  EXPECT_EQ(contents_of(folder_ / "other" / "flow.csv"), before);
}

TEST_F(Results, SummaryTellsTimesAndCounts) {
  Profile profile;
  profile.count("factorisations", 3);
  { const auto scope = profile.phase("assembly"); }
  write_summary(folder_, {{"status", "running"}});
  auto summary = profile_json(profile);
  summary["status"] = "done";
  summary["title"] = "not \xff UTF-8";
  write_summary(folder_, summary);
  const auto read = nlohmann::json::parse(contents_of(folder_ / "summary.json"));
  EXPECT_EQ(read["status"], "done");
  EXPECT_EQ(read["counters"]["factorisations"], 3);
  EXPECT_EQ(read["phases"]["assembly"]["calls"], 1);
  EXPECT_GE(read["phases"]["assembly"]["seconds"], 0.0);
  EXPECT_FALSE(fs::exists(folder_ / "summary.json.tmp"));
}

}  // namespace

}  // namespace fsi::test
