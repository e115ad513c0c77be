#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case_reader.hpp"
#include "example_cases.hpp"

namespace fsi::test {

namespace {

/// The message of read_case(); "" when the file is read.
std::string complaint_about_file(const std::filesystem::path& file) {
  try {
    read_case(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(HostileCase, IsNoRegularFile) {
  EXPECT_EQ(complaint_about_file("/dev/zero"),
            "/dev/zero: is a pipe, socket or device, not a file; give the path of a case file");
  const auto pipe = std::filesystem::path(testing::TempDir()) / ("case_pipe_" + std::to_string(getpid()));
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(complaint_about_file(pipe),
            pipe.string() + ": is a pipe, socket or device, not a file; give the path of a case file");
  std::filesystem::remove(pipe);
}

TEST(HostileCase, CannotBeRead) {
  EXPECT_EQ(complaint_about_file("/proc/self/mem"), "/proc/self/mem: cannot be read; check its permissions");
}

TEST(HostileCase, IsTooLarge) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("case_large_" + std::to_string(getpid()));
  std::ofstream(file).put('#');
  std::filesystem::resize_file(file, std::uintmax_t{3} << 30);  // sparse
  EXPECT_EQ(complaint_about_file(file),
            file.string() + ": has 3221225472 bytes, where at most 16777216 are read; give the path of a case file");
  std::filesystem::remove(file);
}

/// The message of parse_case(); "" when the text is read.
std::string complaint_about_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "case.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(HostileCase, KeyOfManyParts) {
  std::string deep = "a";
  for (int i = 0; i < 200'000; ++i) deep += i % 2 == 0 ? ".a" : " . \"b.\"";
  const std::string expected = ": a key of more than 16 parts; see --help-keys for valid keys";
  EXPECT_EQ(complaint_about_text(coupled_case + deep + " = 1\n"), "case.toml:36" + expected);
  EXPECT_EQ(complaint_about_text(coupled_case + "[" + deep + "]\n"), "case.toml:36" + expected);
  EXPECT_EQ(complaint_about_text(coupled_case + "x = {" + deep + " = 1}\n"), "case.toml:36" + expected);
  EXPECT_EQ(complaint_about_text(coupled_case, {std::string(100, '.') + "=1"}).substr(0, 8), "--set: .");
  // Dots that are no parts of keys.
  EXPECT_EQ(complaint_about_text("# " + deep + "\n" + coupled_case), "");
  EXPECT_EQ(complaint_about_text(with(coupled_case, "a coupled case", std::string(100, '.'))), "");
  EXPECT_EQ(complaint_about_text(with(coupled_case, "\"a coupled case\"", "'" + std::string(100, '.') + "'")), "");
  EXPECT_EQ(complaint_about_text(coupled_case, {"mesh.file=" + std::string(100, '.')}), "");
}

TEST(HostileCase, TitleThatIsNoLine) {
  EXPECT_EQ(complaint_about_text(with(coupled_case, "a coupled case", "\\u001b[2J")).substr(0, 20),
            "case.toml:1: title: ");
  EXPECT_EQ(complaint_about_text(with(coupled_case, "a coupled case", std::string(1001, 'x'))).substr(0, 20),
            "case.toml:1: title: ");
}

TEST(HostileCase, OutputTimesWithoutEnd) {
  EXPECT_EQ(complaint_about_text(coupled_case, {"output.interval=1e-9"}),
            "--set: output.interval: 1e-09 would end 1.2e+10 steps for the sake of output; give at least 1.2e-05");
}

TEST(HostileCase, AdaptiveStepsWithoutProgress) {
  for (const std::string key : {"first_step", "smallest_step"})
    EXPECT_EQ(complaint_about_text(coupled_case, {"time.step=adaptive", "time." + key + "=1e-12"}),
              "--set: time." + key + ": 1e-12 is less than 1e-09 of the end, 12; give at least 1.2e-08");
}

/// Paths of all keys that are no sections, from the help for users.
std::vector<std::string> keys_of_help() {
  std::vector<std::string> keys;
  std::istringstream help(case_keys_help());
  std::string line;
  std::getline(help, line);
  while (std::getline(help, line)) {
    const auto key = line.substr(2, line.find(' ', 2) - 2);
    if (key.front() == '[' || key == "monolithic.multigrid" || key == "structure.layers") continue;
    keys.push_back(std::regex_replace(key, std::regex("NAME"), "media"));
  }
  return keys;
}

TEST(HostileCase, NoKeyTakesNumbersBeyondAnyLimit) {
  const auto keys = keys_of_help();
  ASSERT_GT(keys.size(), 60u);
  for (const auto& key : keys)
    for (const std::string value : {"9223372036854775807", "-9223372036854775808", "1e300", "-1e300", "nan", "inf",
                                    "2147483648", "-2147483649"}) {
      // What is a name or a switch has another type; a whole number may be a real one.
      const auto said = complaint_about_text(coupled_case, {key + "=" + value});
      if (said.empty() && value.find_first_of("en") == std::string::npos) continue;
      EXPECT_TRUE(std::regex_search(said, std::regex("^(--set|case.toml:[0-9]+): [a-z]"))) << said;
      EXPECT_NE(said.find(key.substr(0, key.find('.'))), std::string::npos) << said;
    }
}

TEST(HostileCase, WholeNumbersStateTheirLimits) {
  int whole = 0;
  for (const auto& key : keys_of_help()) {
    const auto said = complaint_about_text(coupled_case, {key + "=\"many\""});
    if (said.find("give a whole number") == std::string::npos) continue;
    ++whole;
    EXPECT_TRUE(std::regex_search(said, std::regex("give a whole number from [0-9]+ to [0-9]+"))) << said;
    for (const std::string value : {"2147483647", "2147483648", "9223372036854775807", "-1"})
      EXPECT_NE(complaint_about_text(coupled_case, {key + "=" + value}).find("give a whole number from "),
                std::string::npos)
          << key << "=" << value;
  }
  EXPECT_GE(whole, 17);
}

}  // namespace

}  // namespace fsi::test
