// Tables, log and HDF5 files on a disk that is full, and under the hands of somebody else.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

#include "file_size_limit.hpp"
#include "io/checkpoint.hpp"
#include "io/csv_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_log.hpp"
#include "io/summary.hpp"
#include "io/write_error.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class FailedWrites : public FolderTest {};

TEST_F(FailedWrites, LeaveWholeRowsInATable) {
  const auto file = folder_ / "t.csv";
  CsvFile table(file, "time_ms,value");
  table.write("0.5,1\n");
  const auto before = contents_of(file);
  {
    const FileSizeLimit limit(before.size() + 3);
    EXPECT_THROW(table.write("1,2\n"), WriteError);
    EXPECT_EQ(contents_of(file), before);
  }
  table.write("1,2\n");
  EXPECT_EQ(contents_of(file), "time_ms,value\n0.5,1\n1,2\n");
  table.close();
}

TEST_F(FailedWrites, AreNoticedInATableThatIsGone) {
  const auto file = folder_ / "t.csv";
  CsvFile table(file, "time_ms,value");
  fs::remove(file);
  EXPECT_NE(message_of<WriteError>([&] { table.write("0.5,1\n"); }).find("has been deleted"), std::string::npos);
  EXPECT_THROW(table.close(), WriteError);
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(FailedWrites, AreNoticedInATableThatSomebodyElseWritesTo) {
  CsvFile table(folder_ / "t.csv", "time_ms,value");
  write_text(folder_ / "t.csv", "time_ms,value\n0.25,7\n");
  EXPECT_NE(message_of<WriteError>([&] { table.write("0.5,1\n"); }).find("something else writes"), std::string::npos);
}

TEST_F(FailedWrites, AreToldByTheLog) {
  RunLog log(folder_);
  log.info("first {}");
  {
    const FileSizeLimit limit(fs::file_size(folder_ / "run.log") + 3);
    EXPECT_EQ(message_of<WriteError>([&] { log.info("second"); }),
              (folder_ / "run.log").string() +
                  ": cannot be written (File too large); raise the limit on the size of files (ulimit -f)");
  }
  fs::remove(folder_ / "run.log");
  EXPECT_THROW(log.warning("third"), WriteError);
  EXPECT_THROW(log.close(), WriteError);
}

TEST_F(FailedWrites, AreNoneInALogThatIsClosed) {
  RunLog log(folder_);
  log.info("first {}");
  log.error("last");
  log.close();
  const auto text = contents_of(folder_ / "run.log");
  EXPECT_EQ(text.substr(text.find(" info")), " info    first {}\n" + text.substr(text.find('\n') + 1));
  EXPECT_EQ(text.substr(text.size() - 14), " error   last\n");
}

TEST_F(FailedWrites, LeaveTheOldSummary) {
  write_summary(folder_, {{"status", "running"}});
  const auto before = contents_of(folder_ / "summary.json");
  const FileSizeLimit limit(before.size());
  EXPECT_THROW(write_summary(folder_, {{"status", "not converged"}}), WriteError);
  EXPECT_EQ(contents_of(folder_ / "summary.json"), before);
}

TEST_F(FailedWrites, LeaveTheOldCheckpoint) {
  const auto file = checkpoint_file(folder_);
  Checkpoint checkpoint;
  checkpoint.arrays["a"] = {1, 2, 3};
  write_checkpoint(file, checkpoint);
  const auto size = fs::file_size(file);
  for (const auto bytes : {size / 100, size / 2, size - 1, size}) {
    const FileSizeLimit limit(bytes);
    checkpoint.step = static_cast<std::int64_t>(bytes);
    if (bytes == size)
      EXPECT_NO_THROW(write_checkpoint(file, checkpoint));
    else
      EXPECT_THROW(write_checkpoint(file, checkpoint), WriteError);
    EXPECT_EQ(read_checkpoint(file).step, bytes == size ? checkpoint.step : 0) << bytes;
    EXPECT_FALSE(fs::exists(folder_ / "checkpoint.h5.tmp"));
  }
}

/// Ends the process in the ordinary way, so that HDF5 would have its exit handler called.
[[noreturn]] void fail_to_write_hdf5(const fs::path& file) {
  const FileSizeLimit limit(3000);
  const std::vector<double> values(1000, 1.5);
  const std::int64_t number = 7;
  int failures = 0;
  for (int k = 0; k < 2; ++k) try {
      auto hdf5 = Hdf5File::create(file.string() + std::to_string(k));
      for (int i = 0; i < 20; ++i) hdf5.write_new<std::int64_t>("/small/" + std::to_string(i), {1}, &number);
      hdf5.write_new<double>("/large", {values.size()}, values.data());
      hdf5.close();
    } catch (const WriteError&) {
      ++failures;
    }
  std::exit(failures);
}

TEST_F(FailedWrites, OfHdf5AreErrorsAndTheProgramEndsInOrder) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(fail_to_write_hdf5(folder_ / "f.h5"), testing::ExitedWithCode(2), "");
}

TEST_F(FailedWrites, OfHdf5NameFileDatasetAndReason) {
  const auto file = folder_ / "f.h5";
  const std::vector<double> values(100000, 1.5);
  auto hdf5 = Hdf5File::create(file);
  hdf5.create_dataset<double>("/large", {values.size()});
  hdf5.flush();
  const FileSizeLimit limit(100000);
  EXPECT_EQ(
      message_of<WriteError>([&] { hdf5.write("/large", values.data()); }),
      file.string() + ": /large: cannot be written (File too large); raise the limit on the size of files (ulimit -f)");
}

TEST_F(FailedWrites, LeaveNoUnfinishedHdf5) {
  const auto file = folder_ / "f.h5";
  {
    auto hdf5 = Hdf5File::create(file);
    EXPECT_TRUE(fs::exists(file));
    const auto moved = std::move(hdf5);
    EXPECT_TRUE(fs::exists(file));
  }
  EXPECT_FALSE(fs::exists(file));
  Hdf5File::create(file).close();
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(FailedWrites, OfHdf5ThatIsGoneSayThat) {
  EXPECT_EQ(message_of<WriteError>([&] { Hdf5File::open(folder_ / "f.h5", true); }),
            (folder_ / "f.h5").string() +
                ": cannot be written (No such file or directory); leave the files of a running computation where they "
                "are");
  EXPECT_THROW(Hdf5File::create(folder_ / "missing" / "f.h5"), WriteError);
}

}  // namespace

}  // namespace fsi::test
