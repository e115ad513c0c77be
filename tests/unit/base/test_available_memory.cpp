#include "host/available_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "support/temporary_folder.hpp"

namespace fsi {
namespace {

constexpr auto unbounded = std::numeric_limits<std::uint64_t>::max();

TEST(AvailableMemory, MachineHasWhatIsAvailableAndFreeSwap) {
  EXPECT_EQ(machine_room("MemTotal: 999 kB\nMemFree: 5 kB\nMemAvailable:   100 kB\nSwapFree: 28 kB\n"), 128u * 1024);
  EXPECT_EQ(machine_room("MemAvailable: 100 kB"), 100u * 1024);
  EXPECT_EQ(machine_room("MemFree: 100 kB\nSwapFree: 28 kB\n"), unbounded);
  EXPECT_EQ(machine_room(""), unbounded);
}

class MemoryOfGroups : public test::FolderTest {};

TEST_F(MemoryOfGroups, LeaveTheLeastOfTheirOwnLimitsAndOfThoseAbove) {
  const auto write = [&](const std::string& file, const std::string& text) {
    const auto path = folder_ / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  };
  const std::string folder = folder_.string();
  EXPECT_EQ(group_room("0::/a/b\n", folder.c_str()), unbounded);
  write("a/b/memory.max", "max\n");
  EXPECT_EQ(group_room("0::/a/b\n", folder.c_str()), unbounded);
  write("a/memory.max", "1000\n");
  write("a/memory.current", "700\n");
  EXPECT_EQ(group_room("0::/a/b\n", folder.c_str()), 300u);
  write("a/memory.stat", "anon 5\ninactive_file 150\n");  // can be dropped
  EXPECT_EQ(group_room("0::/a/b\n", folder.c_str()), 450u);
  write("a/b/memory.max", "80\n");
  write("a/b/memory.current", "100\n");
  EXPECT_EQ(group_room("0::/a/b\n", folder.c_str()), 0u);
  EXPECT_EQ(group_room("0::/a\n", folder.c_str()), 450u);
  write("memory/c/memory.limit_in_bytes", "5000\n");
  write("memory/c/memory.usage_in_bytes", "1000\n");
  EXPECT_EQ(group_room("12:cpu:/a\n4:memory:/c\n", folder.c_str()), 4000u);
  write("memory/c/memory.limit_in_bytes", "9223372036854771712\n");  // none
  EXPECT_EQ(group_room("4:memory:/c\n", folder.c_str()), unbounded);
}

TEST(AvailableMemory, SizesAreReadable) {
  EXPECT_EQ(memory_text(80), "80 bytes");
  EXPECT_EQ(memory_text(2048), "2.0 KiB");
  EXPECT_EQ(memory_text(128.0 * 1024 * 1024), "128 MiB");
  EXPECT_EQ(memory_text(3.1 * 1024 * 1024 * 1024), "3.1 GiB");
}

TEST(AvailableMemory, MessageSaysWhatWasDoneAskedAndWouldHelp) {
  const Activity outer("making the outer thing");
  {
    const Activity inner("factorising a matrix");
    const std::string said = OutOfMemory("7 GiB asked", "take less").what();
    EXPECT_EQ(said.rfind("out of memory (factorising a matrix): 7 GiB asked, ", 0), 0u) << said;
    EXPECT_NE(said.find(" available ("), std::string::npos) << said;
    EXPECT_NE(said.find("; take less"), std::string::npos) << said;
  }
  EXPECT_EQ(std::string(OutOfMemory("x").what()).rfind("out of memory (making the outer thing)", 0), 0u);
}

TEST(AvailableMemory, AdviceFitsTheBound) {
  const auto advice = [](const char* program, const char* bound) {
    char text[256];
    write_memory_advice(program, bound, text, sizeof text);
    return std::string(text);
  };
  EXPECT_EQ(advice("fsi-mesh", "this machine"), "take a coarser mesh or a machine with more memory");
  EXPECT_EQ(advice("fsi-mesh", "ulimit -v"), "take a coarser mesh or a higher limit");
  EXPECT_EQ(
      advice("fsi-monolithic", "its control group"),
      "take a coarser mesh, linear_solver = \"fast\", fewer threads (--threads) or a higher limit of the container "
      "or job");
}

TEST(AvailableMemory, EndsWithOneMessageAndExitCodeOne) {
  EXPECT_EXIT(
      end_out_of_memory(std::size_t{3} << 30), testing::ExitedWithCode(1),
      "^.*: error: out of memory \\(starting\\): 3.0 GiB asked, .* available \\(.*\\); take a coarser mesh.*\n$");
  EXPECT_EXIT(end_out_of_memory("fsi-x", OutOfMemory("7 GiB asked")), testing::ExitedWithCode(1),
              "^fsi-x: error: out of memory \\(starting\\): 7 GiB asked, .*\n$");
  EXPECT_EXIT(end_without_thread(), testing::ExitedWithCode(1), "a thread cannot be started .*--threads");
}

TEST(AvailableMemory, LimitOfAddressesBoundsTheRoom) {
  const auto limited_room = [] {
    const rlimit limit{std::uint64_t{1} << 46, RLIM_INFINITY};  // above the shadow memory of sanitizers
    setrlimit(RLIMIT_AS, &limit);
    const rlimit data{1, RLIM_INFINITY};
    setrlimit(RLIMIT_DATA, &data);
    _exit(available_memory().bytes == 0 && std::string(available_memory().bound) == "ulimit -d" ? 0 : 1);
  };
  EXPECT_EXIT(limited_room(), testing::ExitedWithCode(0), "");
}

TEST(AvailableMemory, FailuresAreToleratedWhereSaid) {
  EXPECT_FALSE(MayFail::now());
  {
    const MayFail outer;
    { const MayFail inner; }
    EXPECT_TRUE(MayFail::now());
  }
  EXPECT_FALSE(MayFail::now());
}

}  // namespace
}  // namespace fsi
