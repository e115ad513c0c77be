#include "io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class CheckpointFile : public FolderTest {};

Checkpoint example(int step) {
  Checkpoint checkpoint;
  checkpoint.program = "fsi-partitioned";
  checkpoint.case_hash = "0123456789abcdef";
  checkpoint.case_text = "fluid.density = 1\ninlet.pressure = [[0, 2]]\n";
  checkpoint.mesh_hash = "fedcba9876543210";
  checkpoint.step = step;
  checkpoint.time = 0.1 * step;
  checkpoint.arrays["d_s"] = {0.1, -1e-300, std::numeric_limits<double>::denorm_min(), -0.0, 1.0 / 3.0};
  checkpoint.arrays["empty"] = {};
  checkpoint.integers["history"] = -3;
  checkpoint.reals["omega"] = 0.1;
  return checkpoint;
}

TEST_F(CheckpointFile, ComesBackBitByBit) {
  const auto file = checkpoint_file(folder_);
  EXPECT_EQ(file.filename(), "checkpoint.h5");
  const auto written = example(3);
  write_checkpoint(file, written);
  const auto read = read_checkpoint(file);
  EXPECT_EQ(read.program, written.program);
  EXPECT_EQ(read.case_hash, written.case_hash);
  EXPECT_EQ(read.case_text, written.case_text);
  EXPECT_EQ(read.mesh_hash, written.mesh_hash);
  EXPECT_EQ(read.step, 3);
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.arrays, written.arrays);
  EXPECT_TRUE(std::signbit(read.arrays.at("d_s")[3]));
  EXPECT_EQ(read.integers, written.integers);
  EXPECT_EQ(read.reals, written.reals);
  EXPECT_NO_THROW(require_same_run(file, read, "fsi-partitioned", "0123456789abcdef", "fedcba9876543210"));
  EXPECT_EQ(require_size(file, read, "d_s", 5), written.arrays.at("d_s"));
  EXPECT_EQ(read.integers.at("history"), -3);
  EXPECT_EQ(read.reals.at("omega"), 0.1);
}

TEST_F(CheckpointFile, WithoutArraysComesBack) {
  Checkpoint bare;
  bare.program = "fsi-monolithic";
  write_checkpoint(folder_ / "bare.h5", bare);
  const auto read = read_checkpoint(folder_ / "bare.h5");
  EXPECT_EQ(read.program, "fsi-monolithic");
  EXPECT_EQ(read.case_hash, "");
  EXPECT_TRUE(read.arrays.empty() && read.integers.empty() && read.reals.empty());
}

TEST_F(CheckpointFile, IsReplacedAndLeavesNoTemporaryFile) {
  const auto file = checkpoint_file(folder_);
  write_checkpoint(file, example(1));
  write_checkpoint(file, example(2));
  EXPECT_EQ(read_checkpoint(file).step, 2);
  EXPECT_FALSE(fs::exists(folder_ / "checkpoint.h5.tmp"));
}

TEST_F(CheckpointFile, SurvivesAKillWhileTheNextOneIsWritten) {
  const auto file = checkpoint_file(folder_);
  write_checkpoint(file, example(1));
  write_text(folder_ / "checkpoint.h5.tmp", contents_of(file).substr(0, 700));  // what such a kill leaves
  EXPECT_EQ(read_checkpoint(file).step, 1);
  write_checkpoint(file, example(2));
  EXPECT_EQ(read_checkpoint(file).step, 2);
}

TEST_F(CheckpointFile, HoldsTheSameBytesForTheSameState) {
  write_checkpoint(folder_ / "a.h5", example(1));
  write_checkpoint(folder_ / "b.h5", example(1));
  EXPECT_EQ(contents_of(folder_ / "a.h5"), contents_of(folder_ / "b.h5"));
}

}  // namespace

}  // namespace fsi::test
