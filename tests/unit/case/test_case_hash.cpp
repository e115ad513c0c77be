#include "case/case_hash.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

Case example() {
  Case scene;
  scene.fluid = FluidData{1.0, 3.5e-3, false};
  scene.structure.emplace();
  scene.structure->layers["media"] = {"neo-hookean", 3.0, 0, 0, 0, 0, 1};
  scene.inlet = PressureTable{{{0, 1.332}}};
  scene.time = TimeData{0.125, 12.0, 1, 1, 1};
  return scene;
}

TEST(CaseHash, IgnoresWhatMayChangeOnRestart) {
  auto scene = example();
  const auto hash = hash_of_case(scene);
  scene.title = "extended";
  scene.time->end = 24.0;
  scene.time->predictor = 0;
  scene.mesh.file = "elsewhere.msh";
  scene.output.every = 1;
  scene.partitioned.relaxation = 0.1;
  scene.monolithic.mode = "full";
  scene.economy.constant_operators = "rebuilt";
  EXPECT_EQ(hash_of_case(scene), hash);
}

TEST(CaseHash, NoticesWhatChangesTheEquations) {
  const auto hash = hash_of_case(example());
  const auto changed = [&](auto change) {
    auto scene = example();
    change(scene);
    return hash_of_case(scene) != hash;
  };
  EXPECT_TRUE(changed([](Case& c) { c.fluid->density += 1e-15; }));
  EXPECT_TRUE(changed([](Case& c) { c.structure->layers["media"].c10 = 3.1; }));
  EXPECT_TRUE(changed([](Case& c) { c.structure->layers["adventitia"] = c.structure->layers["media"]; }));
  EXPECT_TRUE(changed([](Case& c) { c.inlet->points[0].second = 1; }));
  EXPECT_TRUE(changed([](Case& c) { c.time->step = 0.0625; }));
  EXPECT_TRUE(changed([](Case& c) { c.structure.reset(); }));
}

TEST(Hash, HasThePublishedValues) {
  // From the test suite of the algorithm's authors, http://www.isthe.com/chongo/src/fnv/test_fnv.c
  Fnv1a empty, a, foobar;
  a.add("a");
  foobar.add("foo");
  foobar.add("bar");
  EXPECT_EQ(empty.hex(), "cbf29ce484222325");
  EXPECT_EQ(a.hex(), "af63dc4c8601ec8c");
  EXPECT_EQ(foobar.hex(), "85944171f73967e8");
}

class FileHash : public FolderTest {};

TEST_F(FileHash, IsThatOfTheBytes) {
  write_text(folder_ / "file", "foobar");
  EXPECT_EQ(hash_of_file(folder_ / "file"), "85944171f73967e8");
  EXPECT_THROW(hash_of_file(folder_ / "missing"), InputError);
}

}  // namespace

}  // namespace fsi::test
