#include "mesh/wall_growth.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/offset_normals.hpp"
#include "mesh/point_math.hpp"
#include "mesh/prism_columns.hpp"
#include "mesh/quality.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;

bool is_named(const TetrahedralMesh& mesh, const std::string& name) {
  return mesh.facets(name) != nullptr;
}

/// The names of volumes and surfaces that the mesh is to get.
void require_new_names(const TetrahedralMesh& lumen, const std::vector<GrownLayer>& layers) {
  std::set<std::string> names(lumen.regions.begin(), lumen.regions.end());
  for (const auto& layer : layers)
    if (!names.insert(layer.name).second)
      throw InputError("fsi-mesh", "--layer", "the volume " + layer.name + " is there already",
                       "give the layer another name");
  for (const char* name : {group::outer, group::wall_ends})
    if (is_named(lumen, name))
      throw InputError("fsi-mesh", std::string("surface ") + name, "is there already, but the wall is to make it",
                       "rename it in the lumen's mesh");
}

/// The layers' levels, and their regions in the mesh.
std::vector<NewLevel> levels_of(const std::vector<GrownLayer>& layers, TetrahedralMesh& mesh) {
  std::vector<NewLevel> levels;
  double height = 0;
  for (const auto& layer : layers) {
    mesh.regions.push_back(layer.name);
    for (int e = 1; e <= layer.elements; ++e)
      levels.push_back({height + layer.thickness * e / layer.elements, static_cast<int>(mesh.regions.size()) - 1});
    height += layer.thickness;
  }
  return levels;
}

/// \param first  of the wall's cells
void require_no_folds(const TetrahedralMesh& mesh, std::size_t first) {
  for (std::size_t c = first; c < mesh.cells.size(); ++c) {
    std::array<Point, 4> corners;
    for (int a = 0; a < 4; ++a) corners[a] = mesh.nodes[mesh.cells[c][a]];
    if (mean_ratio(corners) > 0) continue;
    throw InputError(
        "fsi-mesh", "--layer",
        fmt::format("the wall folds near ({:.4g}, {:.4g}, {:.4g}) mm, where the surface is hollow or rough",
                    corners[0][0], corners[0][1], corners[0][2]),
        "give thinner layers, a smoother surface, or more --smoothing");
  }
}

}  // namespace

std::vector<Facet> facets_to_grow_on(const TetrahedralMesh& lumen, const std::string& on) {
  std::set<FacetKey<3>> wanted, taken;
  if (!on.empty()) {
    if (!is_named(lumen, on)) {
      std::string names;
      for (const auto& group : lumen.facet_groups) names += (names.empty() ? "" : ", ") + group.name;
      throw InputError("fsi-mesh", "--on", "the mesh has no surface " + on,
                       names.empty() ? "leave it out: the mesh names no surfaces" : "its surfaces are " + names);
    }
    for (const auto& facet : *lumen.facets(on)) wanted.insert(facet_key<3>(facet));
  } else {
    for (const auto& group : lumen.facet_groups)
      if (group.name != group::inner)
        for (const auto& facet : group.facets) taken.insert(facet_key<3>(facet));
  }
  std::vector<Facet> facets;
  for (const auto& facet : boundary_facets(lumen, {lumen.region_index(group::fluid)})) {
    const auto key = facet_key<3>(facet.nodes);
    if (on.empty() ? taken.count(key) == 0 : wanted.count(key) > 0) facets.push_back(facet.nodes);
  }
  if (facets.empty())
    throw InputError("fsi-mesh", "--on", "leaves no facet of the fluid's boundary for the wall to grow on",
                     "give the name of the lumen's surface, or name the openings alone");
  return facets;
}

TetrahedralMesh grow_wall(const TetrahedralMesh& lumen, const WallGrowth& growth) {
  require_new_names(lumen, growth.layers);
  const auto facets = facets_to_grow_on(lumen, growth.on);
  auto [ways, rim] = offset_normals(lumen.nodes, facets, growth.smoothing);
  if (!growth.total.empty())
    for (auto& [node, way] : ways) way = growth.total.at(node) * way;

  TetrahedralMesh mesh = lumen;
  mesh.facet_groups.clear();
  for (const auto& group : lumen.facet_groups)
    if (group.name != growth.on) mesh.facet_groups.push_back(group);
  const Levels levels = raise_levels(levels_of(growth.layers, mesh), ways, mesh);
  fill_with_prisms(facets, levels, mesh);

  TetrahedralMesh::FacetGroup outer{group::outer, {}};
  for (auto facet : facets) {
    for (int& node : facet) node = levels.nodes.back().at(node);
    outer.facets.push_back(facet);
  }
  mesh.facet_groups.push_back(std::move(outer));
  if (auto ends = sides_of_columns(mesh, rim, levels); !ends.empty())
    mesh.facet_groups.push_back({group::wall_ends, std::move(ends)});
  require_no_folds(mesh, lumen.cells.size());
  return mesh;
}

}  // namespace fsi
