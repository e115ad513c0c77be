#include "mesh_io/gmsh_header.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "mesh_io/gmsh_reader.hpp"
#include "support/temporary_folder.hpp"

namespace fsi {
namespace {

constexpr double plenty = 1e18;

/// A file that begins with a text and has the given size, its rest a hole.
class GmshHeaders : public test::FolderTest {
 protected:
  std::filesystem::path sparse(const std::string& begin, std::uintmax_t size = std::uintmax_t{3} << 30) const {
    auto file = folder_ / "sparse.msh";
    std::ofstream(file, std::ios::binary) << begin;
    std::filesystem::resize_file(file, size);
    return file;
  }

  static std::string bytes(std::initializer_list<std::int64_t> numbers) {
    std::string text;
    for (const std::int64_t number : numbers) text.append(reinterpret_cast<const char*>(&number), sizeof number);
    return text;
  }

  static std::string refusal(const std::filesystem::path& file, double room = plenty) {
    try {
      check_gmsh_header(file, room);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const std::string text_41_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n";
  const std::string text_22_ = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  const std::string binary_41_ = std::string("$MeshFormat\n4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n$Nodes\n", 47);
  const std::string binary_22_ = std::string("$MeshFormat\n2.2 1 8\n\1\0\0\0\n$EndMeshFormat\n$Nodes\n", 47);
};

TEST_F(GmshHeaders, RefuseMoreNodesThanTheFileHasBytesFor) {
  const std::string expected = "the number of nodes is 1000000000000000000, but only";
  for (const std::string& file :
       {text_41_ + "1 1000000000000000000 1 9\n", text_22_ + "1000000000000000000\n",
        binary_41_ + bytes({1, 1000000000000000000, 1, 9}), binary_22_ + "1000000000000000000\n"})
    EXPECT_NE(refusal(sparse(file)).find(expected), std::string::npos) << refusal(sparse(file));
}

TEST_F(GmshHeaders, RefuseNodesThatEndBeforeTheirSection) {
  const std::string nodes = binary_41_ + bytes({0, 0, 1, 9});
  EXPECT_NE(refusal(sparse(nodes)).find("expected $EndNodes"), std::string::npos) << refusal(sparse(nodes));
  EXPECT_NE(refusal(sparse(binary_22_ + "4\n")).find("expected $EndNodes"), std::string::npos);
}

TEST_F(GmshHeaders, RefuseMoreElementsThanTheFileHasBytesFor) {
  const std::string file =
      binary_41_ + bytes({0, 0, 1, 9}) + "\n$EndNodes\n$Elements\n" + bytes({1, 1000000000000, 1, 9});
  const std::string said = refusal(sparse(file));
  EXPECT_NE(said.find("$Elements: the number of elements is 1000000000000, but only"), std::string::npos) << said;
}

TEST_F(GmshHeaders, RefuseWhatDoesNotFitIntoMemory) {
  const auto file = sparse(text_41_ + "1 1000 1 1000\n");
  EXPECT_EQ(refusal(file), "");
  EXPECT_EQ(refusal(file, 9.1 * (std::uint64_t{1} << 30)), "");
  const std::string said = refusal(file, 2.0 * (std::uint64_t{1} << 30));
  EXPECT_NE(said.find("the file has 3.0 GiB, reading it takes about 9.0 GiB, and 2.0 GiB of memory is available"),
            std::string::npos)
      << said;
}

TEST_F(GmshHeaders, LeaveSmallFilesToTheReader) {
  const auto file = sparse(text_41_ + "1 1000000000000000000 1 9\n", 1000);
  EXPECT_EQ(refusal(file, 1), "");
  EXPECT_THROW(gmsh_dimension(file), InputError);
}

TEST_F(GmshHeaders, ReaderStopsAtZerosInTextAndAtOtherFiles) {
  EXPECT_THROW(gmsh_dimension(sparse(text_41_ + "1 4 1 4\n2 1 0 4\n1\n")), InputError);
  try {
    gmsh_dimension(sparse(""));
    FAIL() << "a file of zeros is read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is not a gmsh .msh file"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace fsi
