#include "mesh/wall_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"

namespace fsi {

namespace {

using Facet = TetrahedralMesh::Facet;
using Edge = std::pair<int, int>;

bool is_named(const TetrahedralMesh& mesh, const std::string& name) {
  return mesh.facets(name) != nullptr;
}

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

/// Unit vertex normals by Max's weights, sin(angle) / (|e1| |e2|): the cross product over the squared edges.
std::map<int, Point> vertex_normals(const TetrahedralMesh& mesh, const std::vector<Facet>& facets) {
  std::map<int, Point> normals;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      const Point& at = mesh.nodes[facet[k]];
      const Point u = mesh.nodes[facet[(k + 1) % 3]] - at, v = mesh.nodes[facet[(k + 2) % 3]] - at;
      auto& normal = normals.try_emplace(facet[k], Point{0, 0, 0}).first->second;
      normal = normal + (1 / (dot(u, u) * dot(v, v))) * cross(u, v);
    }
  return normals;
}

/// Edges that one facet has, with the direction that it runs through them.
std::vector<Edge> rim_of(const TetrahedralMesh& mesh, const std::vector<Facet>& facets) {
  std::map<Edge, int> uses;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(facet[k], facet[(k + 1) % 3])];
  std::vector<Edge> rim;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      const int a = facet[k], b = facet[(k + 1) % 3];
      const int count = uses[std::minmax(a, b)];
      if (count == 1) rim.emplace_back(a, b);
      if (count > 2)
        throw InputError(
            "fsi-mesh",
            fmt::format("edge at ({:.4g}, {:.4g}, {:.4g}) mm", mesh.nodes[a][0], mesh.nodes[a][1], mesh.nodes[a][2]),
            fmt::format("{} facets of the surface meet there", count), "mend the surface");
    }
  return rim;
}

/// Unit normals of the planes that the rims lie in, per node of a rim.
std::map<int, Point> rim_planes(const TetrahedralMesh& mesh, const std::vector<Edge>& rim) {
  // Distance from the plane over the rim's size, or over the mean of its edges where that allows more: the nodes of
  // segmented surfaces are off by a tenth of an edge.
  constexpr double flat = 0.02, uneven = 0.25;
  std::map<int, std::vector<int>> neighbours;
  for (const auto& [a, b] : rim) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  std::map<int, Point> planes;
  std::set<int> seen;
  for (const auto& [start, unused] : neighbours) {
    if (seen.count(start) > 0) continue;
    std::vector<int> loop{start};
    seen.insert(start);
    for (std::size_t i = 0; i < loop.size(); ++i)
      for (const int next : neighbours[loop[i]])
        if (seen.insert(next).second) loop.push_back(next);
    Point centre{0, 0, 0}, normal{0, 0, 0};
    for (const int node : loop) centre = centre + (1.0 / static_cast<double>(loop.size())) * mesh.nodes[node];
    const std::set<int> in_loop(loop.begin(), loop.end());
    double edge = 0;
    for (const auto& [a, b] : rim) {
      if (in_loop.count(a) == 0) continue;
      normal = normal + cross(mesh.nodes[a] - centre, mesh.nodes[b] - centre);
      edge += distance(mesh.nodes[a], mesh.nodes[b]) / static_cast<double>(loop.size());
    }
    const double length = norm(normal);
    double size = 0, off = 0;
    for (const int node : loop) {
      size = std::max(size, distance(mesh.nodes[node], centre));
      off = std::max(off, length > 0 ? std::abs(dot(mesh.nodes[node] - centre, normal)) / length : 1e300);
    }
    if (!(off <= std::max(flat * size, uneven * edge)))
      throw InputError("fsi-mesh", fmt::format("rim at ({:.4g}, {:.4g}, {:.4g}) mm", centre[0], centre[1], centre[2]),
                       fmt::format("is {:.2g} mm off a plane, so that the wall's end there would not be flat", off),
                       "cut the lumen's openings flat");
    for (const int node : loop) planes[node] = (1 / length) * normal;
  }
  return planes;
}

Point unit(const Point& v) {
  return (1 / norm(v)) * v;
}

/// Normals averaged with their neighbours', and laid into the plane of the opening on rims.
void smooth(std::map<int, Point>& normals, const std::vector<Facet>& facets, const std::map<int, Point>& planes,
            int times) {
  std::map<int, std::set<int>> neighbours;
  for (const auto& facet : facets)
    for (int k = 0; k < 3; ++k) {
      neighbours[facet[k]].insert(facet[(k + 1) % 3]);
      neighbours[facet[k]].insert(facet[(k + 2) % 3]);
    }
  const auto lay_into_planes = [&] {
    for (auto& [node, normal] : normals) {
      const auto plane = planes.find(node);
      if (plane != planes.end()) normal = normal - dot(normal, plane->second) * plane->second;
      normal = unit(normal);
    }
  };
  lay_into_planes();
  for (int i = 0; i < times; ++i) {
    auto old = normals;
    for (auto& [node, normal] : normals) {
      Point sum{0, 0, 0};
      for (const int next : neighbours[node]) sum = sum + old[next];
      normal = old[node] + (1.0 / static_cast<double>(neighbours[node].size())) * sum;
    }
    lay_into_planes();
  }
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

/// Tetrahedra of a prism (a0, b0, c0) below (a1, b1, c1), cut along the diagonals from the nodes of least number of each
/// quadrilateral: by the order of the numbers at the bottom.
void add_prism(std::array<int, 3> below, std::array<int, 3> above, std::vector<TetrahedralMesh::Cell>& cells) {
  // Turned so that the least comes first; the orientation stays.
  const auto least = std::min_element(below.begin(), below.end()) - below.begin();
  std::rotate(below.begin(), below.begin() + least, below.end());
  std::rotate(above.begin(), above.begin() + least, above.end());
  const auto [a, b, c] = below;
  const auto [d, e, f] = above;
  if (b < c) {
    cells.push_back({a, b, c, f});
    cells.push_back({a, b, f, e});
  } else {
    cells.push_back({a, b, c, e});
    cells.push_back({a, e, c, f});
  }
  cells.push_back({a, e, f, d});
}

/// The wall's nodes in levels above those of the lumen.
struct Levels {
  std::vector<std::map<int, int>> nodes;  ///< of each level, by the lumen's node below
  std::vector<int> region;                ///< of the cells between a level and the next
};

/// Adds the nodes level by level, so that a level's numbers are in the order of the level below.
Levels raise_levels(const std::vector<GrownLayer>& layers, const std::map<int, Point>& normals, TetrahedralMesh& mesh) {
  Levels levels;
  levels.nodes.emplace_back();
  for (const auto& [node, normal] : normals) levels.nodes[0][node] = node;
  double height = 0;
  for (const auto& layer : layers) {
    mesh.regions.push_back(layer.name);
    for (int e = 1; e <= layer.elements; ++e) {
      const double at = height + layer.thickness * e / layer.elements;
      levels.nodes.emplace_back();
      for (const auto& [node, normal] : normals) {
        levels.nodes.back()[node] = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(mesh.nodes[node] + at * normal);
      }
      levels.region.push_back(static_cast<int>(mesh.regions.size()) - 1);
    }
    height += layer.thickness;
  }
  return levels;
}

void fill_with_prisms(const std::vector<Facet>& facets, const Levels& levels, TetrahedralMesh& mesh) {
  for (std::size_t step = 0; step < levels.region.size(); ++step)
    for (const auto& facet : facets) {
      std::array<int, 3> below{}, above{};
      for (int k = 0; k < 3; ++k) {
        below[k] = levels.nodes[step].at(facet[k]);
        above[k] = levels.nodes[step + 1].at(facet[k]);
      }
      add_prism(below, above, mesh.cells);
      mesh.cell_region.insert(mesh.cell_region.end(), 3, levels.region[step]);
    }
}

/// Sides of prisms at the rims: the boundary's facets between two levels, found from the cells.
std::vector<Facet> ends_of_wall(const TetrahedralMesh& mesh, const std::vector<Edge>& rim, const Levels& levels) {
  std::set<int> rim_columns;
  for (const auto& [a, b] : rim) rim_columns.insert({a, b});
  std::map<int, int> column;
  for (const auto& nodes : levels.nodes)
    for (const auto& [bottom, node] : nodes)
      if (rim_columns.count(bottom) > 0) column[node] = bottom;
  std::vector<int> wall_regions = levels.region;
  wall_regions.erase(std::unique(wall_regions.begin(), wall_regions.end()), wall_regions.end());
  std::set<Edge> rim_edges;
  for (const auto& [a, b] : rim) rim_edges.insert(std::minmax(a, b));
  std::vector<Facet> ends;
  for (const auto& facet : boundary_facets(mesh, wall_regions)) {
    std::set<int> bottoms;
    bool on_rim = true;
    for (const int node : facet.nodes) {
      const auto found = column.find(node);
      on_rim = on_rim && found != column.end();
      if (on_rim) bottoms.insert(found->second);
    }
    if (on_rim && bottoms.size() == 2 && rim_edges.count({*bottoms.begin(), *bottoms.rbegin()}) > 0)
      ends.push_back(facet.nodes);
  }
  return ends;
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

TetrahedralMesh grow_wall(const TetrahedralMesh& lumen, const WallGrowth& growth) {
  require_new_names(lumen, growth.layers);
  const auto facets = facets_to_grow_on(lumen, growth.on);
  const auto rim = rim_of(lumen, facets);
  const auto planes = rim_planes(lumen, rim);
  auto normals = vertex_normals(lumen, facets);
  smooth(normals, facets, planes, growth.smoothing);

  TetrahedralMesh mesh = lumen;
  mesh.facet_groups.clear();
  for (const auto& group : lumen.facet_groups)
    if (group.name != growth.on) mesh.facet_groups.push_back(group);
  const Levels levels = raise_levels(growth.layers, normals, mesh);
  fill_with_prisms(facets, levels, mesh);

  TetrahedralMesh::FacetGroup outer{group::outer, {}};
  for (auto facet : facets) {
    for (int& node : facet) node = levels.nodes.back().at(node);
    outer.facets.push_back(facet);
  }
  mesh.facet_groups.push_back(std::move(outer));
  if (auto ends = ends_of_wall(mesh, rim, levels); !ends.empty())
    mesh.facet_groups.push_back({group::wall_ends, std::move(ends)});
  require_no_folds(mesh, lumen.cells.size());
  return mesh;
}

}  // namespace fsi
