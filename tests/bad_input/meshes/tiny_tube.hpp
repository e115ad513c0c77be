#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
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
  /// Gives all elements of a group their own copies of the nodes for which `chosen` holds.
  template <class Chosen>
  void detach(int group, const Chosen& chosen) {
    std::vector<std::pair<std::int64_t, std::int64_t>> copies;
    for (auto& element : elements) {
      if (element.physical != std::vector<int>{group}) continue;
      for (auto& tag : element.nodes) {
        const Point x = nodes[tag - 1].x;
        if (!chosen(x)) continue;
        std::int64_t copy = 0;
        for (const auto& [from, to] : copies)
          if (from == tag) copy = to;
        if (copy == 0) {
          copy = static_cast<std::int64_t>(nodes.size()) + 1;
          nodes.push_back({copy, x});
          copies.emplace_back(tag, copy);
        }
        tag = copy;
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
