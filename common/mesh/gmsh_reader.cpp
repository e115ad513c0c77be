#include "mesh/gmsh_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "mesh/facets.hpp"
#include "mesh/gmsh_file.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr int triangle_type = 2, tetrahedron_type = 4;

/// The way from a node's tag to its place in the file.
class NodeIndex {
 public:
  NodeIndex(const GmshFile& gmsh, const std::string& file) {
    entries_.reserve(gmsh.node_tags.size());
    for (std::size_t i = 0; i < gmsh.node_tags.size(); ++i)
      entries_.emplace_back(gmsh.node_tags[i], static_cast<int>(i));
    std::sort(entries_.begin(), entries_.end());
    for (std::size_t i = 1; i < entries_.size(); ++i)
      if (entries_[i].first == entries_[i - 1].first)
        throw InputError(file, "$Nodes", fmt::format("node tag {} appears twice", entries_[i].first),
                         "give every node a tag of its own");
  }

  /// -1 for a tag that no node has.
  int find(std::int64_t tag) const {
    // Tags mostly run from 1 without gaps; then the place is known without a search.
    if (tag >= 1 && tag <= static_cast<std::int64_t>(entries_.size()) && entries_[tag - 1].first == tag)
      return entries_[tag - 1].second;
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), std::make_pair(tag, 0));
    return found != entries_.end() && found->first == tag ? found->second : -1;
  }

 private:
  std::vector<std::pair<std::int64_t, int>> entries_;
};

/// Turns a parsed file into a mesh, step by step.
class Reader {
 public:
  Reader(const std::filesystem::path& path, const std::vector<std::string>& wanted)
      : file_(path.string()), gmsh_(parse_gmsh(path)), index_(gmsh_, file_) {
    mesh_.regions = wanted;
  }

  TetrahedralMesh read() {
    find_volumes();
    resolve_node_tags();
    collect_cells();
    check_shapes();
    check_listed_twice();
    collect_facets();
    renumber_nodes();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& remedy) const {
    throw InputError(file_, key, problem, remedy);
  }

  /// Which wanted region each physical volume tag stands for.
  void find_volumes() {
    if (gmsh_.names.empty())
      fail("$PhysicalNames", "the file names no physical groups",
           "name the volumes in gmsh, e.g. Physical Volume(\"fluid\") = {1};");
    std::vector<std::string> volumes;
    for (const auto& name : gmsh_.names)
      if (name.dimension == 3) volumes.push_back(name.name);
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
      const auto& wanted = mesh_.regions[r];
      bool found = false;
      for (const auto& name : gmsh_.names)
        if (name.dimension == 3 && name.name == wanted) {
          region_of_tag_[name.tag] = static_cast<int>(r);
          found = true;
        }
      if (!found)
        fail(wanted, "there is no physical volume of this name",
             volumes.empty()
                 ? "the file names no volumes at all"
                 : fmt::format("nearest: {}; the file has {}", nearest_name(wanted, volumes), listed(volumes)));
    }
  }

  static std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  /// Replaces node tags by places in the file, in all elements, and looks for nodes that none of them uses.
  void resolve_node_tags() {
    std::vector<char> used(gmsh_.nodes.size(), 0);
    for (auto& block : gmsh_.blocks) {
      const auto* type = gmsh_type(block.type);
      for (std::size_t i = 0; i < block.nodes.size(); ++i) {
        const int place = index_.find(block.nodes[i]);
        if (place < 0)
          fail(fmt::format("element {}", block.tags[i / type->nodes]),
               fmt::format("node {} does not exist", block.nodes[i]), "write the file again with gmsh");
        block.nodes[i] = place;
        used[place] = 1;
      }
    }
    const auto unused = std::count(used.begin(), used.end(), 0);
    if (unused > 0) {
      const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
      fail("$Nodes",
           fmt::format("unused nodes: {} in no element, the first is node {}", unused, gmsh_.node_tags[first]),
           "remove them, e.g. in gmsh by Coherence Mesh and saving without Mesh.SaveAll");
    }
  }

  void collect_cells() {
    in_other_volume_.assign(gmsh_.nodes.size(), 0);
    for (const auto& block : gmsh_.blocks) {
      const auto* type = gmsh_type(block.type);
      if (type->dimension != 3 || block.tags.empty()) continue;
      std::vector<int> regions;
      for (const int tag : block.physical_tags)
        if (const auto found = region_of_tag_.find(tag); found != region_of_tag_.end())
          regions.push_back(found->second);
      std::sort(regions.begin(), regions.end());
      regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
      if (regions.empty()) {
        for (const auto node : block.nodes) in_other_volume_[node] = 1;
        continue;
      }
      const auto& name = mesh_.regions[regions[0]];
      if (regions.size() > 1)
        fail(name, fmt::format("element {} is in volume {}, too", block.tags[0], mesh_.regions[regions[1]]),
             "put every element into one physical volume only");
      if (block.type != tetrahedron_type) {
        const bool tetrahedra = std::string(type->name).find("tetrahedra") != std::string::npos;
        fail(name,
             fmt::format("element {} and {} more are {} (type {})", block.tags[0], block.tags.size() - 1, type->name,
                         block.type),
             tetrahedra ? "save linear tetrahedra: Mesh.ElementOrder = 1"
                        : "mesh with tetrahedra only, without Recombine or layers of prisms");
      }
      for (std::size_t i = 0; i < block.tags.size(); ++i) {
        TetrahedralMesh::Cell cell;
        for (int k = 0; k < 4; ++k) cell[k] = static_cast<int>(block.nodes[4 * i + k]);
        mesh_.cells.push_back(cell);
        mesh_.cell_region.push_back(regions[0]);
        cell_tags_.push_back(block.tags[i]);
      }
    }
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r)
      if (std::find(mesh_.cell_region.begin(), mesh_.cell_region.end(), static_cast<int>(r)) == mesh_.cell_region.end())
        fail(mesh_.regions[r], "the physical volume is empty: no element belongs to it",
             "assign the volume's entities to the group, mesh in three dimensions, and save without Mesh.SaveAll");
  }

  void check_shapes() const {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      Point x[4];
      for (int k = 0; k < 4; ++k) x[k] = gmsh_.nodes[mesh_.cells[c][k]];
      const double volume = tetrahedron_volume(x[0], x[1], x[2], x[3]);
      double longest = 0;
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b) longest = std::max(longest, distance(x[a], x[b]));
      if (volume > smallest_relative_volume * longest * longest * longest) continue;
      const auto key = fmt::format("element {} of {}", cell_tags_[c], mesh_.regions[mesh_.cell_region[c]]);
      if (volume < -smallest_relative_volume * longest * longest * longest)
        fail(key, fmt::format("inverted tetrahedron, volume {:.6g} mm^3", volume),
             "order its nodes so that the volume is positive, or mesh again");
      fail(key, fmt::format("degenerate tetrahedron, volume {:.6g} mm^3 with edges up to {:.6g} mm", volume, longest),
           "mesh again, with Mesh.Optimize = 1");
    }
  }

  /// In version 2.2 an element in two groups is listed once for each of them.
  void check_listed_twice() const {
    std::vector<std::array<int, 5>> sorted(mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      std::copy(mesh_.cells[c].begin(), mesh_.cells[c].end(), sorted[c].begin());
      std::sort(sorted[c].begin(), sorted[c].begin() + 4);
      sorted[c][4] = static_cast<int>(c);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (!std::equal(sorted[i].begin(), sorted[i].begin() + 4, sorted[i - 1].begin())) continue;
      const int first = sorted[i - 1][4], second = sorted[i][4];
      const auto &name = mesh_.regions[mesh_.cell_region[first]], &other = mesh_.regions[mesh_.cell_region[second]];
      if (name != other)
        fail(name, fmt::format("element {} is in volume {}, too", cell_tags_[first], other),
             "put every element into one physical volume only");
      fail(name, fmt::format("elements {} and {} have the same nodes", cell_tags_[first], cell_tags_[second]),
           "remove one of them");
    }
  }

  void collect_facets() {
    std::unordered_map<std::array<int, 3>, TetrahedralMesh::Facet, FacetKeyHash> oriented;
    std::vector<std::pair<int, std::string>> names;  // surfaces by tag
    for (const auto& name : gmsh_.names)
      if (name.dimension == 2) names.emplace_back(name.tag, name.name);
    const auto named = [&](int tag) {
      return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == tag; });
    };
    for (const auto& block : gmsh_.blocks) {
      if (block.type != triangle_type) continue;
      if (std::none_of(block.physical_tags.begin(), block.physical_tags.end(),
                       [&](int tag) { return named(tag) != names.end(); }))
        continue;
      for (std::size_t i = 0; i < block.tags.size(); ++i) oriented.emplace(facet_key(triangle(block, i)), unset);
    }

    const auto is_fluid = [&](int cell) { return mesh_.regions[mesh_.cell_region[cell]] == group::fluid; };
    for (int pass = 0; pass < 2; ++pass)  // fluid cells first: they have the first word on orientation
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
        if (is_fluid(static_cast<int>(c)) != (pass == 0)) continue;
        for (const auto& facet : outward_facets(mesh_.cells[c]))
          if (const auto found = oriented.find(facet_key(facet)); found != oriented.end() && found->second == unset)
            found->second = facet;
      }

    for (const auto& [tag, name] : names) {
      TetrahedralMesh::FacetGroup group{name, {}};
      std::map<std::array<int, 3>, std::int64_t> seen;
      for (const auto& block : gmsh_.blocks) {
        const auto* type = gmsh_type(block.type);
        if (type->dimension != 2) continue;
        if (std::find(block.physical_tags.begin(), block.physical_tags.end(), tag) == block.physical_tags.end())
          continue;
        for (std::size_t i = 0; i < block.tags.size(); ++i) {
          if (block.type == triangle_type) {
            const auto key = facet_key(triangle(block, i));
            const auto& facet = oriented.at(key);
            if (facet != unset) {
              if (const auto [entry, is_new] = seen.emplace(key, block.tags[i]); !is_new)
                fail(name, fmt::format("triangles {} and {} have the same nodes", entry->second, block.tags[i]),
                     "remove one of them");
              group.facets.push_back(facet);
              continue;
            }
          }
          if (has_meaning(name) && !in_other_volume(block, i, type->nodes))
            fail(name, fmt::format("element {} ({}) is no facet of a tetrahedron", block.tags[i], type->name),
                 "save surfaces and volumes of one conforming mesh of triangles and tetrahedra");
        }
      }
      if (group.facets.empty()) continue;
      const auto same = std::find_if(mesh_.facet_groups.begin(), mesh_.facet_groups.end(),
                                     [&, &wanted = name](const auto& other) { return other.name == wanted; });
      if (same == mesh_.facet_groups.end())
        mesh_.facet_groups.push_back(std::move(group));
      else
        same->facets.insert(same->facets.end(), group.facets.begin(), group.facets.end());
    }
  }

  static bool has_meaning(const std::string& name) {
    return std::find(group::surfaces.begin(), group::surfaces.end(), name) != group::surfaces.end();
  }

  /// Whether an element of a surface can belong to a volume that was left out.
  bool in_other_volume(const GmshFile::Block& block, std::size_t i, int nodes) const {
    for (int k = 0; k < nodes; ++k)
      if (!in_other_volume_[block.nodes[i * nodes + k]]) return false;
    return true;
  }

  static std::array<int, 3> triangle(const GmshFile::Block& block, std::size_t i) {
    return {static_cast<int>(block.nodes[3 * i]), static_cast<int>(block.nodes[3 * i + 1]),
            static_cast<int>(block.nodes[3 * i + 2])};
  }

  /// Drops the nodes that only left-out elements use.
  void renumber_nodes() {
    std::vector<int> number(gmsh_.nodes.size(), -1);
    for (const auto& cell : mesh_.cells)
      for (const int node : cell) number[node] = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (number[i] < 0) continue;
      number[i] = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.push_back(gmsh_.nodes[i]);
    }
    for (auto& cell : mesh_.cells)
      for (int& node : cell) node = number[node];
    for (auto& group : mesh_.facet_groups)
      for (auto& facet : group.facets)
        for (int& node : facet) node = number[node];
  }

  static constexpr TetrahedralMesh::Facet unset{-1, -1, -1};

  std::string file_;
  GmshFile gmsh_;
  NodeIndex index_;
  TetrahedralMesh mesh_;  // with places in the file as node numbers until the last step
  std::map<int, int> region_of_tag_;
  std::vector<std::int64_t> cell_tags_;
  std::vector<char> in_other_volume_;  // per node in the file
};

}  // namespace

TetrahedralMesh read_gmsh(const std::filesystem::path& path, const std::vector<std::string>& volumes_wanted) {
  return Reader(path, volumes_wanted).read();
}

std::vector<std::string> gmsh_volumes(const std::filesystem::path& path) {
  std::vector<std::string> volumes;
  for (const auto& name : parse_gmsh(path).names)
    if (name.dimension == 3) volumes.push_back(name.name);
  return volumes;
}

}  // namespace fsi
