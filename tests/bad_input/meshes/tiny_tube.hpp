#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/mesh_checks.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi::test {

/// A small mesh file in memory, to be damaged and written. Independent of the code under test.
struct TinyFile {
  struct Node {
    std::int64_t tag;
    Point x;
  };
  struct Element {
    int type;
    std::vector<int> physical;  ///< tags
    std::vector<std::int64_t> nodes;
  };
  struct Name {
    int dimension, tag;
    std::string name;
  };
  std::vector<Name> names;
  std::vector<Node> nodes;
  std::vector<Element> elements;  ///< tag i + 1

  std::string text_41() const;
  std::string text_22() const;
  std::string binary_41() const;
  std::string binary_22() const;

  /// Positions in `elements` of the tetrahedra or triangles of a physical tag.
  std::vector<std::size_t> of_group(int tag) const;
  /// Gives the elements of some groups their own copies of the nodes for which `chosen` holds, moved by `moved`.
  template <class Chosen, class Moved>
  void detach(const std::vector<int>& groups, const Chosen& chosen, const Moved& moved) {
    std::map<std::int64_t, std::int64_t> copies;
    for (auto& element : elements) {
      if (std::find(groups.begin(), groups.end(), element.physical.front()) == groups.end()) continue;
      for (auto& tag : element.nodes) {
        const Point x = nodes[tag - 1].x;
        if (!chosen(x)) continue;
        const auto [entry, is_new] = copies.emplace(tag, static_cast<std::int64_t>(nodes.size()) + 1);
        if (is_new) nodes.push_back({entry->second, moved(x)});
        tag = entry->second;
      }
    }
  }
};

/// Physical tags of the tiny tube.
enum Group : int { inlet_tag = 1, outlet_tag = 2, wall_ends_tag = 3, outer_tag = 4, fluid_tag = 11, media_tag = 12 };

/// A square duct: [0,3] x [0,3] x [0,2] mm in unit cubes of six tetrahedra each, the middle column fluid, the eight
/// around it wall. 48 nodes, 108 tetrahedra. Node (i, j, k) has tag 1 + i + 4 j + 16 k.
TinyFile tiny_tube();
std::int64_t tube_node(int i, int j, int k);

SceneMeshNeeds tube_needs();

/// A file in a folder of its own that goes away with it.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& content);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Reads the content as a scene with fluid and wall does; the message of the InputError, without the folder, or
/// "accepted".
std::string verdict(const std::string& content, const SceneMeshNeeds& needs = tube_needs());

}  // namespace fsi::test
