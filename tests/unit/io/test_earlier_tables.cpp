#include "io/earlier_tables.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "base/error.hpp"
#include "io/result_folder.hpp"
#include "sample_tables.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

const std::vector<double> centre{0, 0.5, 1}, wall{0, 1};
const ResultTable surfaces_table{
    "surfaces.csv", "time_ms,surface,area_mm2,force_mN", RowsPer::within_step, {"wall", "3"}};
std::vector<ResultTable> earlier_tables(const std::vector<double>& wall_z = wall) {
  return {steps_table, centre_table(centre), wall_table(wall_z), flow_table, energy_table, surfaces_table};
}

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
    ResultFolder results(folder_ / "run", earlier_tables(), {});
    for (int k = 1; k <= written; ++k) {
      const double time = 0.1 * k;
      const std::vector<double> lead{1.0 * k, time};
      results.write({iterations_file, lead, {{3, 0.5}}});
      results.write({"energy.csv", lead, {{0.0}}});
      results.write({"centerline_pressure.csv", {time}, {{centre[0], 1000.0 * k}, {centre[1], 2}, {centre[2], 3}}});
      results.write({"wall_displacement.csv", {time}, {{wall[0], 0.25 * k, 1e-320}, {wall[1], 0, -1e300}}});
      results.write({"flow.csv", {time}, {{1.0 * k, 3000}}});
      results.write({"surfaces.csv", {time - 0.05}, {{1, 1.0 * k}, {2, 4}}});
      if (k == step) {
        results.take_digests();
        digests_ = results.digests();
      }
    }
  }

  EarlierSteps steps(int levels = step) const { return {step, 0.1 * step, levels}; }
  EarlierTables read(const EarlierSteps& earlier) const {
    return EarlierTables(folder_ / "run", earlier_tables(), earlier);
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
  EXPECT_EQ(found.last_level("flow.csv"), (std::vector<double>{4, 3000}));
  EXPECT_EQ(found.last_level("wall_displacement.csv"), (std::vector<double>{0, 1, 1e-320, 1, 0, -1e300}));
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
  EXPECT_EQ(found.last_level("flow.csv").at(0), 3);
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
  EXPECT_EQ(lines_of(folder_ / "run" / "surfaces.csv").at(3), "0.15000000000000002,wall,1,2");
  const auto replaced_by = [&](const std::string& row) {
    return said_of("surfaces.csv", [&](Lines& lines) { lines[4] = row; });
  };
  EXPECT_EQ(replaced_by("0.15000000000000002,3,2,4"), "");
  EXPECT_NE(replaced_by("0.15000000000000002,wall,2,4"), "");
  EXPECT_NE(replaced_by("0.15000000000000002,1,2,4"), "") << "a place is no name";
  EXPECT_NE(replaced_by("0.16,3,2,4"), "") << "another time than the row before";
  EXPECT_NE(replaced_by("wall,3,2,4"), "") << "names stand in the second column";
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
  const auto seconds = [](Lines& lines) { lines[2].replace(lines[2].find(",0.5"), 4, ",0.75"); };
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
  try {
    EarlierTables(folder_ / "run", earlier_tables({0, 1.5}), steps());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 3: is of z = 1 mm, not 1.5"), std::string::npos) << error.what();
  }
  EXPECT_NE(said_of("iterations.csv", [](Lines& lines) { lines[2].replace(0, 5, "2,0.1"); }), "");
  EXPECT_NE(said_of("energy.csv", [](Lines& lines) { lines[2].replace(0, 5, "2,0.3"); }), "");
}

TEST_F(Tables, ThatAreNoFilesAreRefused) {
  fs::remove(folder_ / "run" / "flow.csv");
  EXPECT_THROW(read(steps()), InputError);
  fs::create_directories(folder_ / "run" / "flow.csv");
  EXPECT_THROW(read(steps()), InputError);
  EXPECT_THROW(EarlierTables(folder_ / "missing", earlier_tables(), steps()), InputError);
}

}  // namespace

}  // namespace fsi::test
