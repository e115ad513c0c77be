#include "mesh_io/gmsh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/sort_unique.hpp"
#include "mesh_io/gmsh_scanner.hpp"

namespace fsi {

namespace {

// The table "Low order / High order elements" of gmsh's manual.
constexpr GmshType types[] = {
    {15, 0, 1, "points"},
    {1, 1, 2, "lines"},
    {8, 1, 3, "second-order lines"},
    {26, 1, 4, "third-order lines"},
    {27, 1, 5, "fourth-order lines"},
    {28, 1, 6, "fifth-order lines"},
    {2, 2, 3, "triangles"},
    {3, 2, 4, "quadrangles"},
    {9, 2, 6, "second-order triangles"},
    {10, 2, 9, "second-order quadrangles"},
    {16, 2, 8, "second-order quadrangles"},
    {20, 2, 9, "third-order triangles"},
    {21, 2, 10, "third-order triangles"},
    {22, 2, 12, "fourth-order triangles"},
    {23, 2, 15, "fourth-order triangles"},
    {24, 2, 15, "fifth-order triangles"},
    {25, 2, 21, "fifth-order triangles"},
    {36, 2, 16, "third-order quadrangles"},
    {37, 2, 25, "fourth-order quadrangles"},
    {4, 3, 4, "tetrahedra"},
    {5, 3, 8, "hexahedra"},
    {6, 3, 6, "prisms"},
    {7, 3, 5, "pyramids"},
    {11, 3, 10, "second-order tetrahedra"},
    {12, 3, 27, "second-order hexahedra"},
    {13, 3, 18, "second-order prisms"},
    {14, 3, 14, "second-order pyramids"},
    {17, 3, 20, "second-order hexahedra"},
    {18, 3, 15, "second-order prisms"},
    {19, 3, 13, "second-order pyramids"},
    {29, 3, 20, "third-order tetrahedra"},
    {30, 3, 35, "fourth-order tetrahedra"},
    {31, 3, 56, "fifth-order tetrahedra"},
    {92, 3, 64, "third-order hexahedra"},
    {93, 3, 125, "fourth-order hexahedra"},
};

using EntityGroups = std::map<std::pair<int, int>, std::vector<int>>;  // (dimension, tag) -> physical tags

/// A physical tag is negative where the group turns the entity round. Which way facets face, their cells tell.
int unsigned_tag(GmshScanner& in, int tag) {
  if (tag == -2147483647 - 1) in.fail("physical tag out of range");
  return std::abs(tag);
}

const GmshType& known_type(GmshScanner& in, int number) {
  const auto* type = gmsh_type(number);
  if (type == nullptr)
    in.fail(fmt::format("unknown element type {}", number), "mesh with tetrahedra and triangles (types 4 and 2)");
  return *type;
}

std::string read_header(GmshScanner& in) {
  std::string version = in.word();
  const int file_type = in.text_integer("file type"), size = in.text_integer("data size");
  if (version != "4.1" && version != "2.2")
    in.fail(fmt::format("version {} is not supported", version.substr(0, 16)),
            "write 4.1 or 2.2: Mesh.MshFileVersion = 4.1");
  if (file_type != 0 && file_type != 1) in.fail(fmt::format("file type is {}", file_type), "0 is ASCII, 1 is binary");
  if (size != 8) in.fail(fmt::format("data size is {}", size), "write the file on a 64-bit machine, with size 8");
  in.end_line();
  if (file_type == 1) {
    const int one = in.binary_integer("byte order mark");
    if (one == 0x01000000) in.fail("binary data of the other byte order", "write the file as ASCII: Mesh.Binary = 0");
    if (one != 1) in.fail(fmt::format("byte order mark is {}, not 1", one));
  }
  in.end_section();
  in.set_binary(file_type == 1);
  return version;
}

void read_names(GmshScanner& in, GmshFile& file) {
  const auto count = in.text_count("number of physical names", 8);
  for (std::int64_t i = 0; i < count; ++i) {
    GmshFile::PhysicalName name;
    name.dimension = in.text_integer("dimension");
    name.tag = in.text_integer("physical tag");
    name.name = in.quoted("physical name");
    constexpr std::size_t longest = 127;  // gmsh's own limit
    if (name.name.size() > longest)
      in.fail(fmt::format("a physical name of {} bytes", name.name.size()), fmt::format("give at most {}", longest));
    file.names.push_back(name);
  }
}

void check_node(GmshScanner& in, std::int64_t tag) {
  if (tag <= 0) in.fail(fmt::format("node tag {} is not positive", tag));
}

// ---- version 4.1 ----

EntityGroups read_entities(GmshScanner& in) {
  EntityGroups groups;
  std::int64_t counts[4];
  for (auto& count : counts) count = in.count("number of entities", 24);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      const int tag = in.integer("entity tag");
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in.real("bound of an entity");
      auto& physical = groups[{dimension, tag}];
      for (auto left = in.count("number of physical tags", 4); left > 0; --left)
        physical.push_back(unsigned_tag(in, in.integer("physical tag")));
      sort_unique(physical);
      if (dimension > 0)
        for (auto left = in.count("number of bounding entities", 4); left > 0; --left) in.integer("bounding entity");
    }
  return groups;
}

void read_nodes_41(GmshScanner& in, GmshFile& file) {
  const auto blocks = in.count("number of node blocks", 20), total = in.count("number of nodes", 32);
  in.tag("smallest node tag");
  in.tag("largest node tag");
  file.node_tags.reserve(total);
  file.nodes.reserve(total);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const int dimension = in.integer("entity dimension");
    in.integer("entity tag");
    const int parametric = in.integer("parametric flag");
    if (dimension < 0 || dimension > 3) in.fail(fmt::format("entity dimension is {}", dimension));
    if (parametric != 0 && parametric != 1) in.fail(fmt::format("parametric flag is {}", parametric));
    const auto count = in.count("number of nodes in a block", 32);
    for (std::int64_t i = 0; i < count; ++i) {
      file.node_tags.push_back(in.tag("node tag"));
      check_node(in, file.node_tags.back());
    }
    for (std::int64_t i = 0; i < count; ++i) {
      Point x;
      for (double& value : x) value = in.real("coordinate");
      for (int k = 0; k < parametric * dimension; ++k) in.real("parametric coordinate");
      file.nodes.push_back(x);
    }
  }
  if (static_cast<std::int64_t>(file.nodes.size()) != total)
    in.fail(fmt::format("{} nodes announced, {} found", total, file.nodes.size()));
}

void read_elements_41(GmshScanner& in, const EntityGroups& groups, GmshFile& file) {
  const auto blocks = in.count("number of element blocks", 20), total = in.count("number of elements", 16);
  in.tag("smallest element tag");
  in.tag("largest element tag");
  std::int64_t found = 0;
  for (std::int64_t b = 0; b < blocks; ++b) {
    const int dimension = in.integer("entity dimension"), entity = in.integer("entity tag");
    GmshFile::Block block;
    block.type = in.integer("element type");
    const auto& type = known_type(in, block.type);
    if (dimension != type.dimension) in.fail(fmt::format("{} in an entity of dimension {}", type.name, dimension));
    if (!groups.empty()) {
      const auto group = groups.find({dimension, entity});
      if (group == groups.end())
        in.fail(fmt::format("elements of entity {} of dimension {}, which $Entities does not list", entity, dimension));
      block.physical_tags = group->second;
    }
    const auto count = in.count("number of elements in a block", 8 * (1 + static_cast<std::size_t>(type.nodes)));
    block.tags.reserve(count);
    block.nodes.reserve(count * type.nodes);
    for (std::int64_t i = 0; i < count; ++i) {
      block.tags.push_back(in.tag("element tag"));
      for (int k = 0; k < type.nodes; ++k) block.nodes.push_back(in.tag("node tag"));
    }
    found += count;
    file.blocks.push_back(std::move(block));
  }
  if (found != total) in.fail(fmt::format("{} elements announced, {} found", total, found));
}

// ---- version 2.2 ----

void read_nodes_22(GmshScanner& in, GmshFile& file) {
  const auto count = in.text_count("number of nodes", 28);
  file.node_tags.reserve(count);
  file.nodes.reserve(count);
  for (std::int64_t i = 0; i < count; ++i) {
    file.node_tags.push_back(in.integer("node tag"));
    check_node(in, file.node_tags.back());
    Point x;
    for (double& value : x) value = in.real("coordinate");
    file.nodes.push_back(x);
  }
}

void read_elements_22(GmshScanner& in, GmshFile& file) {
  const auto count = in.text_count("number of elements", 8);
  std::map<std::pair<int, int>, std::size_t> block_of;  // (type, physical tag) -> block
  // One element: its tag, its own tags (the first is the physical group, 0 for none), its nodes.
  const auto read_element = [&](std::int64_t tag, const GmshType& type, int tags) {
    int physical = 0;
    for (int k = 0; k < tags; ++k) {
      const int value = in.integer("tag of an element");
      if (k == 0) physical = unsigned_tag(in, value);
    }
    const auto [entry, is_new] = block_of.emplace(std::make_pair(type.number, physical), file.blocks.size());
    if (is_new) {
      file.blocks.emplace_back();
      file.blocks.back().type = type.number;
      if (physical != 0) file.blocks.back().physical_tags = {physical};
    }
    auto& block = file.blocks[entry->second];
    block.tags.push_back(tag);
    for (int k = 0; k < type.nodes; ++k) block.nodes.push_back(in.integer("node tag"));
  };
  const auto tag_count = [&] {
    const int tags = in.integer("number of tags");
    if (tags < 0) in.fail(fmt::format("number of tags is {}", tags));
    return tags;
  };

  if (!in.is_binary()) {
    for (std::int64_t i = 0; i < count; ++i) {
      const int tag = in.integer("element tag");
      const auto& type = known_type(in, in.integer("element type"));
      read_element(tag, type, tag_count());
    }
    return;
  }
  for (std::int64_t found = 0; found < count;) {
    const auto& type = known_type(in, in.integer("element type"));
    const int here = in.integer("number of elements in a block"), tags = tag_count();
    if (here < 0 || here > count - found)
      in.fail(fmt::format("{} elements announced, a block brings {} to the {} before it", count, here, found));
    for (int i = 0; i < here; ++i) read_element(in.integer("element tag"), type, tags);
    found += here;
  }
}

}  // namespace

const GmshType* gmsh_type(int number) {
  const auto* found =
      std::find_if(std::begin(types), std::end(types), [&](const auto& t) { return t.number == number; });
  return found == std::end(types) ? nullptr : found;
}

GmshFile parse_gmsh(const std::filesystem::path& path) {
  GmshScanner in(path);
  if (!in.begins_with("$MeshFormat"))
    throw InputError(path.string(), "$MeshFormat",
                     "is not a gmsh .msh file of version 4.1 or 2.2: it does not begin with $MeshFormat",
                     "write it with gmsh, Mesh.MshFileVersion = 4.1");
  if (in.begin_section() != "MeshFormat") in.fail("the first section has to be $MeshFormat");
  const bool version_41 = read_header(in) == "4.1";

  GmshFile file;
  EntityGroups groups;
  std::set<std::string> seen;
  for (std::string section; !(section = in.begin_section()).empty();) {
    const bool known =
        section == "PhysicalNames" || section == "Nodes" || section == "Elements" || section == "Entities";
    if (known && !seen.insert(section).second) in.fail("a second section of this name");
    if (section == "PartitionedEntities")
      in.fail("a partitioned mesh", "save it whole: Mesh.PartitionCreateTopology = 0, without partitions");

    if (section == "PhysicalNames") {
      read_names(in, file);
    } else if (section == "Entities" && version_41) {
      groups = read_entities(in);
    } else if (section == "Nodes") {
      version_41 ? read_nodes_41(in, file) : read_nodes_22(in, file);
    } else if (section == "Elements") {
      version_41 ? read_elements_41(in, groups, file) : read_elements_22(in, file);
    } else {
      in.skip_section();
      continue;
    }
    in.end_section();
  }
  for (const char* needed : {"Nodes", "Elements"})
    if (!seen.count(needed))
      throw InputError(path.string(), fmt::format("${}", needed), "the file has no such section",
                       GmshScanner::default_remedy);
  return file;
}

}  // namespace fsi
