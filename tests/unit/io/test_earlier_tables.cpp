#include "io/earlier_tables.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "base/error.hpp"
#include "io/result_folder.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

const ResultTables earlier_tables{true, true, true, false, EnergyParts{true, true}, {}, {"wall", "3"}};
const std::vector<double> centre{0, 0.5, 1}, wall{0, 1};

using Lines = std::vector<std::string>;

Lines lines_of(const fs::path& file) {
  Lines lines;
  std::istringstream text(contents_of(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

class Tables : public FolderTest {
 protected:
  static constexpr int written = 5, step = 4;  // the checkpoint is of step 4

  void SetUp() override {
    FolderTest::SetUp();
    ResultFolder results(folder_ / "run", earlier_tables);
    for (int k = 1; k <= written; ++k) {
      const double time = 0.1 * k;
      results.write_iterations({k, time, 1, 3, 0, 0.5, 1e-4});
      results.write_energy({k, time, 1, 3, 0, 0.5, 1e-4}, EnergyRecord());
      results.write_centerline(time, {{centre[0], 1.0 * k}, {centre[1], 2}, {centre[2], 3}});
      results.write_wall(time, {{wall[0], 0.25 * k, 1e-320}, {wall[1], 0, -1e300}});
      results.write_flow(time, {1.0 * k, 2, 3, 4});
      results.write_surfaces(time - 0.05, {{"wall", 1, {1.0 * k, 2, 3}, {1, 2, 3}}, {"3", 2, {4, 5, 6}, {}}});
      if (k == step) {
        results.take_digests();
        digests_ = results.digests();
      }
    }
  }

  EarlierSteps steps(int levels = step) const { return {step, 0.1 * step, levels, centre, wall}; }
  EarlierTables read(const EarlierSteps& earlier) const {
    return EarlierTables(folder_ / "run", earlier_tables, earlier);
  }

  void change(const std::string& file, const std::function<void(Lines&)>& what) {
    Lines lines = lines_of(folder_ / "run" / file);
    what(lines);
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    write_text(folder_ / "run" / file, text);
  }
  /// What is said of a table with changed lines; restores it.
  std::string said_of(const std::string& file, const std::function<void(Lines&)>& what, const EarlierSteps& earlier) {
    const std::string before = contents_of(folder_ / "run" / file);
    change(file, what);
    std::string said;
    try {
      read(earlier);
    } catch (const InputError& error) {
      said = error.what();
      EXPECT_EQ(said.rfind((folder_ / "run" / file).string() + ": ", 0), 0u) << said;
    }
    write_text(folder_ / "run" / file, before);
    return said;
  }
  std::string said_of(const std::string& file, const std::function<void(Lines&)>& what) {
    return said_of(file, what, steps());
  }

  TableDigests digests_;
};

TEST_F(Tables, AreTakenOverUpToTheCheckpoint) {
  write_text(folder_ / "run" / "flow.csv", contents_of(folder_ / "run" / "flow.csv") + "0.6,1,2");  // torn by a kill
  EarlierSteps earlier = steps();
  earlier.digests = digests_;
  const EarlierTables found = read(earlier);
  EXPECT_EQ(found.times(), (std::vector<double>{0.1, 0.2, 0.1 * 3, 0.4}));
  EXPECT_EQ(found.last_level("flow.csv"), (std::vector<double>{0.4, 4, 2, 3000, 4000}));
  EXPECT_EQ(found.last_level("wall_displacement.csv"), (std::vector<double>{0.4, 0, 1, 1e-320, 0.4, 1, 0, -1e300}));
  fs::create_directories(folder_ / "copy");
  found.copy_to(folder_ / "copy");
  for (const auto* file :
       {"centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "iterations.csv", "energy.csv"}) {
    const std::string whole = contents_of(folder_ / "run" / file), part = contents_of(folder_ / "copy" / file);
    EXPECT_EQ(whole.rfind(part, 0), 0u) << file;
    EXPECT_EQ(whole[part.size()] == '5' || whole.compare(part.size(), 4, "0.5,") == 0, true) << file;
  }
  found.copy_to(folder_ / "run");
  EXPECT_EQ(contents_of(folder_ / "run" / "flow.csv"), contents_of(folder_ / "copy" / "flow.csv"));
}

TEST_F(Tables, OfSchemesWhosePressuresLagEndOneLevelEarlier) {
  const EarlierTables found = read(steps(step - 1));
  EXPECT_EQ(found.last_level("flow.csv").at(1), 3);
  EXPECT_NO_THROW(read(steps(0)));
}

TEST_F(Tables, WithARowTooFewOrTooManyAreRefused) {
  for (const std::string file : {"centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "iterations.csv",
                                 "energy.csv", "surfaces.csv"}) {
    const auto rows = static_cast<std::ptrdiff_t>(file[0] == 'c' ? 3 : file[0] == 'w' || file[0] == 's' ? 2 : 1);
    for (std::ptrdiff_t row = 1; row <= rows * step; ++row) {
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines.erase(lines.begin() + row); }), "") << file << row;
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines.insert(lines.begin() + row, lines[row]); }), "") << file << row;
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines.push_back(lines[row]); }), "") << file << row;
      if (row < rows * step) {
        EXPECT_NE(said_of(file, [&](Lines& lines) { std::swap(lines[row], lines[row + 1]); }), "") << file << row;
      }
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines[row] = ""; }), "") << file << row;
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines[row] += ",0"; }), "") << file << row;
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines[row].replace(lines[row].rfind(',') + 1, 9, "nan"); }), "");
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines[row].replace(lines[row].rfind(',') + 1, 9, "1e999"); }), "");
      EXPECT_NE(said_of(file, [&](Lines& lines) { lines[row].replace(lines[row].rfind(',') + 1, 9, "x"); }), "");
    }
    EXPECT_NE(said_of(file, [&](Lines& lines) { lines.resize(static_cast<std::size_t>(rows) * step); }), "") << file;
    EXPECT_NE(said_of(file, [](Lines& lines) { lines.clear(); }), "") << file;
    EXPECT_NE(said_of(file, [](Lines& lines) { lines[0] += ",more"; }), "") << file;
    EXPECT_NE(said_of(file, [](Lines& lines) { lines[2] = std::string(100000, '1'); }), "") << file;
    EXPECT_EQ(said_of(file, [](Lines& lines) { lines.push_back("what a kill, or a full disk, may leave"); }), "");
    EXPECT_EQ(said_of(file, [](Lines&) {}), "") << file;
  }
}

TEST_F(Tables, OfSurfacesHaveARowForEachNameAtOneTimeInTheStep) {
  EXPECT_EQ(contents_of(folder_ / "run" / "surfaces.csv").substr(0, 14), "time_ms,surfac");
  EXPECT_EQ(lines_of(folder_ / "run" / "surfaces.csv").at(3), "0.15000000000000002,wall,1,2,2,3,1,2,3,1,0,0");
  const auto replaced_by = [&](const std::string& row) {
    return said_of("surfaces.csv", [&](Lines& lines) { lines[4] = row; });
  };
  EXPECT_EQ(replaced_by("0.15000000000000002,3,2,4,5,6,0,0,0,4,5,6"), "");
  EXPECT_NE(replaced_by("0.15000000000000002,wall,2,4,5,6,0,0,0,4,5,6"), "");
  EXPECT_NE(replaced_by("0.15000000000000002,1,2,4,5,6,0,0,0,4,5,6"), "") << "a place is no name";
  EXPECT_NE(replaced_by("0.16,3,2,4,5,6,0,0,0,4,5,6"), "") << "another time than the row before";
  EXPECT_NE(replaced_by("wall,3,2,4,5,6,0,0,0,4,5,6"), "") << "names stand in the second column";
}

TEST_F(Tables, OfAnotherRunAreKnownByTheirDigests) {
  EarlierSteps earlier = steps();
  earlier.digests = digests_;
  EXPECT_EQ(said_of(
                "flow.csv", [](Lines&) {}, earlier),
            "");
  const auto digit = [](Lines& lines) { lines[1].back() = '7'; };
  EXPECT_EQ(said_of("flow.csv", digit), "") << "in order but for the digest";
  EXPECT_NE(said_of("flow.csv", digit, earlier).find("not those that the run wrote"), std::string::npos);
  const auto seconds = [](Lines& lines) { lines[2].replace(lines[2].find(",0.5,"), 5, ",0.75,"); };
  EXPECT_EQ(said_of("iterations.csv", seconds, earlier), "") << "times of the clock do not count";
  const auto iterations = [](Lines& lines) { lines[2].replace(lines[2].find(",3,"), 3, ",4,"); };
  EXPECT_NE(said_of("iterations.csv", iterations, earlier), "");
}

TEST_F(Tables, AgreeWithTheCheckpointAboutTimes) {
  EarlierSteps other = steps();
  other.time = 0.41;
  EXPECT_NE(said_of(
                "iterations.csv", [](Lines&) {}, other)
                .find("step 4 ends at 0.4 here and at 0.41"),
            std::string::npos);
  other = steps();
  other.wall_z = {0, 1.5};
  EXPECT_NE(said_of(
                "wall_displacement.csv", [](Lines&) {}, other)
                .find("line 3: is of z = 1 mm, not 1.5"),
            std::string::npos);
  EXPECT_NE(said_of("iterations.csv", [](Lines& lines) { lines[2].replace(0, 5, "2,0.1"); }), "");
  EXPECT_NE(said_of("energy.csv", [](Lines& lines) { lines[2].replace(0, 5, "2,0.3"); }), "");
}

TEST_F(Tables, ThatAreNoFilesAreRefused) {
  fs::remove(folder_ / "run" / "flow.csv");
  EXPECT_THROW(read(steps()), InputError);
  fs::create_directories(folder_ / "run" / "flow.csv");
  EXPECT_THROW(read(steps()), InputError);
  EXPECT_THROW(EarlierTables(folder_ / "missing", earlier_tables, steps()), InputError);
}

}  // namespace

}  // namespace fsi::test
