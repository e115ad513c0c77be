#include "mesher/wall_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facet_division.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesh/surface_distance.hpp"
#include "mesher/column_tops.hpp"
#include "mesher/offset_distance.hpp"
#include "mesher/offset_normals.hpp"
#include "mesher/prism_columns.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;

constexpr double no_room = 0.25;  // of the thickness between nodes; over an edge half of it is left

bool is_named(const TetrahedralMesh& mesh, const std::string& name) {
  return mesh.facets(name) != nullptr;
}

/// Refuses layers and surfaces to be made whose names are taken.
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

/// What lies beyond the rims of the facets that the wall grows on: the named surfaces of the lumen, by number of the
/// group.
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

/// The surface that a wall grows on.
struct Ground {
  std::vector<Facet> facets;  ///< of the lumen
  RimSides sides;
  OffsetNormals normals;
  std::vector<int> nodes;  ///< of the lumen, ascending, by the column's number
  ColumnGround columns;

  Ground(const TetrahedralMesh& lumen, const WallGrowth& growth)
      : facets(facets_to_grow_on(lumen, growth.on)),
        sides(sides_of_rims(lumen, facets)),
        normals(offset_normals(lumen.nodes, facets, growth.smoothing, sides)) {
    std::map<int, int> number;
    double whole = 0;
    for (const auto& layer : growth.layers) whole += layer.thickness;
    for (const auto& [node, normal] : normals.normals) {
      number[node] = static_cast<int>(nodes.size());
      nodes.push_back(node);
      columns.nodes.push_back(lumen.nodes[node]);
      columns.normals.push_back(normal);
      const auto planes = normals.planes.find(node);
      columns.planes.push_back(planes == normals.planes.end() ? std::vector<Point>() : planes->second);
      columns.thickness.push_back(growth.total.empty() ? whole : whole * growth.total.at(node));
    }
    for (auto facet : facets) {
      for (int& node : facet) node = number.at(node);
      columns.facets.push_back(facet);
    }
    double height = 0;
    for (const auto& layer : growth.layers) {
      for (int e = 1; e <= layer.elements; ++e)
        columns.levels.push_back((height + layer.thickness * e / layer.elements) / whole);
      height += layer.thickness;
    }
    columns.levels.back() = 1;
  }
};

/// The regions of the layers' cells, per level; the layers are added to those of the mesh.
std::vector<int> regions_of(const std::vector<GrownLayer>& layers, TetrahedralMesh& mesh) {
  std::vector<int> regions;
  for (const auto& layer : layers) {
    regions.insert(regions.end(), static_cast<std::size_t>(layer.elements), static_cast<int>(mesh.regions.size()));
    mesh.regions.push_back(layer.name);
  }
  return regions;
}

/// A node that a column stands on or ends at.
struct Foot {
  Point at;
  double thickness;  ///< mm, asked for
};

/// \param tops   nodes of the outer surface \param outer  that surface \param feet  nodes that the wall grew on
ReachedThickness reached_by(const std::vector<Point>& tops, const SurfaceDistance& outer, const std::vector<Foot>& feet,
                            const OffsetDistance& offset) {
  ReachedThickness reached;
  reached.nodes = tops.size();
  reached.least = reached.least_between = std::numeric_limits<double>::infinity();
  reached.most = 0;
  for (const Point& top : tops) {
    const auto place = offset.at(top);
    if (std::abs(place.reach() - 1) > thickness_tolerance) ++reached.missed;
    if (place.reach() < reached.least) {
      reached.least = place.reach();
      reached.least_at = top;
      reached.least_asked = place.asked;
    }
    if (place.reach() > reached.most) {
      reached.most = place.reach();
      reached.most_at = top;
    }
  }
  for (const auto& [at, thickness] : feet)
    if (const double between = outer.nearest(at).distance / thickness; between < reached.least_between) {
      reached.least_between = between;
      reached.least_between_at = at;
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

/// Refuses a wall that has no room, so that facets of its outer face cut through it.
void require_room(const ReachedThickness& reached) {
  if (reached.least_between < no_room) refuse_fold(reached.least_between_at);
}

/// \param first  of the wall's cells
void require_no_folds(const TetrahedralMesh& mesh, std::size_t first) {
  for (std::size_t c = first; c < mesh.cells.size(); ++c) {
    std::array<Point, 4> corners;
    for (int a = 0; a < 4; ++a) corners[a] = mesh.nodes[mesh.cells[c][a]];
    if (mean_ratio(corners) <= 0) refuse_fold(corners[0]);
  }
}

/// A wall of straight cells.
struct Raised {
  TetrahedralMesh mesh;
  Levels levels;
  std::vector<Point> tops;  ///< by the column's number
};

Raised raised(const TetrahedralMesh& lumen, const WallGrowth& growth, const Ground& ground,
              const OffsetDistance& offset) {
  Raised wall{lumen, {}, column_tops(ground.columns, offset)};
  auto& mesh = wall.mesh;
  std::map<int, std::vector<Point>> columns;
  for (std::size_t i = 0; i < ground.nodes.size(); ++i)
    columns[ground.nodes[i]] = column_levels(ground.columns.nodes[i], wall.tops[i], ground.columns.levels, offset);
  std::vector<std::string> names;
  mesh.facet_groups.clear();
  for (const auto& group : lumen.facet_groups) {
    names.push_back(group.name);
    if (group.name != growth.on) mesh.facet_groups.push_back(group);
  }
  wall.levels = raise_levels(regions_of(growth.layers, mesh), columns, mesh);
  fill_with_prisms(ground.facets, wall.levels, mesh);

  TetrahedralMesh::FacetGroup outer{group::outer, {}};
  for (auto facet : ground.facets) {
    for (int& node : facet) node = wall.levels.nodes.back().at(node);
    outer.facets.push_back(facet);
  }
  mesh.facet_groups.push_back(std::move(outer));
  name_sides(mesh, ground.normals.rim, ground.sides, wall.levels, names);
  require_no_folds(mesh, lumen.cells.size());
  return wall;
}

using Edge = std::pair<int, int>;  // nodes of the lumen, the smaller number first

/// The ground with curved edges.
class CurvedGround {
 public:
  CurvedGround(const TetrahedralMesh& lumen, const Ground& ground, const EdgeCurves& curves) {
    static const FacetDivision<3> division = divided_facet<3>();
    for (std::size_t i = 0; i < ground.nodes.size(); ++i)
      feet_.push_back({ground.columns.nodes[i], ground.columns.thickness[i]});
    for (std::size_t f = 0; f < ground.facets.size(); ++f) {
      std::vector<Point> nodes;
      std::array<double, 3> thickness{};
      for (int k = 0; k < 3; ++k) {
        nodes.push_back(lumen.nodes[ground.facets[f][k]]);
        thickness[k] = ground.columns.thickness[ground.columns.facets[f][k]];
      }
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const Edge edge = std::minmax(ground.facets[f][k], ground.facets[f][next]);
        const auto curve = curves.find(edge);
        nodes.push_back(curve == curves.end() ? 0.5 * (nodes[k] + nodes[next]) : curve->second);
        if (middles_.try_emplace(edge, nodes.back()).second)
          feet_.push_back({nodes.back(), 0.5 * (thickness[k] + thickness[next])});
      }
      const auto first = static_cast<int>(points_.size());
      for (const auto& l : division.points) {
        points_.push_back(point_of_facet<3>(nodes, {0, 1, 2, 3, 4, 5}, l));
        thickness_.push_back(l[0] * thickness[0] + l[1] * thickness[1] + l[2] * thickness[2]);
      }
      for (const auto& [a, b, c] : division.parts) parts_.push_back({first + a, first + b, first + c});
    }
  }

  OffsetDistance offset() const { return {points_, parts_, thickness_}; }
  const std::map<Edge, Point>& middles() const { return middles_; }  ///< of all edges
  const std::vector<Foot>& feet() const { return feet_; }

 private:
  std::vector<Point> points_;
  std::vector<std::array<int, 3>> parts_;
  std::vector<double> thickness_;
  std::map<Edge, Point> middles_;
  std::vector<Foot> feet_;
};

/// Adds the curves of the wall's edges.
/// \param straight  edges of the lumen over which the wall's are straight
void curve_wall(const Raised& wall, const Ground& ground, const CurvedGround& curved, const OffsetDistance& offset,
                const std::set<Edge>& straight, EdgeCurves& curves) {
  std::set<Edge> rim;
  for (const auto& [a, b] : ground.normals.rim) rim.insert(std::minmax(a, b));
  const auto& levels = wall.levels.nodes;
  const auto node = [&](std::size_t level, int bottom) { return levels[level].at(bottom); };
  const auto at = [&](std::size_t level, int bottom) { return wall.mesh.nodes[node(level, bottom)]; };
  for (const auto& [edge, bottom] : curved.middles()) {
    const auto& [a, b] = edge;
    const bool bent = curves.count(edge) > 0;
    std::vector<Point> column{bottom};
    if (straight.count(edge) > 0) {
      if (!bent) continue;
      for (std::size_t level = 1; level < levels.size(); ++level) column.push_back(0.5 * (at(level, a) + at(level, b)));
    } else {
      const std::size_t last = levels.size() - 1;
      const Point way = 0.5 * ((at(last, a) - at(0, a)) + (at(last, b) - at(0, b)));
      const auto plane = rim.count(edge) > 0 ? plane_of_rim_edge(ground.normals.planes, edge) : std::vector<Point>();
      const Point top = offset.onto(bottom + way, 1, plane);
      for (const Point& x : column_levels(bottom, top, ground.columns.levels, offset)) column.push_back(x);
    }
    for (std::size_t level = 1; level < levels.size(); ++level) {
      curves[std::minmax(node(level, a), node(level, b))] = column[level];
      // One of the two is an edge of the side that the columns on a and b have together.
      for (const auto& [low, high] : {edge, Edge(b, a)})
        curves[std::minmax(node(level - 1, low), node(level, high))] = 0.5 * (column[level - 1] + column[level]);
    }
  }
}

/// Edges of the lumen that cells stand on, or have themselves.
std::set<Edge> edges_below(const std::vector<int>& cells, const Raised& wall, const CurvedGround& curved) {
  const auto bottom = wall.levels.bottoms();
  std::set<Edge> edges;
  for (const int cell : cells)
    for (const int one : wall.mesh.cells[cell])
      for (const int other : wall.mesh.cells[cell]) {
        const auto a = bottom.find(one), b = bottom.find(other);
        if (a == bottom.end() || b == bottom.end()) continue;
        if (const Edge edge = std::minmax(a->second, b->second); curved.middles().count(edge) > 0) edges.insert(edge);
      }
  return edges;
}

ReachedThickness reached_by(const SimplexMesh<3, 2>& mesh, const CurvedGround& curved, const OffsetDistance& offset) {
  static const FacetDivision<3> division = divided_facet<3>();
  const auto& outer = *mesh.facets(group::outer);
  std::vector<Point> tops, points;
  std::vector<std::array<int, 3>> parts;
  for (const int node : facet_nodes(outer)) tops.push_back(mesh.nodes[node]);
  for (const auto& facet : outer) {
    const auto first = static_cast<int>(points.size());
    for (const auto& l : division.points) points.push_back(point_of_facet<3>(mesh.nodes, facet, l));
    for (const auto& [a, b, c] : division.parts) parts.push_back({first + a, first + b, first + c});
  }
  return reached_by(tops, SurfaceDistance(std::move(points), std::move(parts)), curved.feet(), offset);
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

OffsetNormals normals_to_grow_along(const TetrahedralMesh& lumen, const std::vector<Facet>& facets, int smoothing) {
  return offset_normals(lumen.nodes, facets, smoothing, sides_of_rims(lumen, facets));
}

GrownWall grow_wall(const TetrahedralMesh& lumen, const WallGrowth& growth) {
  require_new_names(lumen, growth.layers);
  const Ground ground(lumen, growth);
  const OffsetDistance offset(ground.columns.nodes, ground.columns.facets, ground.columns.thickness);
  auto grown = raised(lumen, growth, ground, offset);
  std::vector<Foot> feet;
  for (std::size_t i = 0; i < ground.nodes.size(); ++i)
    feet.push_back({ground.columns.nodes[i], ground.columns.thickness[i]});
  const auto reached = reached_by(grown.tops, SurfaceDistance(grown.tops, ground.columns.facets), feet, offset);
  require_room(reached);
  return {std::move(grown.mesh), reached};
}

QuadraticWall grow_quadratic_wall(const TetrahedralMesh& lumen, EdgeCurves curves, bool bendable,
                                  const WallGrowth& growth) {
  require_new_names(lumen, growth.layers);
  const Ground ground(lumen, growth);
  QuadraticWall wall;
  std::set<Edge> straight;
  while (true) {
    const CurvedGround curved(lumen, ground, curves);
    const auto offset = curved.offset();
    const auto grown = raised(lumen, growth, ground, offset);
    auto all = curves;
    curve_wall(grown, ground, curved, offset, straight, all);
    wall.mesh = with_curves(grown.mesh, all);
    const auto folded = folded_cells(wall.mesh);
    if (folded.empty()) {
      wall.reached = reached_by(wall.mesh, curved, offset);
      break;
    }
    bool changed = false;
    for (const auto& edge : edges_below(folded, grown, curved)) {
      if (!straight.insert(edge).second) continue;
      wall.straightened.push_back(curved.middles().at(edge));
      if (bendable) curves.erase(edge);
      changed = true;
    }
    if (!changed) refuse_fold(wall.mesh.nodes[wall.mesh.cells[folded.front()][0]]);
  }
  require_room(wall.reached);
  return wall;
}

}  // namespace fsi
