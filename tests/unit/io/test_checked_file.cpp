#include "io/checked_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>

#include "file_size_limit.hpp"
#include "io/write_error.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class CheckedFiles : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    file_ = folder_ / "file";
  }
  std::string message(const std::string& reason, const std::string& remedy) const {
    return file_.string() + ": cannot be written (" + reason + "); " + remedy;
  }
  const std::string in_place_ = "leave the files of a running computation where they are";
  fs::path file_;
};

TEST(WriteErrors, SayReasonRemedyAndHowToGoOn) {
  const WriteError full("d/flow.csv", ENOSPC);
  EXPECT_STREQ(full.what(), "d/flow.csv: cannot be written (No space left on device); free some disk space");
  EXPECT_STREQ(
      full.then("continue by: fsi-x c.toml --restart d").what(),
      "d/flow.csv: cannot be written (No space left on device); free some disk space, then continue by: fsi-x c.toml "
      "--restart d");
  EXPECT_STREQ(WriteError("f.h5", EROFS, "/steps").what(),
               "f.h5: /steps: cannot be written (Read-only file system); make the folder one that you may write");
}

TEST_F(CheckedFiles, AreCreatedEmptyAndGrow) {
  write_text(file_, "old and long");
  auto file = CheckedFile::create(file_);
  EXPECT_EQ(contents_of(file_), "");
  file.write("ab");
  file.write("");
  file.write("cd");
  EXPECT_EQ(contents_of(file_), "abcd") << "nothing is kept back";
  EXPECT_EQ(file.size(), 4U);
  file.require_undisturbed();
  file.synchronise();
  file.close();
  file.close();  // does nothing
  auto more = CheckedFile::append(file_);
  EXPECT_EQ(more.size(), 4U);
  more.write("e");
  more.require_undisturbed();
  EXPECT_EQ(contents_of(file_), "abcde");
}

TEST_F(CheckedFiles, AreRegularOrRefused) {
  const auto refused = [](const fs::path& name) {
    const auto text = name.string() + ": cannot be written (it is no regular file); remove it or give another name";
    EXPECT_EQ(message_of<WriteError>([&] { CheckedFile::create(name); }), text);
    EXPECT_EQ(message_of<WriteError>([&] { CheckedFile::append(name); }), text);
    EXPECT_EQ(message_of<WriteError>([&] { require_still_regular(name); }), text);
  };
  refused("/dev/null");
  refused("/dev/full");
  refused(folder_);
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  refused(folder_ / "pipe");  // and nobody waits for a reader
  fs::create_symlink("/dev/null", folder_ / "link");
  refused(folder_ / "link");
  EXPECT_NO_THROW(require_still_regular(folder_ / "absent"));
}

TEST_F(CheckedFiles, LeaveNothingOpenThatIsRefused) {
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = open_files();
  EXPECT_THROW(CheckedFile::existing("/dev/null", "/dev/null"), WriteError);
  EXPECT_EQ(open_files(), before);
}

TEST_F(CheckedFiles, MadeNewFollowNoLink) {
  write_text(folder_ / "precious", "dear");
  fs::create_symlink(folder_ / "precious", file_);
  auto file = CheckedFile::create_new(file_, file_);
  file.write("new");
  file.close();
  EXPECT_EQ(contents_of(folder_ / "precious"), "dear");
  EXPECT_EQ(contents_of(file_), "new");
  EXPECT_FALSE(fs::is_symlink(file_));
}

TEST_F(CheckedFiles, TellThatTheyCannotBeWritten) {
  auto file = CheckedFile::create(file_);
  file.write("1234");
  const FileSizeLimit limit(6);
  EXPECT_EQ(message_of<WriteError>([&] { file.write("5678"); }),
            message("File too large", "raise the limit on the size of files (ulimit -f)"));
  EXPECT_EQ(contents_of(file_), "123456") << "a write was cut, and the next one failed";
  file.cut_to(4);
  EXPECT_EQ(contents_of(file_), "1234");
  file.require_undisturbed();
}

TEST_F(CheckedFiles, TellThatTheFolderIsMissing) {
  file_ = folder_ / "missing" / "file";
  EXPECT_EQ(message_of<WriteError>([&] { CheckedFile::create(file_); }),
            message("No such file or directory", in_place_));
  EXPECT_THROW(synchronise_folder(folder_ / "missing"), WriteError);
  EXPECT_NO_THROW(synchronise_folder(folder_));
}

TEST_F(CheckedFiles, TellThatSomebodyHasHarmedThem) {
  const auto moved = message("it has been deleted, moved or replaced since it was opened", in_place_);
  auto file = CheckedFile::create(file_);
  file.write("1234");
  EXPECT_NO_THROW(file.require_in_place());
  write_text(file_, "12");
  EXPECT_NO_THROW(file.require_in_place());
  EXPECT_EQ(
      message_of<WriteError>([&] { file.require_undisturbed(); }),
      message("it has 2 bytes, not 4: something else writes to it", "leave the files of a running computation alone"));
  write_text(file_, "1234");
  EXPECT_NO_THROW(file.require_undisturbed());
  fs::remove(file_);
  EXPECT_EQ(message_of<WriteError>([&] { file.require_in_place(); }), moved);
  write_text(file_, "1234");
  EXPECT_EQ(message_of<WriteError>([&] { file.require_undisturbed(); }), moved) << "another file of that name";
}

}  // namespace

}  // namespace fsi::test
