// [output.points], [output.lines.NAME] and [output.planes.NAME].

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"

namespace fsi::test {

namespace {

const std::string scene = R"(
[mesh]
level = "coarse"
[fluid]
density = 1
viscosity = 3.5e-3
[inlet]
pressure = 1
[time]
step = 1
end = 2
)";

Case with(const std::string& samples, const std::vector<std::string>& overrides = {}) {
  return parse_case(scene + samples, "case.toml", overrides);
}

void expect_refused(const std::string& samples, const std::string& key, const std::string& problem) {
  try {
    with(samples);
    ADD_FAILURE() << "accepted: " << samples;
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find(key), std::string::npos) << said;
    EXPECT_NE(said.find(problem), std::string::npos) << said;
  }
}

TEST(SampleKeys, AreReadByName) {
  const auto samples = with(R"(
[output.points]
mid = [0, 0, 9]
wall-1 = [1.5, 0.0, 3.25]
[output.lines.across]
from = [-1, 0, 2]
to = [1, 0, 2]
points = 11
[output.lines.along]
centerline = ["inlet", "outlet"]
[output.planes.mid]
origin = [0, 0, 9]
normal = [0, 0, 2]
)",
                            {"output.points.late=[0, 0, 17]", "output.lines.across.points=3"})
                           .output.samples;
  EXPECT_EQ(samples.points.size(), 3u);
  EXPECT_EQ(samples.points.at("wall-1"), (Point{1.5, 0, 3.25}));
  EXPECT_EQ(samples.points.at("late"), (Point{0, 0, 17}));
  EXPECT_EQ(samples.lines.at("across").to, (Point{1, 0, 2}));
  EXPECT_EQ(samples.lines.at("across").points, 3);
  EXPECT_FALSE(samples.lines.at("across").is_centre_line());
  EXPECT_EQ(samples.lines.at("along").centerline, (std::vector<std::string>{"inlet", "outlet"}));
  EXPECT_EQ(samples.lines.at("along").points, 181);
  EXPECT_EQ(samples.planes.at("mid").normal, (Point{0, 0, 2}));
}

TEST(SampleKeys, DoNotChangeWhatACheckpointIsOf) {
  EXPECT_EQ(hash_of_case(with("")), hash_of_case(with("[output.points]\na = [0, 0, 1]\n")));
}

TEST(SampleKeys, MistakesAreNamed) {
  expect_refused("[output.points]\n\"a,b\" = [0, 0, 1]\n", "output.points.a,b", "cannot be the name");
  expect_refused("[output.points]\na = [0, 1]\n", "output.points.a", "is no point");
  expect_refused("[output.points]\na = 3\n", "output.points.a", "array");
  expect_refused("[output.lines.a]\nfrom = [0, 0, 1]\n", "output.lines.a", "lacks its end");
  expect_refused("[output.lines.a]\npoints = 3\n", "output.lines.a", "where the line runs");
  expect_refused("[output.lines.a]\nfrom = [0, 0, 1]\nto = [0, 0, 1]\n", "output.lines.a.to", "begins at");
  expect_refused("[output.lines.a]\nfrom = [0, 0, 1]\nto = [0, 0, 2]\npoints = 1\n", "output.lines.a.points", "1");
  expect_refused("[output.lines.a]\nfrom = [0, 0, 1]\ncenterline = [\"inlet\", \"outlet\"]\n", "output.lines.a.from",
                 "beside centerline");
  expect_refused("[output.lines.a]\ncenterline = [\"inlet\"]\n", "output.lines.a.centerline", "no pair");
  expect_refused("[output.lines.a]\ncenterline = [\"inlet\", \"inlet\"]\n", "output.lines.a.centerline", "one opening");
  expect_refused("[output.lines.a]\nform = [0, 0, 1]\n", "output.lines.a.form", "from");
  expect_refused("[output.planes.a]\norigin = [0, 0, 1]\n", "output.planes.a", "normal");
  expect_refused("[output.planes.a]\norigin = [0, 0, 1]\nnormal = [0, 0, 0]\n", "output.planes.a.normal",
                 "no direction");
}

}  // namespace

}  // namespace fsi::test
