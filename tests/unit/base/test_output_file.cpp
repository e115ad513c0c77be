#include "base/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class OutputFile : public FolderTest {
 protected:
  /// What the refusal says behind the file's name; empty: none.
  std::string refusal(const fs::path& file) {
    try {
      regular_output_file(file);
    } catch (const InputError& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.rfind(file.string() + ": ", 0), 0u) << said;
      return said.substr(std::min(said.size(), file.string().size() + 2));
    }
    return "";
  }
};

TEST_F(OutputFile, IsARegularOneOrNew) {
  write_text(folder_ / "old", "");
  EXPECT_EQ(regular_output_file(folder_ / "old"), folder_ / "old");
  EXPECT_EQ(regular_output_file(folder_ / "new"), folder_ / "new");
}

TEST_F(OutputFile, OfALinkIsWhatItLeadsTo) {
  write_text(folder_ / "old", "");
  fs::create_symlink("old", folder_ / "link");
  EXPECT_TRUE(fs::equivalent(regular_output_file(folder_ / "link"), folder_ / "old"));
  EXPECT_NE(regular_output_file(folder_ / "link").filename(), "link");
}

TEST_F(OutputFile, IsNothingElse) {
  fs::create_directory(folder_ / "folder");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", folder_ / "to device");
  fs::create_symlink("nowhere", folder_ / "to nothing");
  EXPECT_EQ(refusal("/dev/null").rfind("is a device; ", 0), 0u);
  EXPECT_EQ(refusal(folder_ / "folder").rfind("is a folder; ", 0), 0u);
  EXPECT_EQ(refusal(folder_ / "folder" / "").rfind("is a folder; ", 0), 0u);
  EXPECT_EQ(refusal(folder_ / "pipe").rfind("is a pipe; ", 0), 0u);
  EXPECT_EQ(refusal(folder_ / "to device").rfind("is a device, by a link; ", 0), 0u);
  EXPECT_EQ(refusal(folder_ / "to nothing").rfind("is a symbolic link to nothing; ", 0), 0u);
  EXPECT_EQ(refusal(folder_ / "none" / "new").rfind("there is no folder ", 0), 0u);
}

TEST_F(OutputFile, MayBeRefusedAsALink) {
  write_text(folder_ / "old", "");
  fs::create_symlink("old", folder_ / "link");
  EXPECT_NO_THROW(require_regular_or_absent(folder_ / "link", true));
  EXPECT_THROW(require_regular_or_absent(folder_ / "link", false), InputError);
  EXPECT_NO_THROW(require_regular_or_absent(folder_ / "none", false));
}

}  // namespace

}  // namespace fsi::test
