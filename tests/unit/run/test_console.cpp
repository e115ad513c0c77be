#include "run/console.hpp"

#include <gtest/gtest.h>

#include <cerrno>

#include "io/run_log.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

class ConsoleOutput : public FolderTest {
 protected:
  /// What two steps look like in this style.
  std::string output_in(Console::Style style) {
    std::FILE* stream = std::fopen((folder_ / "out").c_str(), "w");
    {
      Console console(4, style, stream);
      console.line("8 nodes");
      console.working(1, "t = 0.125 ms", "newton 1");
      console.step_done({1, 0.125, 1, 3, 0, 2.0}, "t = 0.125 ms");
      console.step_done({2, 0.25, 5, 10, 120, 4.0}, "t = 0.25 ms");
    }
    std::fclose(stream);
    return contents_of(folder_ / "out");
  }
};

TEST_F(ConsoleOutput, IsOneLinePerStepWhenPiped) {
  EXPECT_EQ(output_in(Console::Style::plain),
            "8 nodes\n"
            "step 1/4, t = 0.125 ms: 3 Newton iterations, 2 s, 6 s left\n"
            "step 2/4, t = 0.25 ms: 5 coupling, 10 Newton, 120 linear iterations, 4 s, 6 s left\n");
}

TEST_F(ConsoleOutput, RewritesOneLineOnATerminal) {
  EXPECT_EQ(output_in(Console::Style::terminal),
            "8 nodes\n"
            "\r\033[Kstep 1/4, t = 0.125 ms: newton 1"
            "\r\033[Kstep 1/4, t = 0.125 ms: 3 Newton iterations, 2 s, 6 s left"
            "\r\033[Kstep 2/4, t = 0.25 ms: 5 coupling, 10 Newton, 120 linear iterations, 4 s, 6 s l"  // 79 columns
            "\n");
}

TEST_F(ConsoleOutput, IsEmptyWhenQuiet) {
  EXPECT_EQ(output_in(Console::Style::quiet), "");
}

TEST_F(ConsoleOutput, StyleDependsOnTheStream) {
  std::FILE* stream = std::fopen((folder_ / "out").c_str(), "w");
  EXPECT_EQ(Console::style_for(false, stream), Console::Style::plain);
  EXPECT_EQ(Console::style_for(true, stream), Console::Style::quiet);
  std::fclose(stream);
}

TEST_F(ConsoleOutput, EndsAtTheFirstLineThatCannotBeWritten) {
  std::FILE* stream = std::fopen("/dev/full", "w");
  {
    Console console(4, Console::Style::plain, stream);
    EXPECT_EQ(console.error(), 0);
    console.line("8 nodes");
    EXPECT_EQ(console.error(), ENOSPC);
    console.step_done({1, 0.125, 1, 3, 0, 2.0}, "t = 0.125 ms");
    EXPECT_EQ(console.error(), ENOSPC);
  }
  std::fclose(stream);
}

TEST_F(ConsoleOutput, ShowsPrintableCharactersOnly) {
  std::FILE* stream = std::fopen((folder_ / "out").c_str(), "w");
  Console(1, Console::Style::plain, stream).line("a title\x1b[2J\nof two lines");
  std::fclose(stream);
  EXPECT_EQ(contents_of(folder_ / "out"), "a title\\x1b[2J\\nof two lines\n");
}

TEST(ReadableDuration, HasTwoUnitsAtMost) {
  EXPECT_EQ(readable_duration(0), "0 s");
  EXPECT_EQ(readable_duration(12.3), "13 s");
  EXPECT_EQ(readable_duration(200), "3 min 20 s");
  EXPECT_EQ(readable_duration(3725), "1 h 02 min");
}

class RunLogFile : public FolderTest {};

TEST_F(RunLogFile, IsOnDiskAtOnceAndContinuedOnRestart) {
  {
    RunLog log(folder_);
    log.info("step 1 {braces stay}");
    EXPECT_NE(contents_of(folder_ / "run.log").find("step 1 {braces stay}"), std::string::npos);
  }
  {
    RunLog log(folder_, true);
    log.warning("step 2\nin one line");
  }
  const auto both = contents_of(folder_ / "run.log");
  EXPECT_NE(both.find("step 1"), std::string::npos);
  EXPECT_NE(both.find("warning step 2\\nin one line\n"), std::string::npos);
  RunLog fresh(folder_);
  EXPECT_EQ(contents_of(folder_ / "run.log"), "");
}

}  // namespace

}  // namespace fsi::test
