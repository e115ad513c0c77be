#include "mesh_io/gmsh_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/sort_unique.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/facets.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh_io/gmsh_file.hpp"
#include "mesh_io/gmsh_node_index.hpp"
#include "mesh_io/gmsh_plane.hpp"

namespace fsi {

namespace {

/// What gmsh calls the simplices of a dimension, of first and second order.
struct SimplexTypes {
  int linear, quadratic;
};
constexpr SimplexTypes simplex_types[4] = {{15, 15}, {1, 8}, {2, 9}, {4, 11}};

/// 1 or 2 for a simplex of this dimension of first or second order, else 0.
int order_of(int type, int dimension) {
  return type == simplex_types[dimension].linear ? 1 : type == simplex_types[dimension].quadratic ? 2 : 0;
}

/// gmsh lists the last two mid-edge nodes of a tetrahedron the other way round.
constexpr int place_in_file(int dim, int node) {
  return dim == 3 && node == 8 ? 9 : dim == 3 && node == 9 ? 8 : node;
}

/// Turns a parsed file into a mesh, step by step. The order of the mesh is at most that of the file's cells.
template <int Dim, int Order>
class Reader {
  using Mesh = SimplexMesh<Dim, Order>;
  using Cell = typename Mesh::Cell;
  using Facet = typename Mesh::Facet;
  using Key = FacetKey<Dim>;
  using Words = CellWords<Dim>;

 public:
  Reader(std::string file, GmshFile gmsh, const std::vector<std::string>& wanted, TriangleGeometry geometry,
         std::vector<MeshFault>* faults)
      : file_(std::move(file)), gmsh_(std::move(gmsh)), index_(gmsh_, file_), geometry_(geometry), faults_(faults) {
    mesh_.regions = wanted;
  }

  Mesh read() {
    find_regions();
    resolve_node_tags();
    collect_cells();
    if constexpr (Dim == 2) {
      lay_into_plane<Order>(file_, gmsh_, mesh_.cells, geometry_);
      turn_counter_clockwise<Order>(gmsh_.nodes, mesh_.cells);
    }
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

  /// Collects a fault where the caller asks for all of them; else throws it.
  void fault(MeshFault::Kind kind, const std::string& key, const std::string& problem,
             const std::string& remedy) const {
    if (faults_ == nullptr) fail(key, problem, remedy);
    faults_->push_back({kind, InputError(file_, key, problem, remedy).what()});
  }

  /// Which wanted region each physical tag of the cells' dimension stands for.
  void find_regions() {
    if (gmsh_.names.empty())
      fail("$PhysicalNames", "the file names no physical groups",
           fmt::format("name the {} in gmsh, e.g. {}(\"fluid\") = {{1}};", Words::regions, Words::region_command));
    check_dimension();
    std::vector<std::string> volumes;
    for (const auto& name : gmsh_.names)
      if (name.dimension == Dim) volumes.push_back(name.name);
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
      const auto& wanted = mesh_.regions[r];
      bool found = false;
      for (const auto& name : gmsh_.names)
        if (name.dimension == Dim && name.name == wanted) {
          region_of_tag_[name.tag] = static_cast<int>(r);
          found = true;
        }
      if (!found)
        fail(wanted, fmt::format("there is no {} of this name", Words::region_group),
             volumes.empty()
                 ? fmt::format("the file names no {} at all", Words::regions)
                 : fmt::format("nearest: {}; the file has {}", nearest_name(wanted, volumes), listed(volumes)));
    }
  }

  /// Scenes and meshes of different dimensions are the usual reason why groups are not found.
  void check_dimension() const {
    const auto has_names = [&](int dimension) {
      return std::any_of(gmsh_.names.begin(), gmsh_.names.end(),
                         [&](const auto& name) { return name.dimension == dimension; });
    };
    const bool solid = std::any_of(gmsh_.blocks.begin(), gmsh_.blocks.end(), [](const auto& block) {
      return gmsh_type(block.type)->dimension == 3 && !block.tags.empty();
    });
    if (Dim == 2 && has_names(3))
      fail("geometry", "this mesh is three-dimensional: it names physical volumes",
           "choose geometry = \"3d\", or a mesh of physical surfaces");
    if (Dim == 3 && !solid && !has_names(3) && has_names(2))
      fail("geometry", "this mesh is two-dimensional: it names physical surfaces and has no volumes",
           "choose geometry = \"axisymmetric\" or \"plane\", or mesh in three dimensions");
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
      fault(MeshFault::Kind::unused_nodes, "$Nodes",
            fmt::format("unused nodes: {} in no element, the first is node {}", unused, gmsh_.node_tags[first]),
            "remove them, e.g. in gmsh by Coherence Mesh and saving without Mesh.SaveAll");
    }
  }

  void collect_cells() {
    in_other_volume_.assign(gmsh_.nodes.size(), 0);
    for (const auto& block : gmsh_.blocks) {
      const auto* type = gmsh_type(block.type);
      if (type->dimension != Dim || block.tags.empty()) continue;
      std::vector<int> regions;
      for (const int tag : block.physical_tags)
        if (const auto found = region_of_tag_.find(tag); found != region_of_tag_.end())
          regions.push_back(found->second);
      sort_unique(regions);
      if (regions.empty()) {
        for (const auto node : block.nodes) in_other_volume_[node] = 1;
        continue;
      }
      const auto& name = mesh_.regions[regions[0]];
      if (regions.size() > 1)
        fail(name, fmt::format("element {} is in {} {}, too", block.tags[0], region_word, mesh_.regions[regions[1]]),
             fmt::format("put every element into one {} only", Words::region_group));
      check_type(block, name);
      for (std::size_t i = 0; i < block.tags.size(); ++i) {
        Cell cell;
        for (std::size_t k = 0; k < cell.size(); ++k)
          cell[k] = static_cast<int>(block.nodes[type->nodes * i + place_in_file(Dim, static_cast<int>(k))]);
        mesh_.cells.push_back(cell);
        mesh_.cell_region.push_back(regions[0]);
        cell_tags_.push_back(block.tags[i]);
      }
    }
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r)
      if (std::find(mesh_.cell_region.begin(), mesh_.cell_region.end(), static_cast<int>(r)) == mesh_.cell_region.end())
        fail(mesh_.regions[r], fmt::format("the {} is empty: no element belongs to it", Words::region_group),
             fmt::format("assign the {}'s entities to the group, mesh in {} dimensions, and save without Mesh.SaveAll",
                         Dim == 3 ? "volume" : "surface", Words::mesh_dimensions));
  }

  /// Cells must be simplices, all of one order.
  void check_type(const GmshFile::Block& block, const std::string& region) {
    const auto* type = gmsh_type(block.type);
    const int order = order_of(block.type, Dim);
    if (order == 0) {
      const bool simplex = std::string(type->name).find(Words::cells) != std::string::npos;
      fail(region,
           fmt::format("element {} and {} more are {} (type {})", block.tags[0], block.tags.size() - 1, type->name,
                       block.type),
           simplex    ? fmt::format("save {} of first or second order: Mesh.ElementOrder = 1 or 2", Words::cells)
           : Dim == 3 ? "mesh with tetrahedra only, without Recombine or layers of prisms"
                      : "mesh with triangles only, without Recombine");
    }
    if (first_block_ == nullptr) first_block_ = &block;
    if (first_block_->type != block.type)
      fail(region,
           fmt::format("element {} is of {} order, element {} of {}: the mesh mixes both", block.tags[0],
                       order == 1 ? "first" : "second", first_block_->tags[0], order == 1 ? "second" : "first"),
           "save all of them with one Mesh.ElementOrder, 1 or 2");
  }

  /// Cells of one kind that no driver takes.
  struct BadCells {
    MeshFault::Kind kind;
    std::size_t count = 0;
    std::string key{}, problem{}, remedy{};  ///< of the first

    template <class Says>
    void add(const Says& says) {
      if (count++ == 0) std::tie(key, problem, remedy) = says();
    }
  };

  void check_shapes() const {
    BadCells inverted{MeshFault::Kind::inverted_cells}, degenerate{MeshFault::Kind::flat_cells},
        curved{MeshFault::Kind::folded_curved_cells};
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      std::array<Point, nodes_of_simplex(Dim, Order)> x;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = gmsh_.nodes[mesh_.cells[c][k]];
      const double volume = simplex_volume<Dim>(x.data());
      double longest = 0;
      for (int a = 0; a <= Dim; ++a)
        for (int b = a + 1; b <= Dim; ++b) longest = std::max(longest, distance(x[a], x[b]));
      double least = smallest_relative_volume;
      for (int d = 0; d < Dim; ++d) least *= longest;
      const auto bad = [&](BadCells& kind, const std::string& problem, const std::string& remedy) {
        kind.add([&] {
          const auto key = fmt::format("element {} of {}", cell_tags_[c], mesh_.regions[mesh_.cell_region[c]]);
          return std::tuple(key, problem + (faults_ ? at_vertices(x) : ""), remedy);
        });
        if (faults_ == nullptr) fail(kind.key, kind.problem, kind.remedy);
      };
      if (volume < -least)
        bad(inverted, fmt::format("inverted {}, {} {:.6g} {}", Words::cell, Words::measure, volume, Words::unit),
            "order its nodes so that the volume is positive, or mesh again");
      else if (!(volume > least))
        bad(degenerate,
            fmt::format("degenerate {}, {} {:.6g} {} with edges up to {:.6g} mm", Words::cell, Words::measure, volume,
                        Words::unit, longest),
            "mesh again, with Mesh.Optimize = 1");
      else if constexpr (Order == 2) {
        if (is_surely_positive<Dim>(x)) continue;
        if (const auto jacobian = cell_jacobian<Dim>(x); !jacobian.positive)
          bad(curved, bad_curved_cell(jacobian), curved_cell_remedy);
      }
    }
    for (const auto& kind : {inverted, degenerate, curved})
      if (kind.count > 0)
        fault(kind.kind, kind.key, kind.problem + (kind.count > 1 ? fmt::format(", and {} more", kind.count - 1) : ""),
              kind.remedy);
  }

  static std::string at_vertices(const std::array<Point, nodes_of_simplex(Dim, Order)>& x) {
    Point centre{0, 0, 0};
    for (int a = 0; a <= Dim; ++a) centre = centre + (1.0 / (Dim + 1)) * x[a];
    return fmt::format(", at ({:.4g}, {:.4g}, {:.4g}) mm", centre[0], centre[1], centre[2]);
  }

  /// In version 2.2 an element in two groups is listed once for each of them.
  void check_listed_twice() const {
    constexpr int n = Dim + 1;
    std::vector<std::array<int, n + 1>> sorted(mesh_.cells.size());  // vertices, cell
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      std::copy_n(mesh_.cells[c].begin(), n, sorted[c].begin());
      std::sort(sorted[c].begin(), sorted[c].begin() + n);
      sorted[c][n] = static_cast<int>(c);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (!std::equal(sorted[i].begin(), sorted[i].begin() + n, sorted[i - 1].begin())) continue;
      const int first = sorted[i - 1][n], second = sorted[i][n];
      const auto &name = mesh_.regions[mesh_.cell_region[first]], &other = mesh_.regions[mesh_.cell_region[second]];
      if (name != other)
        fail(name, fmt::format("element {} is in {} {}, too", cell_tags_[first], region_word, other),
             fmt::format("put every element into one {} only", Words::region_group));
      fault(MeshFault::Kind::repeated_cells, name,
            fmt::format("elements {} and {} have the same nodes", cell_tags_[first], cell_tags_[second]),
            "remove one of them");
      return;
    }
  }

  void collect_facets() {
    const Facet unset = unset_facet();
    std::unordered_map<Key, Facet, FacetKeyHash> oriented;
    std::vector<std::pair<int, std::string>> names;  // surfaces by tag
    for (const auto& name : gmsh_.names)
      if (name.dimension == Dim - 1) names.emplace_back(name.tag, name.name);
    const auto named = [&](int tag) {
      return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == tag; });
    };
    for (const auto& block : gmsh_.blocks) {
      if (order_of(block.type, Dim - 1) == 0) continue;
      if (std::none_of(block.physical_tags.begin(), block.physical_tags.end(),
                       [&](int tag) { return named(tag) != names.end(); }))
        continue;
      for (std::size_t i = 0; i < block.tags.size(); ++i) oriented.emplace(key_of(block, i), unset);
    }

    const auto is_fluid = [&](int cell) { return mesh_.regions[mesh_.cell_region[cell]] == group::fluid; };
    for (int pass = 0; pass < 2; ++pass)  // fluid cells first: they orient what they share
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
        if (is_fluid(static_cast<int>(c)) != (pass == 0)) continue;
        for (const auto& facet : outward_facets<Dim, Order>(mesh_.cells[c]))
          if (const auto found = oriented.find(facet_key<Dim>(facet));
              found != oriented.end() && found->second == unset)
            found->second = facet;
      }

    for (const auto& [tag, name] : names) {
      typename Mesh::FacetGroup facets{name, {}};
      std::map<Key, std::int64_t> seen;
      for (const auto& block : gmsh_.blocks) {
        const auto* type = gmsh_type(block.type);
        if (type->dimension != Dim - 1) continue;
        if (std::find(block.physical_tags.begin(), block.physical_tags.end(), tag) == block.physical_tags.end())
          continue;
        for (std::size_t i = 0; i < block.tags.size(); ++i) {
          if (order_of(block.type, Dim - 1) > 0) {
            const auto key = key_of(block, i);
            const auto& facet = oriented.at(key);
            if (facet != unset) {
              if (const auto [entry, is_new] = seen.emplace(key, block.tags[i]); !is_new)
                fail(name, fmt::format("{} {} and {} have the same nodes", Words::facets, entry->second, block.tags[i]),
                     "remove one of them");
              facets.facets.push_back(facet);
              continue;
            }
          }
          if (in_other_volume(block, i, type->nodes)) continue;
          const auto problem =
              fmt::format("element {} ({}) is no facet of a {}", block.tags[i], type->name, Words::cell);
          if (group::has_meaning(name))
            fail(name, problem,
                 Dim == 3 ? "save surfaces and volumes of one conforming mesh of triangles and tetrahedra"
                          : "save curves and surfaces of one conforming mesh of triangles");
          if (facets.astray.empty()) facets.astray = problem;
        }
      }
      if (facets.facets.empty()) continue;
      const auto same = std::find_if(mesh_.facet_groups.begin(), mesh_.facet_groups.end(),
                                     [&, &wanted = name](const auto& other) { return other.name == wanted; });
      if (same == mesh_.facet_groups.end()) {
        mesh_.facet_groups.push_back(std::move(facets));
      } else {
        same->facets.insert(same->facets.end(), facets.facets.begin(), facets.facets.end());
        if (same->astray.empty()) same->astray = facets.astray;
      }
    }
  }

  /// Whether an element of a surface can belong to a volume that was left out.
  bool in_other_volume(const GmshFile::Block& block, std::size_t i, int nodes) const {
    for (int k = 0; k < nodes; ++k)
      if (!in_other_volume_[block.nodes[i * nodes + k]]) return false;
    return true;
  }

  /// The vertices of element i of a block of facets.
  static Key key_of(const GmshFile::Block& block, std::size_t i) {
    Key key;
    for (int k = 0; k < Dim; ++k) key[k] = static_cast<int>(block.nodes[gmsh_type(block.type)->nodes * i + k]);
    std::sort(key.begin(), key.end());
    return key;
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

  static Facet unset_facet() {
    Facet facet;
    facet.fill(-1);
    return facet;
  }
  static constexpr const char* region_word = Dim == 3 ? "volume" : "surface";

  std::string file_;
  GmshFile gmsh_;
  NodeIndex index_;
  TriangleGeometry geometry_;
  std::vector<MeshFault>* faults_;
  Mesh mesh_;  // with places in the file as node numbers until the last step
  std::map<int, int> region_of_tag_;
  std::vector<std::int64_t> cell_tags_;
  std::vector<char> in_other_volume_;             // per node in the file
  const GmshFile::Block* first_block_ = nullptr;  // of wanted cells
};

/// Whether the first wanted cells of the file are quadratic; the reader refuses a mixture.
bool has_quadratic_cells(const GmshFile& gmsh, const std::vector<std::string>& wanted, int dimension) {
  for (const auto& block : gmsh.blocks) {
    if (gmsh_type(block.type)->dimension != dimension || block.tags.empty()) continue;
    for (const auto& name : gmsh.names)
      if (name.dimension == dimension && std::find(wanted.begin(), wanted.end(), name.name) != wanted.end() &&
          std::find(block.physical_tags.begin(), block.physical_tags.end(), name.tag) != block.physical_tags.end())
        return order_of(block.type, dimension) == 2;
  }
  return false;
}

}  // namespace

template <int Dim, int Order>
SimplexMesh<Dim, Order> read_gmsh(const std::filesystem::path& path, const std::vector<std::string>& regions_wanted,
                                  TriangleGeometry geometry, std::vector<MeshFault>* faults) {
  auto gmsh = parse_gmsh(path);
  if constexpr (Order == 2)
    if (!has_quadratic_cells(gmsh, regions_wanted, Dim))
      return with_mid_edge_nodes(
          Reader<Dim, 1>(path.string(), std::move(gmsh), regions_wanted, geometry, faults).read());
  return Reader<Dim, Order>(path.string(), std::move(gmsh), regions_wanted, geometry, faults).read();
}

AnyMesh read_gmsh(const std::filesystem::path& path, const std::vector<std::string>& regions_wanted, int dimension,
                  int order, TriangleGeometry geometry) {
  if (dimension == 3 && order == 1) return read_gmsh<3, 1>(path, regions_wanted, geometry);
  if (dimension == 3) return read_gmsh<3, 2>(path, regions_wanted, geometry);
  if (order == 1) return read_gmsh<2, 1>(path, regions_wanted, geometry);
  return read_gmsh<2, 2>(path, regions_wanted, geometry);
}

std::vector<std::string> gmsh_regions(const std::filesystem::path& path, int dimension) {
  std::vector<std::string> regions;
  for (const auto& name : parse_gmsh(path).names)
    if (name.dimension == dimension) regions.push_back(name.name);
  return regions;
}

int gmsh_dimension(const std::filesystem::path& path) {
  return gmsh_dimension(parse_gmsh(path));
}

int gmsh_dimension(const GmshFile& file) {
  int highest = 0;
  for (const auto& name : file.names) highest = std::max(highest, name.dimension);
  return highest;
}

int gmsh_order(const GmshFile& file, int dimension) {
  for (const auto& block : file.blocks) {
    const auto* type = gmsh_type(block.type);
    if (type != nullptr && type->dimension == dimension && type->nodes > dimension + 1) return 2;
  }
  return 1;
}

#define INSTANTIATE(Dim, Order)                                                                             \
  template SimplexMesh<Dim, Order> read_gmsh(const std::filesystem::path&, const std::vector<std::string>&, \
                                             TriangleGeometry, std::vector<MeshFault>*);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
