#include "io/atomic_file.hpp"

#include <gtest/gtest.h>

#include "file_size_limit.hpp"
#include "io/write_error.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class AtomicFile : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    file_ = folder_ / "file";
    write_text(file_, "old");
  }
  fs::path file_;
};

TEST_F(AtomicFile, IsReplaced) {
  write_atomically(file_, "new");
  EXPECT_EQ(contents_of(file_), "new");
  // Longer than what is compared at once, as long, and empty.
  for (const std::size_t size : {(1 << 20) - 1, 1 << 20, (1 << 20) + 1, 3 << 20, 0}) {
    const std::string text(size, 'x');
    write_atomically(file_, text, ReadBack::yes);
    EXPECT_EQ(contents_of(file_), text) << size;
  }
  EXPECT_FALSE(fs::exists(temporary_name(file_)));
}

TEST_F(AtomicFile, StaysWhenTheNewOneCannotBeWritten) {
  const FileSizeLimit limit(100);
  EXPECT_EQ(message_of<WriteError>([&] { write_atomically(file_, std::string(101, 'x')); }),
            file_.string() + ": cannot be written (File too large); raise the limit on the size of files (ulimit -f)");
  EXPECT_EQ(contents_of(file_), "old");
  EXPECT_FALSE(fs::exists(temporary_name(file_)));
}

TEST_F(AtomicFile, StaysWhenThereIsNoNewOne) {
  EXPECT_THROW(replace_by_temporary(file_), WriteError);
  EXPECT_EQ(contents_of(file_), "old");
  EXPECT_FALSE(fs::exists(temporary_name(file_))) << "it is not made for being missing";
}

TEST_F(AtomicFile, ReplacesRegularFilesOnly) {
  fs::create_symlink("/dev/null", folder_ / "link");
  fs::create_directory(folder_ / "folder");
  for (const auto* name : {"link", "folder"}) {
    const auto file = folder_ / name;
    EXPECT_EQ(message_of<WriteError>([&] { write_atomically(file, "new"); }),
              file.string() + ": cannot be written (it is no regular file); remove it or give another name");
    EXPECT_FALSE(fs::exists(temporary_name(file)));
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
}

TEST_F(AtomicFile, DoesNotWriteThroughALinkOfTheTemporaryName) {
  write_text(folder_ / "precious", "dear");
  fs::create_symlink(folder_ / "precious", temporary_name(file_));
  write_atomically(file_, "new");
  EXPECT_EQ(contents_of(folder_ / "precious"), "dear");
  EXPECT_EQ(contents_of(file_), "new");
  EXPECT_FALSE(fs::is_symlink(file_));
}

}  // namespace

}  // namespace fsi::test
