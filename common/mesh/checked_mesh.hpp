#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "base/error.hpp"
#include "base/names.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/point_math.hpp"
#include "mesh/symmetry_planes.hpp"

namespace fsi {

inline constexpr const char* conforming_remedy =
    "mesh fluid and wall together, with one shared surface (gmsh: BooleanFragments or Coherence before meshing)";

/// A mesh that is being checked, what the scene needs of it, and what several checks share.
template <int Dim, int Order>
struct CheckedMesh {
  using Mesh = SimplexMesh<Dim, Order>;
  using Facet = typename Mesh::Facet;
  using FacetSet = std::unordered_set<FacetKey<Dim>, FacetKeyHash>;

  const Mesh& mesh;
  const SceneMeshNeeds& needs;
  const std::string& file;  ///< for messages
  std::vector<SymmetryPlane<Dim, Order>> planes = symmetry_planes(mesh);
  int fluid = -1;             ///< region
  std::vector<int> layers{};  ///< regions
  /// A facet's cells; the second is -1 on the boundary.
  struct FacetCells {
    FacetKey<Dim> key;
    int first, second;
  };
  std::vector<FacetCells> facet_cells{};  ///< of all facets of cells, by ascending keys

  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& remedy) const {
    throw InputError(file, key, problem, remedy);
  }

  static std::string text(const Point& at) {
    const Point x = without_rounding(at);
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
  }
  /// Centre of the vertices of a facet.
  Point centroid(const Facet& f) const {
    Point sum = mesh.nodes[f[0]];
    for (int i = 1; i < Dim; ++i) sum = sum + mesh.nodes[f[i]];
    return (1.0 / Dim) * sum;
  }

  /// The cells of a facet; null if no cell has it.
  const FacetCells* cells_of(const FacetKey<Dim>& key) const {
    const auto found = std::lower_bound(facet_cells.begin(), facet_cells.end(), key,
                                        [](const FacetCells& one, const auto& sought) { return one.key < sought; });
    return found != facet_cells.end() && found->key == key ? &*found : nullptr;
  }

  const std::string& region_of(int cell) const { return mesh.regions[mesh.cell_region[cell]]; }
  bool axisymmetric() const { return needs.geometry == TriangleGeometry::axisymmetric; }
  bool held_by_wall_ends_alone() const {
    return needs.holding.size() == 1 && needs.holding.front() == group::wall_ends;
  }
  /// A wall of revolution can drift along its axis alone. Inertia bounds that, but where it is sought at rest.
  bool held_by_inertia() const { return Dim == 2 && axisymmetric() && !needs.at_rest; }
  bool is_wall(int cell) const {
    return std::find(layers.begin(), layers.end(), mesh.cell_region[cell]) != layers.end();
  }

  /// Diagonal of the box around the mesh, mm.
  double size() const { return BoundingBox(mesh.nodes).size(); }

  /// Calls visit(facets) for the facets of the named groups and of the planes of symmetry.
  template <class Visit>
  void for_groups_and_planes(const std::vector<std::string>& names, Visit visit) const {
    for (const auto& name : names)
      if (const auto* facets = mesh.facets(name)) visit(*facets);
    for (const auto& plane : planes) visit(plane.group->facets);
  }

  /// For remedies, ending in ", or ": how to use a surface of another name instead; empty if there is none.
  std::string other_name_for(const std::string& missed, const std::vector<int>& regions) const {
    const auto names = unused_surfaces(regions);
    if (names.empty()) return "";
    const std::string name = nearest_name(missed, names);
    if (missed == group::wall_ends)
      return fmt::format("if {} is meant, rename it, or add [[support]] with surface = \"{}\" and fixed = {}, or ",
                         one_of(names), name, all_components());
    if (missed == group::inlet || missed == group::outlet)
      return fmt::format("if {} is meant, rename it, or add [[opening]] with surface = \"{}\", or ", one_of(names),
                         name);
    return fmt::format("if {} is meant, give that name, or ", one_of(names));
  }

  /// For remedies, ending in ", or ": volumes that the case leaves out may continue the wall; empty if there are none.
  std::string left_out_volumes() const {
    if (needs.left_out.empty()) return "";
    return fmt::format("give {} of the mesh, which the case leaves out, a section [structure.layers.{}], or ",
                       fmt::join(needs.left_out, ", "), needs.left_out.front());
  }

 private:
  /// Surfaces on the outside of these volumes that the scene does not use: one of them may be the missing one.
  std::vector<std::string> unused_surfaces(const std::vector<int>& regions) const {
    std::vector<std::string> used{group::inlet, group::outlet, group::wall_ends, group::outer, group::inner};
    used.insert(used.end(), needs.openings.begin(), needs.openings.end());
    used.insert(used.end(), needs.supports.begin(), needs.supports.end());
    std::vector<std::string> found;
    for (const auto& group : mesh.facet_groups) {
      if (group::is_symmetry_plane(group.name) || std::find(used.begin(), used.end(), group.name) != used.end())
        continue;
      const bool outside = std::all_of(group.facets.begin(), group.facets.end(), [&](const Facet& facet) {
        const auto* cells = cells_of(facet_key<Dim>(facet));
        return cells && cells->second < 0 &&
               std::find(regions.begin(), regions.end(), mesh.cell_region[cells->first]) != regions.end();
      });
      if (outside && !group.facets.empty()) found.push_back(group.name);
    }
    return found;
  }

  /// The value of `fixed` that clamps the surface of a support.
  const char* all_components() const {
    if (Dim == 3) return R"(["x", "y", "z"])";
    return axisymmetric() ? R"(["r", "z"])" : R"(["x", "y"])";
  }
};

}  // namespace fsi
