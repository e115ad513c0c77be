#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "base/error.hpp"
#include "io/checkpoint.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

Checkpoint example() {
  Checkpoint checkpoint;
  checkpoint.program = "fsi-monolithic";
  checkpoint.case_hash = "00000000000000aa";
  checkpoint.mesh_hash = "00000000000000bb";
  checkpoint.step = 8;
  checkpoint.time = 1.0;
  checkpoint.arrays["d_s"] = {1, 2, 3};
  checkpoint.integers["history"] = 2;
  checkpoint.reals["omega"] = 0.5;
  return checkpoint;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class BadCheckpoint : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("bad_checkpoint_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    file_ = folder_ / "checkpoint.h5";
    write_checkpoint(file_, example());
  }
  void TearDown() override { fs::remove_all(folder_); }

  void overwrite(const std::string& bytes) { std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes; }

  /// Expects InputError; `message` follows the file's name.
  void expect_refusal(const std::function<void()>& action, const std::string& message) {
    try {
      action();
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), file_.string() + ": " + message);
    }
  }
  void expect_unreadable(const std::string& message) {
    expect_refusal([&] { read_checkpoint(file_); }, message);
  }

  fs::path folder_, file_;
  const std::string damaged_ =
      "checksum: does not match: the file is truncated or damaged; run from the start, or restart from another folder";
  const std::string foreign_ =
      "is no checkpoint of this program; give --restart the folder of a run that has written checkpoint.h5";
};

TEST_F(BadCheckpoint, Missing) {
  fs::remove(file_);
  expect_unreadable("no such checkpoint; give --restart the folder of a run that has written checkpoint.h5");
}

TEST_F(BadCheckpoint, Empty) {
  overwrite("");
  expect_unreadable(foreign_);
}

TEST_F(BadCheckpoint, TextFile) {
  overwrite("time_ms,z_mm,pressure_Pa\n");
  expect_unreadable(foreign_);
}

TEST_F(BadCheckpoint, TruncatedAnywhere) {
  const auto bytes = bytes_of(file_);
  for (const std::size_t size :
       {std::size_t(60), std::size_t(511), std::size_t(512), bytes.size() / 2, bytes.size() - 1}) {
    overwrite(bytes.substr(0, size));
    expect_unreadable(damaged_);
  }
}

TEST_F(BadCheckpoint, SomeByteChanged) {
  const auto bytes = bytes_of(file_);
  for (std::size_t i = 0; i < bytes.size(); i += 37) {
    auto altered = bytes;
    altered[i] = static_cast<char>(altered[i] ^ 0x10);
    overwrite(altered);
    EXPECT_THROW(read_checkpoint(file_), InputError) << "byte " << i;
  }
}

TEST_F(BadCheckpoint, BytesAppended) {
  overwrite(bytes_of(file_) + "x");
  expect_unreadable(damaged_);
}

TEST_F(BadCheckpoint, OfAnotherProgram) {
  expect_refusal([&] { require_same_run(file_, example(), "fsi-partitioned", "00000000000000aa", "00000000000000bb"); },
                 "program: was written by fsi-monolithic, not fsi-partitioned; continue it with fsi-monolithic");
}

TEST_F(BadCheckpoint, OfAnotherMesh) {
  expect_refusal(
      [&] { require_same_run(file_, example(), "fsi-monolithic", "00000000000000aa", "00000000000000cc"); },
      "mesh: belongs to another mesh (hash 00000000000000bb, not 00000000000000cc); restart with the mesh of "
      "that run");
}

TEST_F(BadCheckpoint, OfAnotherCase) {
  expect_refusal([&] { require_same_run(file_, example(), "fsi-monolithic", "00000000000000ab", "00000000000000bb"); },
                 "case: belongs to another case (hash 00000000000000aa, not 00000000000000ab); restart with the case "
                 "file of that run; only names, files, steps, the end, solvers and output may differ "
                 "(docs/guide/running.md, Continuing a run)");
}

TEST_F(BadCheckpoint, OfAnotherCaseWhoseDifferenceIsKnown) {
  expect_refusal(
      [&] {
        require_same_run(file_, example(), "fsi-monolithic", "00000000000000ab", "00000000000000bb",
                         "fluid.density was 1 and is 2");
      },
      "case: belongs to another case (fluid.density was 1 and is 2); restart with the case file of that run; only "
      "names, files, steps, the end, solvers and output may differ (docs/guide/running.md, Continuing a run)");
}

TEST_F(BadCheckpoint, OfAnotherVersion) {
  for (const std::string number : {"1", "3", "20"}) {
    overwrite("fsi-duo checkpoint " + number + "\nchecksum 0123456789abcdef\n" + bytes_of(file_).substr(60));
    expect_unreadable(
        "is a checkpoint of another version of this program; continue with the version that wrote it, or run from the "
        "start");
  }
}

TEST_F(BadCheckpoint, ArrayOfAnotherSize) {
  expect_refusal([&] { require_size(file_, example(), "d_s", 4); },
                 "d_s: has 3 values, not 4; restart with the case and mesh of that run");
}

TEST_F(BadCheckpoint, LacksWhatIsNeeded) {
  const std::string remedy = ": missing; the checkpoint comes from another version; run from the start";
  expect_refusal([&] { require_size(file_, example(), "d_m", 4); }, "d_m" + remedy);
}

TEST_F(BadCheckpoint, CannotBeWritten) {
  EXPECT_THROW(write_checkpoint(folder_ / "missing" / "checkpoint.h5", example()), InputError);
}

}  // namespace

}  // namespace fsi::test
