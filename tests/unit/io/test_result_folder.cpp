#include "io/result_folder.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/summary.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

constexpr EnergyParts coupled{true, true, true};
const ResultTables all_tables{true, true, true, false, coupled};

void write_step(ResultFolder& results, int step) {
  const double time = 0.1 * step;
  results.write_centerline(time, {{0, 1.332 / step}, {0.1, 1.0 / 3.0}});
  results.write_wall(time, {{0.5, 1e-17, -0.25}});
  results.write_flow(time, {1, 2, 0.003, 0.004});
  results.write_iterations({step, time, 4, 9, 0, 0.75, 0.002});
  EnergyRecord energy;
  energy.inlet_work = 0.25 * step;
  results.write_energy({step, time, 4, 9, 0, 0.75, 0.002}, energy);
}

/// What the checkpoint of a step says of these tables.
EarlierSteps earlier(int step) {
  return {step, 0.1 * step, step, {0, 0.1}, {0.5}};
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
    require_no_results(folder, "GO ON");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Results, OfFinishedStepsAreNotToBeReplaced) {
  EXPECT_EQ(refusal(run_), "");
  ResultFolder results(run_, all_tables);
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
    ResultFolder results(run_, all_tables);
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
  EXPECT_NO_THROW(require_results_only(run_));
  EXPECT_NO_THROW(require_regular_results(run_, false));
  { ResultFolder results(run_, all_tables); }
  write_text(run_ / "run.lock", "");
  EXPECT_NO_THROW(require_results_only(run_));
  fs::rename(run_ / "flow.csv", folder_ / "elsewhere.csv");
  fs::create_symlink(folder_ / "elsewhere.csv", run_ / "flow.csv");
  EXPECT_THROW(require_results_only(run_), InputError);
  EXPECT_THROW(require_regular_results(run_, false), InputError);
  EXPECT_NO_THROW(require_regular_results(run_, true)) << "can be read";
  fs::remove(run_ / "flow.csv");
  fs::create_directory(run_ / "flow.csv");
  EXPECT_THROW(require_regular_results(run_, true), InputError);
  EXPECT_THROW(ResultFolder(run_, all_tables), InputError);
  EXPECT_TRUE(fs::is_directory(run_ / "flow.csv"));
}

TEST_F(Results, TablesHaveTheColumnsThatScriptsRelyOn) {
  ResultFolder results(run_, all_tables);
  write_step(results, 1);
  // Read before the folder is closed: rows are there when their step is done.
  EXPECT_EQ(contents_of(run_ / "centerline_pressure.csv"),
            "time_ms,z_mm,pressure_Pa\n0.1,0,1332\n0.1,0.1,333.3333333333333\n");
  EXPECT_EQ(contents_of(run_ / "wall_displacement.csv"), "time_ms,z_mm,radial_mm,axial_mm\n0.1,0.5,1e-17,-0.25\n");
  EXPECT_EQ(contents_of(run_ / "flow.csv"),
            "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms,inlet_pressure_Pa,outlet_pressure_Pa\n0.1,1,2,3,4\n");
  EXPECT_EQ(contents_of(run_ / "iterations.csv"),
            "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s,solver_error\n1,0.1,4,9,0,0.75,0."
            "002\n");
}

TEST_F(Results, TellHowFluidAndWallCameToAgree) {
  ResultFolder results(run_, {false, false, false, true});
  CouplingReport coupling;
  coupling.failed_passes = 1;
  coupling.columns = 12;
  coupling.displacement_residual = 5e-7;
  coupling.displacement_gap = 1e-8;
  coupling.force_residual = 2e-6;
  coupling.fluid_newton_iterations = 20;
  coupling.wall_newton_iterations = 24;
  coupling.wall_linear_iterations = 7;
  coupling.mesh_seconds = 0.5;
  coupling.pressure_residual = 3e-6;
  results.write_coupling({3, 0.375, 8, 44, 7, 0.75}, coupling);
  EXPECT_EQ(contents_of(run_ / "coupling.csv"),
            "step,time_ms,iterations,failed_passes,relaxation,columns,displacement_residual,displacement_residual_mm,"
            "force_residual,fluid_newton_iterations,wall_newton_iterations,fluid_linear_iterations,"
            "wall_linear_iterations,fluid_s,wall_s,mesh_motion_s,coupling_s,pressure_residual\n"
            "3,0.375,8,1,0,12,5e-07,1e-08,2e-06,20,24,0,7,0,0,0.5,0,3e-06\n");
}

TEST_F(Results, TellOfTheEnergyThatASceneHas) {
  EnergyRecord energy;
  double next = 1;
  for (double* term : {&energy.fluid_kinetic, &energy.wall_kinetic, &energy.wall_isochoric, &energy.wall_volumetric,
                       &energy.inlet_work, &energy.load_work, &energy.inlet_kinetic, &energy.outlet_kinetic,
                       &energy.viscous, &energy.remainder, &energy.fluid_inertia, &energy.fluid_mesh_motion,
                       &energy.fluid_divergence, &energy.fluid_stabilisation, &energy.wall_inertia, &energy.wall_stress,
                       &energy.wall_stabilisation, &energy.fluid_quadrature, &energy.backflow})
    *term = next++;
  const auto table = [&](const EnergyParts& parts) {
    ResultTables tables;
    tables.energy = parts;
    ResultFolder results(run_, tables);
    results.write_energy({2, 0.25, 1, 5, 0, 0.75}, energy);
    return contents_of(run_ / "energy.csv");
  };
  EXPECT_EQ(table(coupled),
            "step,time_ms,fluid_kinetic_energy_uJ,wall_kinetic_energy_uJ,wall_isochoric_energy_uJ,"
            "wall_volumetric_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_mesh_motion_uJ,"
            "fluid_divergence_uJ,fluid_stabilisation_uJ,wall_inertia_uJ,wall_stress_uJ,wall_stabilisation_uJ\n"
            "2,0.25,1,2,3,4,5,7,8,9,116,10,11,12,13,14,15,16,17\n");
  EXPECT_EQ(table({true, false, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_divergence_uJ,"
            "fluid_stabilisation_uJ\n"
            "2,0.25,1,5,7,8,9,116,10,11,13,14\n");
  EXPECT_EQ(table({false, true, false}),
            "step,time_ms,wall_isochoric_energy_uJ,wall_volumetric_energy_uJ,load_work_uJ,numerical_dissipation_uJ,"
            "remainder_uJ,wall_stress_uJ,wall_stabilisation_uJ\n"
            "2,0.25,3,4,6,116,10,16,17\n");
  EXPECT_EQ(table({true, false, true, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_divergence_uJ,"
            "fluid_stabilisation_uJ,fluid_quadrature_uJ\n"
            "2,0.25,1,5,7,8,9,116,10,11,13,14,18\n");
  EXPECT_EQ(table({true, false, true, false, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_divergence_uJ,"
            "fluid_stabilisation_uJ,backflow_dissipation_uJ\n"
            "2,0.25,1,5,7,8,9,116,10,11,13,14,19\n");
  ResultFolder results(run_, {});
  EXPECT_FALSE(fs::exists(run_ / "energy.csv"));
}

TEST_F(Results, ContinueWithoutAnEarlierEnergyBalanceOnlyWhenNoneIsWanted) {
  ResultTables tables;
  { ResultFolder results(run_, tables); }
  EXPECT_NO_THROW(ResultFolder(folder_ / "other", tables, EarlierTables(run_, tables, {})));
  tables.energy = coupled;
  try {
    EarlierTables(run_, tables, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--set output.energy=false"), std::string::npos) << error.what();
  }
}

TEST_F(Results, HoldOnlyTheTablesOfTheScene) {
  ResultFolder results(run_, {false, true, false});
  EXPECT_FALSE(fs::exists(run_ / "centerline_pressure.csv"));
  EXPECT_FALSE(fs::exists(run_ / "flow.csv"));
  EXPECT_TRUE(fs::exists(run_ / "wall_displacement.csv"));
  EXPECT_TRUE(fs::exists(run_ / "iterations.csv"));
}

TEST_F(Results, ReplaceThoseOfAnEarlierRun) {
  {
    ResultFolder results(run_, all_tables);
    write_step(results, 1);
    write_text(run_ / "checkpoint.h5", "old");
    write_text(run_ / "fields.h5.tmp", "old");
  }
  ResultFolder results(run_, {false, false, false});
  EXPECT_FALSE(fs::exists(run_ / "flow.csv"));
  EXPECT_FALSE(fs::exists(run_ / "checkpoint.h5"));
  EXPECT_FALSE(fs::exists(run_ / "fields.h5.tmp"));
}

TEST_F(Results, NeverReplaceOtherFiles) {
  fs::create_directories(run_);
  write_text(run_ / "flow.csv", "old");
  write_text(run_ / "thesis.tex", "dear");
  try {
    ResultFolder results(run_, all_tables);
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
  EXPECT_THROW(ResultFolder(folder_ / "file", all_tables), InputError);
  EXPECT_THROW(ResultFolder(folder_ / "file" / "below", all_tables), InputError);
  EXPECT_THROW(ResultFolder("/proc/fsi", all_tables), InputError);
}

TEST_F(Results, ContinueAfterTheCheckpointInPlace) {
  {
    ResultFolder results(run_, all_tables);
    for (int step = 1; step <= 4; ++step) write_step(results, step);
  }
  // As a kill leaves it: rows of a step beyond the checkpoint, the last one torn.
  write_text(run_ / "flow.csv", contents_of(run_ / "flow.csv") + "0.5,1,2,3");
  {
    ResultFolder results(run_, all_tables, EarlierTables(run_, all_tables, earlier(3)));
    for (int step = 4; step <= 5; ++step) write_step(results, step);
  }
  ResultFolder whole(folder_ / "whole", all_tables);
  for (int step = 1; step <= 5; ++step) write_step(whole, step);
  for (const auto* table :
       {"centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "iterations.csv", "energy.csv"})
    EXPECT_EQ(contents_of(run_ / table), contents_of(folder_ / "whole" / table)) << table;
}

TEST_F(Results, ContinueInAnotherFolderAndLeaveTheFirst) {
  {
    ResultFolder results(run_, all_tables);
    for (int step = 1; step <= 3; ++step) write_step(results, step);
  }
  const auto before = contents_of(run_ / "flow.csv");
  {
    ResultFolder results(folder_ / "other", all_tables, EarlierTables(run_, all_tables, earlier(2)));
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
