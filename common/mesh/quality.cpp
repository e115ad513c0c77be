#include "mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include "mesh/boundary.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double degrees = 57.295779513082320877;

/// Splits a surface into parts connected by edges; per facet the number of its part, counted from 0. Returns the count.
int connected_parts(const std::vector<TetrahedralMesh::Facet>& surface, std::vector<int>& part) {
  std::vector<std::array<int, 3>> edges;  // two nodes, facet
  for (std::size_t f = 0; f < surface.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax({surface[f][i], surface[f][(i + 1) % 3]});
      edges.push_back({a, b, static_cast<int>(f)});
    }
  std::sort(edges.begin(), edges.end());
  DisjointSets sets(surface.size());
  for (std::size_t e = 1; e < edges.size(); ++e)
    if (edges[e][0] == edges[e - 1][0] && edges[e][1] == edges[e - 1][1]) sets.join(edges[e][2], edges[e - 1][2]);

  std::unordered_map<int, int> number;
  part.resize(surface.size());
  for (std::size_t f = 0; f < surface.size(); ++f)
    part[f] = number.emplace(sets.root(static_cast<int>(f)), static_cast<int>(number.size())).first->second;
  return static_cast<int>(number.size());
}

std::array<Point, 4> corners_of(const TetrahedralMesh& mesh, const TetrahedralMesh::Cell& cell) {
  return {mesh.nodes[cell[0]], mesh.nodes[cell[1]], mesh.nodes[cell[2]], mesh.nodes[cell[3]]};
}

}  // namespace

double mean_ratio(const std::array<Point, 4>& x) {
  double squares = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) squares += dot(x[j] - x[i], x[j] - x[i]);
  const double cube_root = std::cbrt(3 * tetrahedron_volume(x[0], x[1], x[2], x[3]));
  return std::copysign(12 * cube_root * cube_root / squares, cube_root);
}

double smallest_dihedral(const std::array<Point, 4>& x) {
  std::array<Point, 4> normal;
  const auto facets = outward_facets({0, 1, 2, 3});
  for (int i = 0; i < 4; ++i) {
    const Point area = triangle_area_vector(x[facets[i][0]], x[facets[i][1]], x[facets[i][2]]);
    normal[i] = (1 / norm(area)) * area;
  }
  double smallest = 180;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      const double cosine = std::clamp(-dot(normal[i], normal[j]), -1.0, 1.0);
      smallest = std::min(smallest, std::acos(cosine) * degrees);
    }
  return smallest;
}

int element_layers(const TetrahedralMesh& mesh, int region) {
  std::set<std::array<int, 3>> ends;
  if (const auto* clamped = mesh.facets(group::wall_ends))
    for (const auto& facet : *clamped) ends.insert(facet_key(facet));
  std::vector<TetrahedralMesh::Facet> faces;
  for (const auto& facet : boundary_facets(mesh, {region}))
    if (!ends.count(facet_key(facet.nodes))) faces.push_back(facet.nodes);
  std::vector<int> part;
  if (connected_parts(faces, part) != 2) return 0;

  std::vector<std::vector<int>> neighbours(mesh.nodes.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] == region)
      for (const int a : mesh.cells[c])
        for (const int b : mesh.cells[c])
          if (a != b) neighbours[a].push_back(b);

  std::vector<char> target(mesh.nodes.size(), 0);
  std::vector<int> distance(mesh.nodes.size(), -1);
  std::vector<int> queue;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const int node : faces[f]) {
      if (part[f] == 1) target[node] = 1;
      if (part[f] == 0 && distance[node] < 0) {
        distance[node] = 0;
        queue.push_back(node);
      }
    }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int node = queue[head];
    if (target[node]) return distance[node];
    for (const int next : neighbours[node])
      if (distance[next] < 0) {
        distance[next] = distance[node] + 1;
        queue.push_back(next);
      }
  }
  return 0;
}

MeshQuality measure_quality(const TetrahedralMesh& mesh) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  MeshQuality quality;
  quality.nodes = mesh.nodes.size();
  quality.tetrahedra = mesh.cells.size();
  quality.min_eta = quality.min_dihedral = std::numeric_limits<double>::infinity();
  for (const auto& name : mesh.regions) {
    MeshQuality::Region region;
    region.name = name;
    region.min_eta = region.min_dihedral = std::numeric_limits<double>::infinity();
    quality.regions.push_back(region);
  }

  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto corners = corners_of(mesh, mesh.cells[c]);
    const double eta = mean_ratio(corners);
    assert(mesh.cell_region[c] >= 0 && static_cast<std::size_t>(mesh.cell_region[c]) < quality.regions.size());
    auto& region = quality.regions[mesh.cell_region[c]];
    ++region.tetrahedra;
    region.volume += tetrahedron_volume(corners[0], corners[1], corners[2], corners[3]);
    region.mean_eta += eta;
    if (eta < region.min_eta) {
      region.min_eta = eta;
      region.worst = static_cast<int>(c);
      region.worst_at = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    }
    const double dihedral = smallest_dihedral(corners);
    region.min_dihedral = std::min(region.min_dihedral, dihedral);
    if (eta < poor_eta || dihedral < poor_dihedral) ++region.poor;
  }

  for (std::size_t r = 0; r < quality.regions.size(); ++r) {
    auto& region = quality.regions[r];
    quality.mean_eta += region.mean_eta / static_cast<double>(std::max<std::size_t>(1, quality.tetrahedra));
    quality.min_eta = std::min(quality.min_eta, region.min_eta);
    quality.min_dihedral = std::min(quality.min_dihedral, region.min_dihedral);
    region.mean_eta /= static_cast<double>(std::max<std::size_t>(1, region.tetrahedra));
    region.layers = element_layers(mesh, static_cast<int>(r));
  }
  return quality;
}

std::vector<std::string> warnings_of(const MeshQuality& quality) {
  std::vector<std::string> warnings;
  for (const auto& region : quality.regions) {
    if (region.poor == 0) continue;
    warnings.push_back(fmt::format(
        "{}: {} of {} elements are of bad quality (eta below {:g} or a dihedral angle below {:g} deg); the worst is "
        "tetrahedron {} near ({:.2f}, {:.2f}, {:.2f}) mm, eta {:.3f}; smallest angle {:.1f} deg; choose sizes across "
        "and along that are closer to each other and to the thickness of the layers",
        region.name, region.poor, region.tetrahedra, poor_eta, poor_dihedral, region.worst + 1, region.worst_at[0],
        region.worst_at[1], region.worst_at[2], region.min_eta, region.min_dihedral));
  }
  return warnings;
}

std::string to_text(const MeshQuality& quality) {
  std::string text = fmt::format("{} nodes, {} tetrahedra\n", quality.nodes, quality.tetrahedra);
  const auto line = [&](const std::string& name, const std::string& tetrahedra, const std::string& volume,
                        const std::string& least, const std::string& mean, const std::string& angle,
                        const std::string& layers) {
    text += fmt::format("{:<14}{:>12}{:>14}{:>14}{:>14}{:>22}{:>10}\n", name, tetrahedra, volume, least, mean, angle,
                        layers);
  };
  line("region", "tetrahedra", "volume [mm^3]", "smallest eta", "mean eta", "smallest dihedral", "layers");
  double volume = 0;
  for (const auto& region : quality.regions) {
    volume += region.volume;
    line(region.name, std::to_string(region.tetrahedra), fmt::format("{:.4f}", region.volume),
         fmt::format("{:.3f}", region.min_eta), fmt::format("{:.3f}", region.mean_eta),
         fmt::format("{:.1f} deg", region.min_dihedral), region.layers > 0 ? std::to_string(region.layers) : "-");
  }
  line("all", std::to_string(quality.tetrahedra), fmt::format("{:.4f}", volume), fmt::format("{:.3f}", quality.min_eta),
       fmt::format("{:.3f}", quality.mean_eta), fmt::format("{:.1f} deg", quality.min_dihedral), "");
  return text;
}

}  // namespace fsi
