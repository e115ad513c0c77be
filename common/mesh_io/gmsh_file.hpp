#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// What a .msh file says, in the file's own terms. Nothing is interpreted yet.
struct GmshFile {
  struct PhysicalName {
    int dimension;
    int tag;
    std::string name;
  };
  /// Elements of one type that are in the same physical groups.
  struct Block {
    int type;                         ///< gmsh's number of the element type
    std::vector<int> physical_tags;   ///< of the elements' own dimension, without signs
    std::vector<std::int64_t> tags;   ///< per element
    std::vector<std::int64_t> nodes;  ///< node tags, gmsh_type(type)->nodes per element
  };

  std::vector<PhysicalName> names;
  std::vector<std::int64_t> node_tags;
  std::vector<Point> nodes;  ///< mm, finite; as long as node_tags
  std::vector<Block> blocks;
};

/// What the number of an element type stands for.
struct GmshType {
  int number;
  int dimension;
  int nodes;
  const char* name;  ///< plural, e.g. "second-order tetrahedra"
};

/// nullptr for a number that stands for nothing known.
const GmshType* gmsh_type(int number);

/// Reads .msh 4.1 and 2.2, ASCII and binary (https://gmsh.info/doc/texinfo/gmsh.html#File-formats). Throws InputError
/// for a file that is missing, of another kind or version, of the other byte order, truncated, malformed, or too large
/// for the memory (mesh_io/gmsh_header.hpp). Counts are compared with the bytes that are left before memory is
/// allocated for them.
GmshFile parse_gmsh(const std::filesystem::path& path);

}  // namespace fsi
