#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.hpp"
#include "run/command_line.hpp"
#include "run/program.hpp"

namespace fsi::test {

namespace {

struct BadLine {
  const char* name;
  std::vector<const char*> arguments;
  const char* message;
};

void PrintTo(const BadLine& bad, std::ostream* stream) {
  *stream << bad.name;
}
std::string name_of_line(const testing::TestParamInfo<BadLine>& info) {
  return info.param.name;
}

std::optional<CommandLine> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "fsi-monolithic");
  return parse_command_line("fsi-monolithic", "Runs a case.", static_cast<int>(arguments.size()), arguments.data());
}

const std::vector<BadLine>& bad_lines() {
  static const std::vector<BadLine> lines = {
      {"Empty", {}, "no case file given; fsi-monolithic CASE.toml -o DIR, or see fsi-monolithic --help"},
      {"NoCase", {"-o", "out"}, "no case file given; fsi-monolithic CASE.toml -o DIR, or see fsi-monolithic --help"},
      {"NoOutput", {"a.toml"}, "--output: no result folder given; add -o DIR"},
      {"OutputWithoutFolder", {"a.toml", "-o"}, "--output: 1 required DIR missing; see fsi-monolithic --help"},
      {"OutputEmpty", {"a.toml", "-o", ""}, "--output: the folder's name is empty; give -o DIR"},
      {"OutputTwice",
       {"a.toml", "-o", "a", "-o", "b"},
       "--output: At Most 1 required but received 2; see fsi-monolithic --help"},
      {"RestartEmpty",
       {"a.toml", "-o", "a", "--restart", ""},
       "--restart: the folder's name is empty; give --restart DIR"},
      {"TwoCases", {"a.toml", "b.toml", "-o", "out"}, "b.toml: one argument too many; give a single case file"},
      {"UnknownOption", {"a.toml", "-o", "out", "--thread", "2"}, "--thread: unknown option; did you mean --threads?"},
      {"UnknownShortOption", {"a.toml", "-o", "out", "-x"}, "-x: unknown option; see fsi-monolithic --help"},
      {"ThreadsNegative",
       {"a.toml", "-o", "out", "--threads", "-2"},
       "--threads: \"-2\" is no number of threads; give at most 1024, or 0 for as many as are of use"},
      {"ThreadsText",
       {"a.toml", "-o", "out", "--threads", "many"},
       "--threads: \"many\" is no number of threads; give at most 1024, or 0 for as many as are of use"},
      {"ThreadsDecimal",
       {"a.toml", "-o", "out", "--threads", "2.5"},
       "--threads: \"2.5\" is no number of threads; give at most 1024, or 0 for as many as are of use"},
      {"ThreadsHuge",
       {"a.toml", "-o", "out", "--threads", "99999999999"},
       "--threads: \"99999999999\" is no number of threads; give at most 1024, or 0 for as many as are of use"},
      {"SetWithoutValue",
       {"a.toml", "-o", "out", "--set"},
       "--set: 1 required key=value missing; see fsi-monolithic --help"},
  };
  return lines;
}

class BadCommandLine : public testing::TestWithParam<BadLine> {};

TEST_P(BadCommandLine, IsRefusedInOneLine) {
  try {
    parse(GetParam().arguments);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STRCASEEQ(error.what(), GetParam().message);  // CLI11 2.6 says "At most"
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadCommandLine, testing::ValuesIn(bad_lines()), name_of_line);

TEST(BadCommandLine, EndsTheProgramWithOneLineAndCodeOne) {
  testing::internal::CaptureStderr();
  const int code = run_program("fsi-monolithic", [] {
    parse({"a.toml"});
    return 0;
  });
  EXPECT_EQ(code, 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "fsi-monolithic: error: --output: no result folder given; add -o DIR\n");
}

}  // namespace

}  // namespace fsi::test
