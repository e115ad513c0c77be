#include "run/command_line.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace fsi::test {

namespace {

std::optional<CommandLine> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "fsi-partitioned");
  return parse_command_line("fsi-partitioned", "Runs a case.", static_cast<int>(arguments.size()), arguments.data());
}

TEST(CommandLine, TakesAllOptions) {
  const auto line = parse({"--set", "a.b=1", "case.toml", "-o", "out", "--set", "c=[1, 2]", "--set=d=x y", "--threads",
                           "4", "-q", "--restart", "old", "--force"});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->case_file, "case.toml");
  EXPECT_EQ(line->output, "out");
  EXPECT_EQ(line->restart, "old");
  EXPECT_EQ(line->overrides, (std::vector<std::string>{"a.b=1", "c=[1, 2]", "d=x y"}));
  EXPECT_EQ(line->threads, 4);
  EXPECT_TRUE(line->quiet);
  EXPECT_TRUE(line->force);
}

TEST(CommandLine, HasDefaults) {
  const auto line = parse({"case.toml", "--output", "out"});
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->restart.empty());
  EXPECT_TRUE(line->overrides.empty());
  EXPECT_EQ(line->threads, 0);
  EXPECT_FALSE(line->quiet);
  EXPECT_FALSE(line->force);
}

TEST(CommandLine, RestartsInPlaceWithoutOutput) {
  const auto line = parse({"case.toml", "--restart", "old"});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->output, "old");
}

TEST(CommandLine, ContinuesByACommandThatAShellReadsBack) {
  const auto line = parse({"my case.toml", "-o", "it's", "--set", "title=\"a $b\"", "--set", "time.end=6", "--threads",
                           "2", "-q", "--force"});
  ASSERT_TRUE(line);
  EXPECT_EQ(restart_command(*line),
            "fsi-partitioned 'my case.toml' --restart 'it'\\''s' -o 'it'\\''s' --set 'title=\"a $b\"' --set "
            "time.end=6 --threads 2 -q");
  const auto hidden = parse({"case.toml", "-o", "a\nb'\xff\\"});
  ASSERT_TRUE(hidden);
  EXPECT_EQ(restart_command(*hidden),
            "fsi-partitioned case.toml --restart $'a\\012b\\'\\377\\\\' -o "
            "$'a\\012b\\'\\377\\\\'");
  const auto elsewhere = parse({"case.toml", "--restart", "old", "-o", "new"});
  ASSERT_TRUE(elsewhere);
  EXPECT_EQ(restart_command(*elsewhere), "fsi-partitioned case.toml --restart new -o new");
}

TEST(CommandLine, PrintsHelpAndVersionInsteadOfRunning) {
  testing::internal::CaptureStdout();
  EXPECT_FALSE(parse({"--help"}));
  const auto help = testing::internal::GetCapturedStdout();
  for (const auto* option : {"CASE.toml", "--output", "--restart", "--set", "--threads", "--quiet", "--version"})
    EXPECT_NE(help.find(option), std::string::npos) << option;

  testing::internal::CaptureStdout();
  EXPECT_FALSE(parse({"--version"}));
  EXPECT_EQ(testing::internal::GetCapturedStdout().rfind("fsi-partitioned 0.", 0), 0u);

  testing::internal::CaptureStdout();
  EXPECT_FALSE(parse({"--help-keys"}));
  EXPECT_NE(testing::internal::GetCapturedStdout().find("fluid.viscosity"), std::string::npos);
}

}  // namespace

}  // namespace fsi::test
