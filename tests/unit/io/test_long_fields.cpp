#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/fields_part.hpp"
#include "io/fields_writer.hpp"
#include "io/file_in_place.hpp"
#include "io/last_fields.hpp"
#include "io/write_error.hpp"
#include "io/xdmf.hpp"
#include "sample_fields.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

/// How often a text occurs in an XML document, outside of its processing instructions; -1 if one of them has no end.
int outside_instructions(const std::string& document, const std::string& text) {
  std::string rest;
  for (std::size_t at = 0; at < document.size();) {
    const auto begin = document.find("<?", at);
    rest += document.substr(at, begin - at);
    if (begin == std::string::npos) break;
    const auto end = document.find("?>", begin);
    if (end == std::string::npos) return -1;
    at = end + 2;
  }
  int count = 0;
  for (auto at = rest.find(text); at != std::string::npos; at = rest.find(text, at + 1)) ++count;
  return count;
}

/// A run of more entries than a file holds, one each time unit, and a copy of its folder before its end.
class LongFields : public FolderTest {
 protected:
  static constexpr std::int64_t last_ = FieldsPart::capacity + 12, killed_ = FieldsPart::capacity + 6;
  static inline fs::path runs_;
  const std::vector<FieldGrid> grids_ = sample_grids();

  static FieldPlan plan(std::int64_t last = last_) { return planned_field_steps(last, 1, steps_of(1)); }
  static void write(FieldsWriter& writer, std::int64_t from, std::int64_t to) {
    for (std::int64_t step = from; step <= to; ++step)
      writer.write(step, sample_values(sample_grids(), static_cast<double>(step)));
  }

  static void SetUpTestSuite() {
    runs_ = fs::temp_directory_path() / ("long-fields-" + std::to_string(::getpid()));
    fs::create_directories(runs_ / "whole");
    FieldsWriter writer(runs_ / "whole", sample_grids(), plan());
    write(writer, 0, killed_);
    fs::copy(runs_ / "whole", runs_ / "killed");
    write(writer, killed_ + 1, last_);
  }
  static void TearDownTestSuite() { fs::remove_all(runs_); }

  fs::path new_folder(const std::string& name) const {
    fs::create_directories(folder_ / name);
    return folder_ / name;
  }
  fs::path killed_run(const std::string& name) const {
    fs::copy(runs_ / "killed", folder_ / name);
    return folder_ / name;
  }
  /// Nothing but the files of the run that was not stopped.
  static void expect_whole(const fs::path& folder) {
    for (const auto* file : {"fields.h5", "fields-0002.h5", "fields.xdmf", "fluid.xdmf", "wall.xdmf"})
      EXPECT_TRUE(contents_of(folder / file) == contents_of(runs_ / "whole" / file)) << folder << " " << file;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 5);
  }
};

TEST_F(LongFields, NamesOfParts) {
  EXPECT_EQ(FieldsPart::name(0), "fields.h5");
  EXPECT_EQ(FieldsPart::name(1), "fields-0002.h5");
  for (const std::int64_t part : {0, 1, 41, 12345}) EXPECT_EQ(FieldsPart::number_of(FieldsPart::name(part)), part);
  for (const auto* other : {"fields-0001.h5", "fields-2.h5", "fields-.h5", "fields-00002.h5", "field.h5", "fields.xdmf",
                            "fields-99999999999999999999999.h5"})
    EXPECT_FALSE(FieldsPart::number_of(other)) << other;
}

TEST_F(LongFields, StartTheSameHoweverManyEntriesArePlanned) {
  const auto few = new_folder("few"), many = new_folder("many");
  FieldsWriter(few, grids_, plan(1000));
  int asked = 0;
  FieldsWriter writer(many, grids_, {std::int64_t{1} << 40, [&](std::int64_t entry) {
                                       ++asked;
                                       return FieldStep{entry, static_cast<double>(entry)};
                                     }});
  EXPECT_EQ(asked, FieldsPart::capacity);
  for (const auto* file : {"fields.h5", "fields.xdmf", "fluid.xdmf", "wall.xdmf"})
    EXPECT_EQ(fs::file_size(few / file), fs::file_size(many / file)) << file;
  asked = 0;
  EXPECT_EQ(writer.entry_at(1e6), 1000000);
  EXPECT_FALSE(writer.entry_at(0.5));
  EXPECT_LT(asked, 200);
}

TEST_F(LongFields, HaveAllEntriesInFilesThatAreMadeWhenTheyAreNeeded) {
  const auto run = runs_ / "whole";
  const auto text = contents_of(run / "fields.xdmf");
  EXPECT_EQ(outside_instructions(text, "<Time "), 2 * (last_ + 1));
  EXPECT_EQ(outside_instructions(text, "fields.h5:/wall/displacement/00000255<"), 1);
  EXPECT_EQ(outside_instructions(text, "fields-0002.h5:/wall/displacement/00000256<"), 1);
  const auto first = FieldsPart::entries_of(run / "fields.h5", grids_);
  const auto second = FieldsPart::entries_of(run / "fields-0002.h5", grids_);
  EXPECT_EQ(first.size(), 256u);
  EXPECT_EQ(second.size(), 13u);
  for (const auto& entries : {first, second})
    for (const auto& entry : entries) EXPECT_TRUE(any(entry.fields));
  const auto fresh = new_folder("fresh");
  FieldsWriter writer(fresh, grids_, plan());
  EXPECT_FALSE(fs::exists(fresh / "fields-0002.h5"));
  EXPECT_EQ(fs::file_size(fresh / "fields.h5"), fs::file_size(run / "fields.h5"));
}

TEST_F(LongFields, EndInTheLastFileThatHasAny) {
  auto grids = sample_grids();
  grids.resize(1);
  grids.front().fields = {{"pressure_error", 1, "kPa", true}};
  const auto value_of = [&](const fs::path& run) {
    return last_fields_of_cells(run, {"pressure_error"}).at(0).values.at("pressure_error");
  };
  const auto run = new_folder("run");
  FieldsWriter writer(run, grids, plan());
  for (std::int64_t step = 0; step < FieldsPart::capacity; ++step)
    writer.write(step, {{{"fluid", "pressure_error"}, {static_cast<double>(step), 0.5}}});
  // As a kill leaves it: the next file is there, and has nothing yet.
  const auto next = run / FieldsPart::name(1);
  FieldsPart::prepare(next, grids, {plan().at(FieldsPart::capacity)}, {});
  replace_by_temporary(next);
  EXPECT_EQ(value_of(run), (std::vector<double>{255, 0.5}));
  writer.write(FieldsPart::capacity, {{{"fluid", "pressure_error"}, {7, 8}}});
  EXPECT_EQ(value_of(run), (std::vector<double>{7, 8}));
}

TEST_F(LongFields, GoOnAfterAKillInPlaceAndElsewhere) {
  // The checkpoint is older than the last entries: in an earlier file, at its end, in the same one.
  for (const std::int64_t until : {FieldsPart::capacity - 3, FieldsPart::capacity - 1, FieldsPart::capacity + 2}) {
    const auto run = killed_run("killed-" + std::to_string(until));
    const auto other = new_folder("other-" + std::to_string(until));
    write_text(run / "fields-0003.h5.tmp", "from a kill while it was made");
    {
      FieldsWriter writer(other, grids_, plan(), run, static_cast<double>(until));
      write(writer, until + 1, last_);
    }
    FieldsWriter writer(run, grids_, plan(), run, static_cast<double>(until));
    EXPECT_EQ(outside_instructions(contents_of(run / "fields.xdmf"), "<Time "), 2 * (until + 1));
    write(writer, until + 1, last_);
    expect_whole(run);
    expect_whole(other);
  }
}

TEST_F(LongFields, CloseUpWhereEntriesWereLeftOut) {
  const auto run = new_folder("run");
  {
    FieldsWriter writer(run, grids_, plan());
    for (std::int64_t step = 0; step <= last_; step += 3) write(writer, step, step);
  }
  const std::int64_t kept = last_ / 3 + 1, later = 3 * (kept - 1);
  FieldsWriter writer(run, grids_, planned_field_steps(last_ + 9, 3, steps_of(1)), run, static_cast<double>(later));
  EXPECT_EQ(outside_instructions(contents_of(run / "fields.xdmf"), "<Time "), 2 * kept);
  EXPECT_FALSE(fs::exists(run / "fields-0002.h5"));
  write(writer, later + 3, later + 3);
  for (const auto& entry : FieldsPart::entries_of(run / "fields.h5", grids_))
    EXPECT_EQ(any(entry.fields), entry.step.time <= static_cast<double>(later + 3)) << entry.step.step;
}

// A kill between the moves of a restart: entries stand in two files, and none is lost or listed twice.
TEST_F(LongFields, TakeAnEntryOnceThatStandsInTwoFiles) {
  const auto run = killed_run("run");
  fs::copy_file(run / "fields-0002.h5", run / "fields-0003.h5");
  FieldsWriter writer(run, grids_, plan(), run, static_cast<double>(killed_));
  EXPECT_EQ(outside_instructions(contents_of(run / "fields.xdmf"), "<Time "), 2 * (killed_ + 1));
  write(writer, killed_ + 1, last_);
  expect_whole(run);
}

TEST_F(LongFields, FilesThatAreTouchedWhileTheyAreWrittenAreNoticed) {
  for (const auto* file : {"fields.h5", "fields.xdmf"}) {
    const auto run = new_folder(std::string("touched-") + file);
    FieldsWriter writer(run, grids_, plan());
    write(writer, 0, 1);
    fs::remove(run / file);
    try {
      write(writer, 2, 2);
      ADD_FAILURE() << file;
    } catch (const WriteError& error) {
      EXPECT_EQ(error.what(), (run / file).string() +
                                  ": cannot be written (it has been deleted or moved since the run made it); leave the "
                                  "files of a running computation where they are");
    }
    write_text(run / file, "another one");
    EXPECT_THROW(write(writer, 3, 3), WriteError) << file;
  }
}

class List : public FolderTest {};

// Whatever part of an entry's bytes has been written, the document stays whole and does not list it; one byte does.
TEST_F(List, IsAWholeDocumentAtAnyMoment) {
  const auto grids = sample_grids();
  const FieldFlags all{{1, 1}, {1, 1}};
  const auto entry = [&](std::int64_t i) { return ListedEntry{{{i, 0.5 * static_cast<double>(i)}, all}, "fields.h5"}; };
  const auto file = folder_ / "fields.xdmf";
  XdmfDocument document(file, grids);
  document.replace(1, entry, 100);
  const auto before = contents_of(file);
  EXPECT_EQ(outside_instructions(before, "<Time "), 2);
  document.add(entry(1));
  const auto after = contents_of(file);
  ASSERT_EQ(before.size(), after.size());
  EXPECT_EQ(outside_instructions(after, "<Time "), 4);
  EXPECT_EQ(outside_instructions(after, "<Grid "), outside_instructions(after, "</Grid>"));

  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (before[i] != after[i]) changed.push_back(i);
  std::vector<std::size_t> marks;  // the bytes that put the entry into the lists
  for (const std::size_t i : changed)
    if (after[i] == '?' && before[i] == ' ' && after[i + 1] == '>') marks.push_back(i);
  ASSERT_EQ(marks.size(), 2u);
  auto torn = before;
  for (const std::size_t i : changed) {
    if (i == marks[0] || i == marks[1]) continue;
    torn[i] = after[i];
    ASSERT_EQ(outside_instructions(torn, "<Time "), 2) << i;
  }
  torn[marks[0]] = '?';
  EXPECT_EQ(outside_instructions(torn, "<Time "), 3);
  EXPECT_EQ(outside_instructions(torn, "<Grid "), outside_instructions(torn, "</Grid>"));
}

TEST_F(List, GrowsByDoublingAndIsTheSameWhenItIsMadeAtOnce) {
  const auto grids = sample_grids();
  const FieldFlags all{{1, 1}, {1, 1}};
  const auto entry = [&](std::int64_t i) {
    return ListedEntry{{{i, 0.1 * static_cast<double>(i)}, all}, FieldsPart::name(i / FieldsPart::capacity)};
  };
  const auto grown = folder_ / "grown.xdmf", made = folder_ / "made.xdmf";
  XdmfDocument document(grown, grids);
  document.replace(0, nullptr, 1000);
  int sizes = 1;
  for (std::int64_t i = 0; i < 900; ++i) {
    const auto size = fs::file_size(grown);
    document.add(entry(i));
    sizes += fs::file_size(grown) != size ? 1 : 0;
  }
  EXPECT_EQ(sizes, 3);  // 256, 512 and 1000 slots
  XdmfDocument(made, grids).replace(900, entry, 1000);
  EXPECT_TRUE(contents_of(grown) == contents_of(made));
  EXPECT_EQ(outside_instructions(contents_of(grown), "<Time "), 1800);
}

TEST_F(List, OfOneMediumTakesItsFlagsFromThoseOfAll) {
  const auto grids = sample_grids();
  const auto entry = [&](std::int64_t i) {
    return ListedEntry{{{i, 0.5 * static_cast<double>(i)}, {{1, 1}, {1, i == 1 ? std::uint8_t{0} : std::uint8_t{1}}}},
                       "fields.h5"};
  };
  const auto file = folder_ / "wall.xdmf";
  XdmfDocument document(file, grids, 1);
  document.replace(2, entry, 3);
  document.add(entry(2));
  const auto text = contents_of(file);
  EXPECT_EQ(outside_instructions(text, "<Time "), 3);
  EXPECT_EQ(outside_instructions(text, "CollectionType=\"Temporal\""), 1);
  EXPECT_EQ(outside_instructions(text, "CollectionType=\"Spatial\""), 0);
  EXPECT_EQ(outside_instructions(text, "/wall/displacement/"), 3);
  EXPECT_EQ(outside_instructions(text, "/wall/pressure/"), 2);
  EXPECT_EQ(text.find("/wall/pressure/00000001"), std::string::npos);
  EXPECT_EQ(text.find("/fluid/"), std::string::npos);
  EXPECT_EQ(outside_instructions(text, "<Grid "), outside_instructions(text, "</Grid>"));
}

TEST_F(List, FileInPlaceWritesWithinWhatIsThere) {
  const auto path = folder_ / "file";
  write_text(path, "0123456789");
  const FileInPlace file(path);
  {
    auto opened = file.open();
    opened.write(3, "abc", 3);
    EXPECT_EQ(opened.read(2, 5), "2abc6");
    opened.sync();
    opened.close();
  }
  EXPECT_EQ(contents_of(path), "012abc6789");
  write_text(path, "012abc67890");
  EXPECT_THROW(file.open(), WriteError);
  EXPECT_THROW(FileInPlace(folder_ / "missing"), WriteError);
}

}  // namespace

}  // namespace fsi::test
