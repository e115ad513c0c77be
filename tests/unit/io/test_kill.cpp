#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "io/checkpoint.hpp"
#include "io/result_folder.hpp"
#include "sample_fields.hpp"
#include "sample_tables.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

const std::vector<ResultTable> no_fluid{steps_table, wall_table({0, 1, 2})};
const std::vector<std::string> files_written = files_of(no_fluid);
constexpr int last_step = 200;
constexpr double step_size = 0.25;  // exact in binary, so that times can be compared

/// What a run writes in a step, in the drivers' order: tables, fields, checkpoint. Step 0 has fields alone.
void write_step(ResultFolder& results, FieldsWriter& fields, const std::vector<FieldGrid>& grids, int step) {
  const double time = step_size * step;
  if (step == 0) {
    fields.write(step, sample_values(grids, time));
    return;
  }
  results.write({"wall_displacement.csv", {time}, {{0, time, 0}, {1, time, 0}, {2, time, 0}}});
  results.write({iterations_file, {1.0 * step, time}, {{3, 0.5}}});
  fields.write(step, sample_values(grids, time));
  Checkpoint checkpoint;
  checkpoint.step = step;
  checkpoint.time = time;
  checkpoint.arrays["state"].assign(1000, time);
  write_checkpoint(checkpoint_file(results.path()), checkpoint);
}

class Kill : public FolderTest {};

TEST_F(Kill, AtAnyMomentLeavesResultsThatARestartContinues) {
  const auto grids = sample_grids();
  const auto planned = planned_field_steps(last_step, 1, steps_of(step_size));
  // Some milliseconds after the first checkpoint, so that the kills fall into all parts of a step.
  for (int milliseconds = 0; milliseconds < 30; milliseconds += 2) {
    const auto run = folder_ / std::to_string(milliseconds);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ResultFolder results(run, no_fluid, files_written);
      FieldsWriter fields(run, grids, planned);
      for (int step = 0; step <= last_step; ++step) write_step(results, fields, grids, step);
      _exit(0);
    }
    for (int tries = 0; tries < 20000 && !fs::exists(checkpoint_file(run)); ++tries) usleep(1000);
    usleep(static_cast<useconds_t>(milliseconds) * 1000);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);

    const auto checkpoint = read_checkpoint(checkpoint_file(run));
    const int step = static_cast<int>(checkpoint.step);
    ASSERT_LT(step, last_step);
    EXPECT_EQ(checkpoint.arrays.at("state"), std::vector<double>(1000, checkpoint.time));
    {
      const EarlierSteps earlier{step, checkpoint.time, step};
      ResultFolder results(run, no_fluid, files_written, EarlierTables(run, no_fluid, earlier));
      FieldsWriter fields(run, grids, planned, run, checkpoint.time);
      write_step(results, fields, grids, step + 1);
    }

    const auto reference = folder_ / "reference";
    {
      ResultFolder results(reference, no_fluid, files_written);
      FieldsWriter fields(reference, grids, planned);
      for (int s = 0; s <= step + 1; ++s) write_step(results, fields, grids, s);
    }
    for (const auto* file :
         {"wall_displacement.csv", "iterations.csv", "fields.xdmf", "fluid.xdmf", "wall.xdmf", "checkpoint.h5"})
      EXPECT_EQ(contents_of(run / file), contents_of(reference / file))
          << file << " killed after " << milliseconds << " ms";
    EXPECT_TRUE(contents_of(run / "fields.h5") == contents_of(reference / "fields.h5"));
  }
}

}  // namespace

}  // namespace fsi::test
