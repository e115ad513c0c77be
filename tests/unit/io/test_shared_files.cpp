/// Files that several processes write together: the same as one process writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "io/checkpoint.hpp"
#include "io/fields_writer.hpp"
#include "io/first_process.hpp"
#include "io/write_error.hpp"
#include "sample_fields.hpp"
#include "support/shared_folder.hpp"
#include "support/shared_nodes.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

/// What action() says when it throws an Error, with "write error: " before one of that kind.
template <class Action>
std::string said(Action action) {
  try {
    action();
  } catch (const WriteError& error) {
    return std::string("write error: ") + error.what();
  } catch (const InputError& error) {
    return error.what();
  } catch (const ConvergenceError& error) {
    return std::string("not converged: ") + error.what();
  } catch (const OutOfMemory& error) {
    return std::string("no memory: ") + error.what();
  }
  return "";
}

using FirstProcesses = SharedFolderTest;

TEST_F(FirstProcesses, FailuresOfOneAreThoseOfAll) {
  const int last = processes_.size() - 1;
  const auto fail = [&](auto error) {
    return [&, error] {
      do_together(processes_, [&] {
        if (processes_.rank() == last) throw error;
      });
    };
  };
  const std::string remedy(700, 'x');
  EXPECT_EQ(said(fail(InputError("f.toml", "key", "is wrong", remedy))), "f.toml: key: is wrong; " + remedy);
  EXPECT_EQ(said(fail(ConvergenceError("no solution", "less"))), "not converged: no solution; try less");
  const OutOfMemory memory("7 GiB asked");
  EXPECT_EQ(said(fail(memory)), std::string("no memory: ") + memory.what());
  const WriteError full("run/flow.csv", ENOSPC, "part");
  EXPECT_EQ(said(fail(full)), std::string("write error: ") + full.what());
  EXPECT_EQ(said([&] {
              try {
                fail(full)();
              } catch (const WriteError& error) {
                throw error.then("again");
              }
            }),
            std::string("write error: ") + full.then("again").what());
}

TEST_F(FirstProcesses, TellsLaterOfItsFailure) {
  FirstProcess first(processes_);
  int done = 0;
  const auto fail = [] { throw WriteError("flow.csv", ENOSPC); };
  if (processes_.is_alone()) {
    EXPECT_THROW(first.later(fail), WriteError);
    EXPECT_NO_THROW(first.agree());
    return;
  }
  first.later([&] { ++done; });
  EXPECT_NO_THROW(first.agree());
  first.later(fail);
  first.later([&] { ++done; });  // not any more
  EXPECT_THROW(first.agree(), WriteError);
  EXPECT_NO_THROW(first.agree());
  EXPECT_EQ(done, processes_.is_first() ? 1 : 0);
}

constexpr int whole = 23;
int scattered(int node) {
  return (node * 7 / 3) % Communicator::world().size();
}
int in_a_row(int node) {  // with more than one process the first owns nothing
  const int size = Communicator::world().size();
  return size == 1 ? 0 : 1 + node * (size - 1) / whole;
}

double velocity(int node, int k) {
  return 1.0 / (node + 1) + k;
}
double difference(int node, int k) {
  return node - 0.1 * k;
}

/// Of a run whose nodes are `share`; nodes that three divides are on the interface.
struct SharedRun {
  NodeShare share;
  WholeOrder nodes, interface;
  Checkpoint checkpoint;

  template <class Owner>
  SharedRun(const Communicator& processes, Owner owner)
      : share(shared_nodes(processes, whole, owner)),
        nodes(share),
        interface(WholeOrder::by_keys(processes, keys(), flags())) {
    checkpoint.program = "fsi-monolithic";
    checkpoint.case_hash = checkpoint.mesh_hash = "0";
    checkpoint.step = 3;
    checkpoint.time = 0.75;
    checkpoint.arrays["level0.flow"] = nodal_array(share, 4, velocity);
    checkpoint.arrays["rate.flow"] = {};
    checkpoint.arrays["level_times"] = {1, 2, 3};
    auto& columns = checkpoint.arrays["v"];
    for (int column = 0; column < 2; ++column)
      for (const int a : share.whole_node)
        for (int k = 0; k < 3 && a % 3 == 0; ++k) columns.push_back(difference(a, k) + 100 * column);
    checkpoint.integers["entries"] = 4;
    checkpoint.reals["omega"] = 0.5;
  }

  ArraySharing sharing() const {
    return [this](const std::string& name) -> std::optional<SharedArray> {
      if (name == "v") return SharedArray{&interface, 3, true};
      if (name == "level_times") return {};
      return SharedArray{&nodes, 4};
    };
  }

 private:
  std::vector<std::int64_t> keys() const {
    std::vector<std::int64_t> keys;
    for (const int a : share.whole_node)
      if (a % 3 == 0) keys.push_back(a);
    return keys;
  }
  std::vector<char> flags() const {
    std::vector<char> owned;
    for (std::size_t i = 0; i < share.owned.size(); ++i)
      if (share.whole_node[i] % 3 == 0) owned.push_back(share.owned[i]);
    return owned;
  }
};

using SharedCheckpoint = SharedFolderTest;

TEST_F(SharedCheckpoint, IsReadByOneProcessAndByOthers) {
  const fs::path file = checkpoint_file(folder_);
  const SharedRun run(processes_, scattered);
  write_checkpoint(file, run.checkpoint, processes_, run.sharing());
  EXPECT_FALSE(fs::exists(file.string() + ".tmp"));

  const Checkpoint alone = read_checkpoint(file);
  EXPECT_EQ(alone.step, 3);
  EXPECT_EQ(alone.integers, run.checkpoint.integers);
  EXPECT_EQ(alone.reals, run.checkpoint.reals);
  std::vector<double> flow, columns;
  for (int a = 0; a < whole; ++a)
    for (int k = 0; k < 4; ++k) flow.push_back(velocity(a, k));
  for (int column = 0; column < 2; ++column)
    for (int a = 0; a < whole; a += 3)
      for (int k = 0; k < 3; ++k) columns.push_back(difference(a, k) + 100 * column);
  EXPECT_EQ(alone.arrays, (std::map<std::string, std::vector<double>>{
                              {"level0.flow", flow}, {"rate.flow", {}}, {"level_times", {1, 2, 3}}, {"v", columns}}));

  const SharedRun other(processes_, in_a_row);
  EXPECT_EQ(read_checkpoint(file, processes_, other.sharing()).arrays, other.checkpoint.arrays);

  write_checkpoint(folder_ / ("alone" + std::to_string(processes_.rank())), alone);
  EXPECT_EQ(read_checkpoint(folder_ / ("alone" + std::to_string(processes_.rank())), Communicator::alone(), {}).arrays,
            alone.arrays);
}

TEST_F(SharedCheckpoint, ThatIsDamagedOrOfAnotherMeshIsRefusedByAll) {
  const fs::path file = checkpoint_file(folder_);
  const SharedRun run(processes_, scattered);
  write_checkpoint(file, run.checkpoint, processes_, run.sharing());
  if (processes_.size() > 1) {
    const auto wrong = [&](const std::string& name) -> std::optional<SharedArray> {
      return name == "level0.flow" ? SharedArray{&run.nodes, 3} : run.sharing()(name);
    };
    EXPECT_NE(said([&] { read_checkpoint(file, processes_, wrong); }).find("has 92 values, not 69"), std::string::npos);
  }
  processes_.wait();
  if (processes_.is_first()) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(2000);
    stream.put('x');
  }
  processes_.wait();
  EXPECT_NE(said([&] { read_checkpoint(file, processes_, run.sharing()); }).find("checksum: does not match"),
            std::string::npos);
}

TEST_F(SharedCheckpoint, ThatCannotBeWrittenLeavesTheOldOne) {
  const fs::path file = checkpoint_file(folder_);
  SharedRun run(processes_, scattered);
  write_checkpoint(file, run.checkpoint, processes_, run.sharing());
  const std::string before = contents_of(file);
  processes_.wait();
  if (processes_.is_first()) fs::create_directories(file.string() + ".tmp/in the way");
  processes_.wait();
  run.checkpoint.step = 4;
  EXPECT_EQ(said([&] { write_checkpoint(file, run.checkpoint, processes_, run.sharing()); }).substr(0, 13),
            "write error: ");
  EXPECT_EQ(contents_of(file), before);
}

/// This process's stretches of whole grids.
std::vector<FieldGrid> stretches(std::vector<FieldGrid> grids, const Communicator& processes) {
  const auto bound = [&](std::size_t count, int rank) {
    return count * static_cast<std::size_t>(rank) / processes.size();
  };
  const auto cut = [&](auto& list, std::size_t entries) {
    const std::size_t count = list.size() / entries, rank = static_cast<std::size_t>(processes.rank());
    const auto from = static_cast<std::ptrdiff_t>(bound(count, static_cast<int>(rank)) * entries),
               to = static_cast<std::ptrdiff_t>(bound(count, static_cast<int>(rank) + 1) * entries);
    list = std::decay_t<decltype(list)>(list.begin() + from, list.begin() + to);
  };
  for (FieldGrid& grid : grids) {
    const auto corners = static_cast<std::size_t>(grid.nodes_per_cell);
    FieldGrid::Stretch here;
    here.points = grid.points.size();
    here.cells = cells_here(grid);
    here.first_point = bound(here.points, processes.rank());
    here.first_cell = bound(here.cells, processes.rank());
    here.layered = !grid.layer.empty();
    cut(grid.points, 1);
    cut(grid.cells, corners);
    cut(grid.layer, 1);
    if (!processes.is_alone()) grid.stretch = here;
  }
  return grids;
}

using SharedFields = SharedFolderTest;

TEST_F(SharedFields, AreByteForByteThoseOfOneProcess) {
  const auto mine = stretches(sample_grids(), processes_);
  const auto plan = [](std::int64_t last) { return planned_field_steps(last, 1, steps_of(0.5)); };
  // A run that is continued in place, then elsewhere; by all processes, and by the first alone.
  const auto write = [&](const fs::path& run, const std::vector<FieldGrid>& grids, const Communicator& processes) {
    at_first(processes, [&] {
      fs::create_directories(run / "a");
      fs::create_directories(run / "b");
    });
    const auto steps = [&](FieldsWriter& writer, std::int64_t from, std::int64_t to) {
      for (std::int64_t step = from; step <= to; ++step)
        writer.write(step, sample_values(grids, 0.5 * static_cast<double>(step)));
    };
    FieldsWriter first(run / "a", grids, plan(4), processes);
    steps(first, 0, 3);
    FieldsWriter second(run / "a", grids, plan(5), run / "a", 1.0, processes);
    steps(second, 3, 3);
    FieldsWriter third(run / "b", grids, plan(6), run / "a", 1.5, processes);
    steps(third, 4, 6);
  };
  write(folder_ / "together", mine, processes_);
  if (processes_.is_first()) write(folder_ / "alone", sample_grids(), Communicator::alone());
  processes_.wait();
  for (const char* run : {"a", "b"})
    for (const char* file : {"fields.h5", "fields.xdmf", "fluid.xdmf", "wall.xdmf"}) {
      const auto together = contents_of(folder_ / "together" / run / file);
      EXPECT_FALSE(together.empty()) << file;
      EXPECT_TRUE(together == contents_of(folder_ / "alone" / run / file)) << run << "/" << file;
    }
}

TEST_F(SharedFields, AFileThatIsGoneIsNoticedByAll) {
  const auto mine = stretches(sample_grids(), processes_);
  FieldsWriter writer(folder_, mine, planned_field_steps(4, 1, steps_of(0.5)), processes_);
  writer.write(0, sample_values(mine, 0));
  processes_.wait();
  if (processes_.is_first()) fs::remove(folder_ / "fields.h5");
  processes_.wait();
  EXPECT_NE(said([&] { writer.write(1, sample_values(mine, 0.5)); }).find("deleted"), std::string::npos);
}

}  // namespace

}  // namespace fsi::test
