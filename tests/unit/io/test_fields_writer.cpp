#include "io/fields_writer.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "sample_fields.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class Fields : public FolderTest {
 protected:
  const std::vector<FieldGrid> grids_ = sample_grids();
  const FieldPlan planned_ = planned_field_steps(20, 8, steps_of(0.125));

  void write(FieldsWriter& writer, std::int64_t step) const {
    writer.write(step, sample_values(grids_, 0.125 * static_cast<double>(step)));
  }
  std::string xdmf() const { return contents_of(folder_ / "fields.xdmf"); }
  bool listed(std::int64_t step) const {
    return xdmf().find("\"step " + std::to_string(step) + "\"") != std::string::npos;
  }
};

TEST(PlannedFieldSteps, HaveTheFirstAndTheLastStep) {
  const auto steps = planned_field_steps(20, 8, steps_of(0.5));
  ASSERT_EQ(steps.entries, 4);
  EXPECT_EQ(steps.at(1).step, 8);
  EXPECT_EQ(steps.at(1).time, 4.0);
  EXPECT_EQ(steps.at(3).step, 20);
  EXPECT_EQ(planned_field_steps(16, 8, steps_of(0.5)).entries, 3);
  EXPECT_EQ(planned_field_steps(16, 0, steps_of(0.5)).entries, 0);
}

TEST(PlannedFieldSteps, HaveFurtherOnesInTheirPlaces) {
  const FieldPlan plan = planned_field_steps(20, 8, steps_of(0.5), {1, 7, 8, 13, 20});
  const std::int64_t steps[] = {0, 1, 7, 8, 13, 16, 20};
  ASSERT_EQ(plan.entries, 7);
  for (std::int64_t entry = 0; entry < plan.entries; ++entry) {
    EXPECT_EQ(plan.at(entry).step, steps[entry]);
    EXPECT_EQ(plan.at(entry).time, 0.5 * static_cast<double>(steps[entry]));
  }
}

TEST_F(Fields, ListOnlyFinishedSteps) {
  FieldsWriter writer(folder_, grids_, planned_);
  EXPECT_EQ(writer.entry_at(1.0), 8);
  EXPECT_FALSE(writer.entry_at(0.875));
  EXPECT_FALSE(listed(0));
  write(writer, 0);
  EXPECT_TRUE(listed(0));
  EXPECT_FALSE(listed(8));
  write(writer, 8);
  EXPECT_TRUE(listed(8));
  EXPECT_NE(xdmf().find("<Time Value=\"1\"/>"), std::string::npos);
  EXPECT_NE(xdmf().find("<Information Name=\"unit of velocity\" Value=\"mm/ms\"/>"), std::string::npos);
}

TEST_F(Fields, RefuseWhatWasNotPlanned) {
  FieldsWriter writer(folder_, grids_, planned_);
  EXPECT_THROW(write(writer, 3), std::logic_error);
  auto values = sample_values(grids_, 0.0);
  values[{"wall", "pressure"}].pop_back();
  EXPECT_THROW(writer.write(0, values), std::logic_error);
}

// Later steps change nothing but the raw data that they own: the file never grows, and the bytes outside them stay. So
// a reader of finished steps is safe whenever the writer is killed.
TEST_F(Fields, OnlyOverwriteRawDataInPlace) {
  FieldsWriter writer(folder_, grids_, planned_);
  write(writer, 0);
  const auto before = contents_of(folder_ / "fields.h5");
  write(writer, 8);
  const auto after = contents_of(folder_ / "fields.h5");
  ASSERT_EQ(before.size(), after.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changed += before[i] != after[i] ? 1 : 0;
  const std::size_t doubles = 5 * 3 + 5 + 6 * 3 + 6, flags = 4;
  EXPECT_GT(changed, 0u);
  EXPECT_LE(changed, 8 * doubles + flags);
}

// Later formats keep the time of day, and HDF5 1.10 does not read them all.
TEST_F(Fields, AreInTheFirstFormatWhateverTheLibrary) {
  FieldsWriter(folder_, grids_, planned_);
  const auto bytes = contents_of(folder_ / "fields.h5");
  ASSERT_GT(bytes.size(), 8u);
  EXPECT_EQ(bytes[8], 0) << "version of the superblock";
}

// A kill in the middle of a write leaves a mixture of the bytes before and after; the listed steps must be readable.
TEST_F(Fields, SurviveAKillInTheMiddleOfAStep) {
  FieldsWriter writer(folder_, grids_, planned_);
  write(writer, 0);
  const auto before = contents_of(folder_ / "fields.h5"), xdmf_before = xdmf();
  write(writer, 8);
  auto torn = contents_of(folder_ / "fields.h5");
  for (std::size_t i = torn.size() / 2; i < torn.size(); ++i) torn[i] = before[i];
  const auto killed = folder_ / "killed", continued = folder_ / "continued";
  fs::create_directories(killed);
  fs::create_directories(continued);
  write_text(killed / "fields.h5", torn);
  write_text(killed / "fields.xdmf", xdmf_before);
  {
    FieldsWriter again(killed, grids_, planned_, killed, 0);
    write(again, 8);
  }
  {
    FieldsWriter reference(continued, grids_, planned_);
    write(reference, 0);
    write(reference, 8);
  }
  EXPECT_EQ(contents_of(killed / "fields.h5"), contents_of(continued / "fields.h5"));
  EXPECT_EQ(contents_of(killed / "fields.xdmf"), contents_of(continued / "fields.xdmf"));
}

TEST_F(Fields, RestartForgetsStepsBehindTheCheckpoint) {
  {
    FieldsWriter writer(folder_, grids_, planned_);
    for (const auto step : {0, 8, 16}) write(writer, step);
  }
  FieldsWriter writer(folder_, grids_, planned_, folder_, 1.25);
  EXPECT_TRUE(listed(0) && listed(8));
  EXPECT_FALSE(listed(16));
  EXPECT_EQ(writer.entry_at(2.0), 16);
  write(writer, 16);
  EXPECT_TRUE(listed(16));
}

TEST_F(Fields, RestartExtendsTheRunInAnotherFolder) {
  const auto other = folder_ / "other";
  fs::create_directories(other);
  {
    FieldsWriter writer(folder_, grids_, planned_);
    for (const auto step : {0, 8, 16, 20}) write(writer, step);
  }
  const auto before = contents_of(folder_ / "fields.h5");
  {
    FieldsWriter writer(other, grids_, planned_field_steps(32, 4, steps_of(0.125)), folder_, 2.5);
    write(writer, 24);
    const auto text = contents_of(other / "fields.xdmf");
    EXPECT_NE(text.find("\"step 20\""), std::string::npos);
    EXPECT_NE(text.find("\"step 24\""), std::string::npos);
    EXPECT_EQ(text.find("\"step 4\""), std::string::npos);  // was never written
  }
  EXPECT_EQ(contents_of(folder_ / "fields.h5"), before);
}

TEST_F(Fields, RestartNumbersEntriesBehindThoseThatAreKept) {
  {
    FieldsWriter writer(folder_, grids_, planned_);
    for (const auto step : {0, 8, 16}) write(writer, step);
  }
  // Planned by time from here on, the numbers count entries.
  FieldsWriter writer(folder_, grids_, plan_of({{0, 0.0}, {1, 1.5}, {2, 2.25}, {3, 3.0}}), folder_, 2.0);
  EXPECT_TRUE(listed(0) && listed(8) && listed(16));
  EXPECT_FALSE(writer.entry_at(1.5));
  EXPECT_EQ(writer.entry_at(2.0), 16);
  EXPECT_EQ(writer.entry_at(2.25), 17);
  EXPECT_EQ(writer.entry_at(3.0), 18);
  write(writer, 18);
  EXPECT_TRUE(listed(18));
}

TEST_F(Fields, RestartWithMoreFieldsListsWhatEachStepHas) {
  auto fewer = grids_;
  fewer[0].fields.pop_back();
  {
    FieldsWriter writer(folder_, fewer, planned_);
    writer.write(0, sample_values(fewer, 0.0));
  }
  FieldsWriter writer(folder_, grids_, planned_, folder_, 0);
  EXPECT_EQ(xdmf().find("/fluid/pressure/00000000"), std::string::npos);
  EXPECT_NE(xdmf().find("/fluid/velocity/00000000"), std::string::npos);
  write(writer, 8);
  EXPECT_NE(xdmf().find("/fluid/pressure/00000008"), std::string::npos);
}

TEST_F(Fields, RestartRefusesAnotherMeshAndDamage) {
  { FieldsWriter writer(folder_, grids_, planned_); }
  auto other = grids_;
  other[1].points.push_back({9, 9, 9});
  try {
    FieldsWriter writer(folder_, other, planned_, folder_, 0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(),
              (folder_ / "fields.h5").string() + ": wall: has 6 points, not 7; restart from a run on the same mesh");
  }
  write_text(folder_ / "fields.h5", "no HDF5");
  EXPECT_THROW(FieldsWriter(folder_, grids_, planned_, folder_, 0), InputError);
}

TEST_F(Fields, RestartWithoutEarlierFieldsStartsAfresh) {
  FieldsWriter writer(folder_, grids_, planned_, folder_ / "nothing", 1.0);
  write(writer, 16);
  EXPECT_TRUE(listed(16));
}

TEST_F(Fields, CannotBeWrittenIntoAMissingFolder) {
  EXPECT_THROW(FieldsWriter(folder_ / "missing", grids_, planned_), InputError);
}

}  // namespace

}  // namespace fsi::test
