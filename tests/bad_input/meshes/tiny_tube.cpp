#include "tiny_tube.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh_io/gmsh_reader.hpp"

namespace fsi::test {

namespace {

int dimension_of(int type) {
  static const std::map<int, int> dimensions{{15, 0}, {1, 1}, {2, 2}, {3, 2}, {4, 3}, {5, 3}, {6, 3}, {9, 2}, {11, 3}};
  const auto found = dimensions.find(type);
  return found == dimensions.end() ? 3 : found->second;
}

/// Elements of one type and set of groups: one entity, one block.
using Blocks = std::map<std::pair<int, std::vector<int>>, std::vector<std::size_t>>;

Blocks blocks_of(const TinyFile& file) {
  Blocks blocks;
  for (std::size_t e = 0; e < file.elements.size(); ++e)
    blocks[{file.elements[e].type, file.elements[e].physical}].push_back(e);
  return blocks;
}

std::string names_text(const TinyFile& file) {
  if (file.names.empty()) return {};
  std::string text = fmt::format("$PhysicalNames\n{}\n", file.names.size());
  for (const auto& name : file.names) text += fmt::format("{} {} \"{}\"\n", name.dimension, name.tag, name.name);
  return text + "$EndPhysicalNames\n";
}

/// Appends the bytes of a value.
template <class T>
void put(std::string& data, T value) {
  data.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace

std::string TinyFile::text_41() const {
  const auto blocks = blocks_of(*this);
  std::array<std::string, 4> entities;
  std::array<int, 4> counts{};
  std::string text;
  int entity = 0;
  for (const auto& [key, members] : blocks) {
    const int dimension = dimension_of(key.first);
    ++counts[dimension];
    auto& line = entities[dimension];
    line += fmt::format("{} 0 0 0{} {}", ++entity, dimension > 0 ? " 3 3 2" : "", key.second.size());
    for (const int tag : key.second) line += fmt::format(" {}", tag);
    line += dimension > 0 ? " 0\n" : "\n";
    text += fmt::format("{} {} {} {}\n", dimension, entity, key.first, members.size());
    for (const auto e : members) {
      text += fmt::format("{}", e + 1);
      for (const auto node : elements[e].nodes) text += fmt::format(" {}", node);
      text += "\n";
    }
  }
  std::string out = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names_text(*this);
  out += fmt::format("$Entities\n{} {} {} {}\n", counts[0], counts[1], counts[2], counts[3]);
  for (const auto& lines : entities) out += lines;
  out += fmt::format("$EndEntities\n$Nodes\n1 {0} 1 {0}\n3 1 0 {0}\n", nodes.size());
  for (const auto& node : nodes) out += fmt::format("{}\n", node.tag);
  for (const auto& node : nodes) out += fmt::format("{} {} {}\n", node.x[0], node.x[1], node.x[2]);
  out += fmt::format("$EndNodes\n$Elements\n{0} {1} 1 {1}\n", blocks.size(), elements.size());
  return out + text + "$EndElements\n";
}

std::string TinyFile::text_22() const {
  std::string out = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names_text(*this);
  out += fmt::format("$Nodes\n{}\n", nodes.size());
  for (const auto& node : nodes) out += fmt::format("{} {} {} {}\n", node.tag, node.x[0], node.x[1], node.x[2]);
  std::string lines;
  std::size_t count = 0;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int tag : elements[e].physical) {  // once for each group, as gmsh does
      ++count;
      lines += fmt::format("{} {} 2 {} 1", e + 1, elements[e].type, tag);
      for (const auto node : elements[e].nodes) lines += fmt::format(" {}", node);
      lines += "\n";
    }
  return out + fmt::format("$EndNodes\n$Elements\n{}\n", count) + lines + "$EndElements\n";
}

std::string TinyFile::binary_41() const {
  const auto blocks = blocks_of(*this);
  std::array<std::string, 4> entities;
  std::array<std::uint64_t, 4> counts{};
  std::string block_data;
  int entity = 0;
  for (const auto& [key, members] : blocks) {
    const int dimension = dimension_of(key.first);
    ++counts[dimension];
    auto& data = entities[dimension];
    put(data, ++entity);
    for (int i = 0; i < (dimension > 0 ? 6 : 3); ++i) put(data, 0.0);
    put(data, static_cast<std::uint64_t>(key.second.size()));
    for (const int tag : key.second) put(data, tag);
    if (dimension > 0) put(data, std::uint64_t{0});
    for (const int value : {dimension, entity, key.first}) put(block_data, value);
    put(block_data, static_cast<std::uint64_t>(members.size()));
    for (const auto e : members) {
      put(block_data, static_cast<std::uint64_t>(e + 1));
      for (const auto node : elements[e].nodes) put(block_data, node);
    }
  }
  std::string out = "$MeshFormat\n4.1 1 8\n";
  put(out, 1);
  out += "\n$EndMeshFormat\n" + names_text(*this) + "$Entities\n";
  for (const auto count : counts) put(out, count);
  for (const auto& data : entities) out += data;
  out += "\n$EndEntities\n$Nodes\n";
  const std::uint64_t n = nodes.size(), m = elements.size();
  for (const std::uint64_t value : {std::uint64_t{1}, n, std::uint64_t{1}, n}) put(out, value);
  for (const int value : {3, 1, 0}) put(out, value);
  put(out, n);
  for (const auto& node : nodes) put(out, node.tag);
  for (const auto& node : nodes)
    for (const double value : node.x) put(out, value);
  out += "\n$EndNodes\n$Elements\n";
  for (const std::uint64_t value : {std::uint64_t{blocks.size()}, m, std::uint64_t{1}, m}) put(out, value);
  return out + block_data + "\n$EndElements\n";
}

std::string TinyFile::binary_22() const {
  std::string out = "$MeshFormat\n2.2 1 8\n";
  put(out, 1);
  out += "\n$EndMeshFormat\n" + names_text(*this) + fmt::format("$Nodes\n{}\n", nodes.size());
  for (const auto& node : nodes) {
    put(out, static_cast<int>(node.tag));
    for (const double value : node.x) put(out, value);
  }
  out += fmt::format("\n$EndNodes\n$Elements\n{}\n", elements.size());
  for (const auto& [key, members] : blocks_of(*this)) {
    for (const int value : {key.first, static_cast<int>(members.size()), 2}) put(out, value);
    for (const auto e : members) {
      for (const int value : {static_cast<int>(e + 1), key.second.at(0), 1}) put(out, value);
      for (const auto node : elements[e].nodes) put(out, static_cast<int>(node));
    }
  }
  return out + "\n$EndElements\n";
}

std::vector<std::size_t> TinyFile::of_group(int tag) const {
  std::vector<std::size_t> found;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (elements[e].physical == std::vector<int>{tag}) found.push_back(e);
  return found;
}

std::int64_t tube_node(int i, int j, int k) {
  return 1 + i + 4 * j + 16 * k;
}

TinyFile tiny_tube() {
  TinyFile file;
  file.names = {{2, inlet_tag, "inlet"}, {2, outlet_tag, "outlet"}, {2, wall_ends_tag, "wall_ends"},
                {2, outer_tag, "outer"}, {3, fluid_tag, "fluid"},   {3, media_tag, "media"}};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        file.nodes.push_back(
            {tube_node(i, j, k), {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}});

  // Kuhn's six tetrahedra of a cube: one for each order of the three steps from corner (0,0,0) to (1,1,1).
  std::vector<TinyFile::Element> tetrahedra, triangles;
  std::map<std::array<std::int64_t, 3>, std::pair<int, std::array<std::int64_t, 3>>> facets;  // users, nodes
  std::map<std::array<std::int64_t, 3>, int> owner;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int group = i == 1 && j == 1 ? fluid_tag : media_tag;
        std::array<int, 3> order{0, 1, 2};
        do {
          std::array<int, 3> corner{i, j, k};
          std::vector<std::int64_t> nodes{tube_node(i, j, k)};
          for (const int step : order) {
            ++corner[step];
            nodes.push_back(tube_node(corner[0], corner[1], corner[2]));
          }
          const int inversions = (order[0] > order[1]) + (order[0] > order[2]) + (order[1] > order[2]);
          if (inversions % 2 == 1) std::swap(nodes[2], nodes[3]);
          tetrahedra.push_back({4, {group}, nodes});
          for (int skip = 0; skip < 4; ++skip) {
            std::array<std::int64_t, 3> facet{};
            for (int n = 0, at = 0; n < 4; ++n)
              if (n != skip) facet[at++] = nodes[n];
            auto key = facet;
            std::sort(key.begin(), key.end());
            ++facets[key].first;
            facets[key].second = facet;
            owner[key] = group;
          }
        } while (std::next_permutation(order.begin(), order.end()));
      }
  for (const auto& [key, entry] : facets) {
    if (entry.first != 1) continue;
    bool bottom = true, top = true;
    for (const auto tag : key) {
      bottom = bottom && tag <= 16;
      top = top && tag > 32;
    }
    const bool fluid = owner[key] == fluid_tag;
    const int group = bottom ? (fluid ? inlet_tag : wall_ends_tag)
                      : top  ? (fluid ? outlet_tag : wall_ends_tag)
                             : outer_tag;
    triangles.push_back({2, {group}, {entry.second.begin(), entry.second.end()}});
  }
  file.elements = triangles;
  file.elements.insert(file.elements.end(), tetrahedra.begin(), tetrahedra.end());
  return file;
}

SceneMeshNeeds tube_needs() {
  SceneMeshNeeds needs;
  needs.fluid = needs.inlet = needs.outlet = true;
  needs.layers = {"media"};
  return needs;
}

ScratchFile::ScratchFile(const std::string& content) {
  static int number = 0;
  const auto folder = std::filesystem::path(testing::TempDir()) / fmt::format("bad_mesh_{}_{}", getpid(), ++number);
  std::filesystem::create_directories(folder);
  path_ = folder / "tube.msh";
  std::ofstream(path_, std::ios::binary) << content;
}

ScratchFile::~ScratchFile() {
  std::filesystem::remove_all(path_.parent_path());
}

std::string verdict(const std::string& content, const SceneMeshNeeds& needs) {
  const ScratchFile file(content);
  std::vector<std::string> volumes;
  if (needs.fluid) volumes.emplace_back("fluid");
  volumes.insert(volumes.end(), needs.layers.begin(), needs.layers.end());
  try {
    check_scene_mesh(read_gmsh(file.path(), volumes), needs, file.path().string());
  } catch (const InputError& error) {
    std::string message = error.what();
    const auto folder = file.path().parent_path().string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }
  return "accepted";
}

}  // namespace fsi::test
