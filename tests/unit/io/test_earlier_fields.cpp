#include "io/earlier_fields.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/hdf5_file.hpp"
#include "sample_fields.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class EarlierFields : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    FieldsWriter fields(folder_, sample_grids(), planned_field_steps(8, 2, steps_of(0.5)));
    for (const std::int64_t step : {0, 2, 4})
      fields.write(step, sample_values(sample_grids(), 0.5 * static_cast<double>(step)));
  }
  std::int64_t entries(double until) const { return checked_field_entries(folder_, sample_grids(), until); }
};

TEST_F(EarlierFields, AreCountedUpToATime) {
  EXPECT_EQ(entries(0), 1);
  EXPECT_EQ(entries(1), 2);
  EXPECT_EQ(entries(100), 3) << "planned ones do not count";
  EXPECT_EQ(checked_field_entries(folder_ / "missing", sample_grids(), 1), 0);
}

TEST_F(EarlierFields, OfCellsAndTensorsAreTaken) {
  auto grids = sample_grids();
  grids[1].fields = {{"stress", 6, "kPa", true}, {"mises", 1, "kPa", true}, {"strain", 6, ""}};
  const auto folder = folder_ / "cells";
  fs::create_directories(folder);
  {
    FieldsWriter fields(folder, {grids[1]}, planned_field_steps(2, 1, steps_of(0.5)));
    fields.write(0, {{{"wall", "stress"}, std::vector<double>(3 * 6)},
                     {{"wall", "mises"}, std::vector<double>(3)},
                     {{"wall", "strain"}, std::vector<double>(6 * 6)}});
    EXPECT_THROW(fields.write(1, {{{"wall", "stress"}, std::vector<double>(6 * 6)},
                                  {{"wall", "mises"}, std::vector<double>(3)},
                                  {{"wall", "strain"}, std::vector<double>(6 * 6)}}),
                 std::logic_error)
        << "as many values as nodes";
  }
  EXPECT_EQ(checked_field_entries(folder, sample_grids(), 1), 1);
}

TEST_F(EarlierFields, ThatARestartWouldLoseAreRefused) {
  std::vector<std::string> all;
  for (const auto& grid : sample_grids())
    for (const auto& field : grid.fields) all.push_back(grid.name + "." + field.name);
  EXPECT_NO_THROW(require_no_lost_fields(folder_, all, 100));
  const auto lost = all.back();
  all.back() = "fluid.another";
  EXPECT_NO_THROW(require_no_lost_fields(folder_, all, -1)) << "no entry is that early";
  try {
    require_no_lost_fields(folder_, all, 0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder_ / "fields.h5").string() + ": " + lost +
                  ": is a field that this restart does not write, and would remove; ask for it in output.fields, or "
                  "continue in another folder: -o DIR");
  }
}

TEST_F(EarlierFields, OfAnotherMeshAreRefused) {
  auto grids = sample_grids();
  grids[0].points[2][1] *= 1 + 1e-15;
  EXPECT_THROW(checked_field_entries(folder_, grids, 1), InputError);
  grids = sample_grids();
  grids[1].cells.resize(8);
  EXPECT_THROW(checked_field_entries(folder_, grids, 1), InputError);
}

TEST_F(EarlierFields, ThatAreDamagedAreRefused) {
  const auto whole = contents_of(folder_ / "fields.h5");
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write_text(folder_ / "fields.h5", whole.substr(0, size));
    EXPECT_THROW(entries(1), InputError) << size;
  }
  write_text(folder_ / "fields.h5", whole);
  EXPECT_NO_THROW(entries(1));
  const double times[] = {0, 1, 1, 3, 4};
  auto file = Hdf5File::open(folder_ / "fields.h5", true);
  file.write("/steps/time", times);
  file.close();
  EXPECT_THROW(entries(1), InputError) << "a time twice";
}

}  // namespace

}  // namespace fsi::test
