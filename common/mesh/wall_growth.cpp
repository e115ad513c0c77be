#include "mesh/wall_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/column_tops.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/offset_distance.hpp"
#include "mesh/offset_normals.hpp"
#include "mesh/point_math.hpp"
#include "mesh/prism_columns.hpp"
#include "mesh/quality.hpp"
#include "mesh/surface_distance.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;

constexpr double no_room = 0.25;  // of the thickness between nodes; over an edge half of it is left

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

/// What lies beyond the rims of the facets that the wall grows on: the named surfaces of the lumen, by number of the group.
RimSides sides_of_rims(const TetrahedralMesh& lumen, const std::vector<Facet>& facets) {
  std::set<FacetKey<3>> grown;
  for (const auto& facet : facets) grown.insert(facet_key<3>(facet));
  RimSides sides;
  for (const auto& group : lumen.facet_groups) {
    Point normal{0, 0, 0};
    for (const auto& facet : group.facets) {
      if (grown.count(facet_key<3>(facet)) > 0) continue;
      normal = normal + triangle_area_vector(lumen.nodes[facet[0]], lumen.nodes[facet[1]], lumen.nodes[facet[2]]);
      for (int k = 0; k < 3; ++k)
        sides.surface[std::minmax(facet[k], facet[(k + 1) % 3])] = static_cast<int>(sides.normals.size());
    }
    const double area = norm(normal);
    sides.normals.push_back(area > 0 ? (1 / area) * normal : normal);
  }
  return sides;
}

/// The ground that the columns stand on: nodes in ascending order of their numbers.
/// \param nodes  gets these numbers
ColumnGround ground_of(const TetrahedralMesh& lumen, const WallGrowth& growth, const std::vector<Facet>& facets,
                       const OffsetNormals& offset, std::vector<int>& nodes) {
  ColumnGround ground;
  std::map<int, int> number;
  double whole = 0;
  for (const auto& layer : growth.layers) whole += layer.thickness;
  for (const auto& [node, normal] : offset.normals) {
    number[node] = static_cast<int>(nodes.size());
    nodes.push_back(node);
    ground.nodes.push_back(lumen.nodes[node]);
    ground.normals.push_back(normal);
    const auto planes = offset.planes.find(node);
    ground.planes.push_back(planes == offset.planes.end() ? std::vector<Point>() : planes->second);
    ground.thickness.push_back(growth.total.empty() ? whole : whole * growth.total.at(node));
  }
  for (auto facet : facets) {
    for (int& node : facet) node = number.at(node);
    ground.facets.push_back(facet);
  }
  double height = 0;
  for (const auto& layer : growth.layers) {
    for (int e = 1; e <= layer.elements; ++e)
      ground.levels.push_back((height + layer.thickness * e / layer.elements) / whole);
    height += layer.thickness;
  }
  ground.levels.back() = 1;
  return ground;
}

/// The regions of the layers' cells, per level; the layers are added to those of the mesh.
std::vector<int> regions_of(const std::vector<GrownLayer>& layers, TetrahedralMesh& mesh) {
  std::vector<int> regions;
  for (const auto& layer : layers) {
    regions.insert(regions.end(), static_cast<std::size_t>(layer.elements), static_cast<int>(mesh.regions.size()));
    mesh.regions.push_back(layer.name);
  }
  return regions;
}

ReachedThickness reached_by(const ColumnGround& ground, const std::vector<Point>& tops, const OffsetDistance& offset) {
  ReachedThickness reached;
  reached.nodes = tops.size();
  reached.least = reached.least_between = std::numeric_limits<double>::infinity();
  reached.most = 0;
  const SurfaceDistance outer(tops, ground.facets);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const auto place = offset.at(tops[i]);
    if (std::abs(place.reach() - 1) > thickness_tolerance) ++reached.missed;
    if (place.reach() < reached.least) {
      reached.least = place.reach();
      reached.least_at = tops[i];
      reached.least_asked = place.asked;
    }
    if (place.reach() > reached.most) {
      reached.most = place.reach();
      reached.most_at = tops[i];
    }
    if (const double between = outer.nearest(ground.nodes[i]).distance / ground.thickness[i];
        between < reached.least_between) {
      reached.least_between = between;
      reached.least_between_at = ground.nodes[i];
    }
  }
  return reached;
}

/// The sides of the columns go to the planes of symmetry that they lie in, the others to `wall_ends`.
void name_sides(TetrahedralMesh& mesh, const std::vector<RimEdge>& rim, const RimSides& sides, const Levels& levels,
                const std::vector<std::string>& names) {
  std::map<std::string, std::vector<RimEdge>> parts;
  for (const auto& edge : rim) {
    const auto beyond = sides.surface.find(std::minmax(edge.first, edge.second));
    const std::string name = beyond == sides.surface.end() ? "" : names[beyond->second];
    parts[group::is_symmetry_plane(name) ? name : group::wall_ends].push_back(edge);
  }
  for (const auto& [name, edges] : parts) {
    auto facets = sides_of_columns(mesh, edges, levels);
    if (facets.empty()) continue;
    const auto found = std::find_if(mesh.facet_groups.begin(), mesh.facet_groups.end(),
                                    [&wanted = name](const auto& group) { return group.name == wanted; });
    if (found == mesh.facet_groups.end())
      mesh.facet_groups.push_back({name, std::move(facets)});
    else
      found->facets.insert(found->facets.end(), facets.begin(), facets.end());
  }
}

[[noreturn]] void refuse_fold(const Point& at) {
  throw InputError("fsi-mesh", "--layer",
                   fmt::format("the wall folds near {}, where the surface is hollow or rough", place_of(at)),
                   "give thinner layers, a smoother surface, or smaller facets there");
}

/// \param first  of the wall's cells
void require_no_folds(const TetrahedralMesh& mesh, std::size_t first) {
  for (std::size_t c = first; c < mesh.cells.size(); ++c) {
    std::array<Point, 4> corners;
    for (int a = 0; a < 4; ++a) corners[a] = mesh.nodes[mesh.cells[c][a]];
    if (mean_ratio(corners) <= 0) refuse_fold(corners[0]);
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

std::vector<std::string> warnings_of(const ReachedThickness& reached) {
  const auto per_cent = [](double part) { return fmt::format("{:.3g} %", 100 * part); };
  std::vector<std::string> warnings;
  if (reached.missed > 0)
    warnings.push_back(fmt::format(
        "the wall's thickness is missed by more than {} at {} of {} nodes of its outer surface: {} of {:.4g} mm at {}, "
        "{} at "
        "most, at {}; give thinner layers, or smaller facets there",
        per_cent(thickness_tolerance), reached.missed, reached.nodes, per_cent(reached.least), reached.least_asked,
        place_of(reached.least_at), per_cent(reached.most), place_of(reached.most_at)));
  if (reached.least_between < between_tolerance)
    warnings.push_back(
        fmt::format("between its nodes the wall is thinner than asked for: {} at {}, where the surface bends round "
                    "sharper than its facets, as at an edge, or facets stretch beside a sharp crease; make them "
                    "smaller there",
                    per_cent(reached.least_between), place_of(reached.least_between_at)));
  return warnings;
}

GrownWall grow_wall(const TetrahedralMesh& lumen, const WallGrowth& growth) {
  require_new_names(lumen, growth.layers);
  const auto facets = facets_to_grow_on(lumen, growth.on);
  const auto sides = sides_of_rims(lumen, facets);
  const auto normals = offset_normals(lumen.nodes, facets, growth.smoothing, sides);
  std::vector<int> nodes;
  const auto ground = ground_of(lumen, growth, facets, normals, nodes);
  const OffsetDistance offset(ground.nodes, ground.facets, ground.thickness);
  const auto tops = column_tops(ground, offset);

  GrownWall grown{lumen, reached_by(ground, tops, offset)};
  // Nodes that had to go round what they have no room in, and the facets between them through it.
  if (grown.reached.least_between < no_room) refuse_fold(grown.reached.least_between_at);
  auto& mesh = grown.mesh;
  std::map<int, std::vector<Point>> columns;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    columns[nodes[i]] = column_levels(ground.nodes[i], tops[i], ground.levels, offset);
  std::vector<std::string> names;
  mesh.facet_groups.clear();
  for (const auto& group : lumen.facet_groups) {
    names.push_back(group.name);
    if (group.name != growth.on) mesh.facet_groups.push_back(group);
  }
  const Levels levels = raise_levels(regions_of(growth.layers, mesh), columns, mesh);
  fill_with_prisms(facets, levels, mesh);

  TetrahedralMesh::FacetGroup outer{group::outer, {}};
  for (auto facet : facets) {
    for (int& node : facet) node = levels.nodes.back().at(node);
    outer.facets.push_back(facet);
  }
  mesh.facet_groups.push_back(std::move(outer));
  name_sides(mesh, normals.rim, sides, levels, names);
  require_no_folds(mesh, lumen.cells.size());
  return grown;
}

}  // namespace fsi
