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
#include "mesh/cell_words.hpp"
#include "mesh/curved_cells.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double degrees = 57.295779513082320877;

/// Splits a surface into parts connected by the sides of its facets (edges; of edges, their ends); per facet the number
/// of its part, counted from 0. Returns the count.
template <int Dim, std::size_t Nodes>
int connected_parts(const std::vector<std::array<int, Nodes>>& surface, std::vector<int>& part) {
  std::vector<std::array<int, 3>> sides;  // two vertices, or one twice, facet
  for (std::size_t f = 0; f < surface.size(); ++f)
    for (int i = 0; i < Dim; ++i) {
      const auto [a, b] = std::minmax({surface[f][i], Dim == 3 ? surface[f][(i + 1) % Dim] : surface[f][i]});
      sides.push_back({a, b, static_cast<int>(f)});
    }
  std::sort(sides.begin(), sides.end());
  DisjointSets sets(surface.size());
  for (std::size_t e = 1; e < sides.size(); ++e)
    if (sides[e][0] == sides[e - 1][0] && sides[e][1] == sides[e - 1][1]) sets.join(sides[e][2], sides[e - 1][2]);

  std::unordered_map<int, int> number;
  part.resize(surface.size());
  for (std::size_t f = 0; f < surface.size(); ++f)
    part[f] = number.emplace(sets.root(static_cast<int>(f)), static_cast<int>(number.size())).first->second;
  return static_cast<int>(number.size());
}

template <int Dim, int Order>
std::array<Point, Dim + 1> corners_of(const SimplexMesh<Dim, Order>& mesh, std::size_t c) {
  std::array<Point, Dim + 1> corners;
  for (int i = 0; i <= Dim; ++i) corners[i] = mesh.nodes[mesh.cells[c][i]];
  return corners;
}

Point centre(const std::array<Point, 4>& x) {
  return 0.25 * (x[0] + x[1] + x[2] + x[3]);
}
Point centre(const std::array<Point, 3>& x) {
  return (1.0 / 3) * (x[0] + x[1] + x[2]);
}

double least_angle(const std::array<Point, 4>& x) {
  return smallest_dihedral(x);
}
double least_angle(const std::array<Point, 3>& x) {
  return smallest_angle(x);
}

}  // namespace

double mean_ratio(const std::array<Point, 3>& x) {
  double squares = 0;
  for (int i = 0; i < 3; ++i) squares += dot(x[(i + 1) % 3] - x[i], x[(i + 1) % 3] - x[i]);
  return 4 * std::sqrt(3.0) * triangle_area(x[0], x[1], x[2]) / squares;
}

double smallest_angle(const std::array<Point, 3>& x) {
  double smallest = 180;
  for (int i = 0; i < 3; ++i) {
    const Point u = x[(i + 1) % 3] - x[i], v = x[(i + 2) % 3] - x[i];
    smallest = std::min(smallest, std::atan2(norm(cross(u, v)), dot(u, v)) * degrees);
  }
  return smallest;
}

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

template <int Dim, int Order>
int element_layers(const SimplexMesh<Dim, Order>& mesh, int region) {
  std::set<FacetKey<Dim>> ends;
  for (const auto& group : mesh.facet_groups)
    if (group.name == group::wall_ends || group::is_symmetry_plane(group.name))
      for (const auto& facet : group.facets) ends.insert(facet_key<Dim>(facet));
  std::vector<typename SimplexMesh<Dim, Order>::Facet> faces;
  for (const auto& facet : boundary_facets(mesh, {region}))
    if (!ends.count(facet_key<Dim>(facet.nodes))) faces.push_back(facet.nodes);
  std::vector<int> part;
  if (connected_parts<Dim>(faces, part) != 2) return 0;

  std::vector<std::vector<int>> neighbours(mesh.nodes.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] == region)
      for (int i = 0; i <= Dim; ++i)
        for (int j = 0; j <= Dim; ++j)
          if (i != j) neighbours[mesh.cells[c][i]].push_back(mesh.cells[c][j]);

  std::vector<char> target(mesh.nodes.size(), 0);
  std::vector<int> distance(mesh.nodes.size(), -1);
  std::vector<int> queue;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const int node : facet_key<Dim>(faces[f])) {
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

template <int Dim, int Order>
MeshQuality measure_quality(const SimplexMesh<Dim, Order>& mesh) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  MeshQuality quality;
  quality.dimension = Dim;
  quality.order = Order;
  quality.nodes = mesh.nodes.size();
  quality.cells = mesh.cells.size();
  quality.min_eta = quality.min_angle = std::numeric_limits<double>::infinity();
  for (const auto& name : mesh.regions) {
    MeshQuality::Region region;
    region.name = name;
    region.min_eta = region.min_angle = std::numeric_limits<double>::infinity();
    quality.regions.push_back(region);
  }

  std::vector<double> worst(mesh.regions.size(), std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto corners = corners_of(mesh, c);
    const double eta = mean_ratio(corners);
    assert(mesh.cell_region[c] >= 0 && static_cast<std::size_t>(mesh.cell_region[c]) < quality.regions.size());
    auto& region = quality.regions[mesh.cell_region[c]];
    ++region.cells;
    double curving = 1;
    if constexpr (Order == 2) {
      std::array<Point, nodes_of_simplex(Dim, 2)> x;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = mesh.nodes[mesh.cells[c][i]];
      const auto jacobian = cell_jacobian<Dim>(x);
      region.volume += jacobian.mean / (Dim == 3 ? 6 : 2);
      curving = jacobian.ratio();
      region.min_jacobian = std::min(region.min_jacobian, curving);
    } else {
      region.volume += simplex_volume<Dim>(corners.data());
    }
    region.mean_eta += eta;
    region.min_eta = std::min(region.min_eta, eta);
    if (std::min(eta, curving) < worst[mesh.cell_region[c]]) {
      worst[mesh.cell_region[c]] = std::min(eta, curving);
      region.worst = static_cast<int>(c);
      region.worst_at = centre(corners);
      region.worst_eta = eta;
    }
    const double angle = least_angle(corners);
    region.min_angle = std::min(region.min_angle, angle);
    if (eta < poor_eta || angle < poor_angle || curving < poor_jacobian) ++region.poor;
  }

  for (std::size_t r = 0; r < quality.regions.size(); ++r) {
    auto& region = quality.regions[r];
    quality.mean_eta += region.mean_eta / static_cast<double>(std::max<std::size_t>(1, quality.cells));
    quality.min_eta = std::min(quality.min_eta, region.min_eta);
    quality.min_angle = std::min(quality.min_angle, region.min_angle);
    quality.min_jacobian = std::min(quality.min_jacobian, region.min_jacobian);
    region.mean_eta /= static_cast<double>(std::max<std::size_t>(1, region.cells));
    region.layers = element_layers(mesh, static_cast<int>(r));
  }
  return quality;
}

std::vector<std::string> warnings_of(const MeshQuality& quality) {
  const bool solid = quality.dimension == 3;
  std::vector<std::string> warnings;
  for (const auto& region : quality.regions) {
    if (region.poor == 0) continue;
    const auto curving = quality.order == 1 ? "" : fmt::format(", least det J {:.3f} of its mean", region.min_jacobian);
    warnings.push_back(fmt::format(
        "{}: {} of {} elements are of bad quality (eta below {:g} or {} below {:g} deg{}); the worst is {} {} near "
        "({:.2f}, {:.2f}, {:.2f}) mm, eta {:.3f}; smallest angle {:.1f} deg{}; choose sizes across and along that are "
        "closer to each other and to the thickness of the layers",
        region.name, region.poor, region.cells, poor_eta, solid ? "a dihedral angle" : "an angle", poor_angle,
        quality.order == 1 ? "" : fmt::format(", or det J below {:g} of its mean", poor_jacobian),
        solid ? CellWords<3>::cell : CellWords<2>::cell, region.worst + 1, region.worst_at[0], region.worst_at[1],
        region.worst_at[2], region.worst_eta, region.min_angle, curving));
  }
  return warnings;
}

std::string to_text(const MeshQuality& quality) {
  const bool solid = quality.dimension == 3;
  const std::string cells = solid ? CellWords<3>::cells : CellWords<2>::cells;
  std::string text =
      fmt::format("{} nodes, {} {}{}\n", quality.nodes, quality.cells, quality.order == 2 ? "quadratic " : "", cells);
  const auto line = [&](const std::string& name, const std::string& count, const std::string& measure,
                        const std::string& least, const std::string& mean, const std::string& angle,
                        const std::string& jacobian, const std::string& layers) {
    text += fmt::format("{:<14}{:>12}{:>14}{:>14}{:>14}{:>22}", name, count, measure, least, mean, angle);
    if (quality.order == 2) text += fmt::format("{:>18}", jacobian);
    text += fmt::format("{:>10}\n", layers);
  };
  line("region", cells, solid ? "volume [mm^3]" : "area [mm^2]", "smallest eta", "mean eta",
       solid ? "smallest dihedral" : "smallest angle", "det J/mean, min", "layers");
  double measure = 0;
  for (const auto& region : quality.regions) {
    measure += region.volume;
    line(region.name, std::to_string(region.cells), fmt::format("{:.4f}", region.volume),
         fmt::format("{:.3f}", region.min_eta), fmt::format("{:.3f}", region.mean_eta),
         fmt::format("{:.1f} deg", region.min_angle), fmt::format("{:.3f}", region.min_jacobian),
         region.layers > 0 ? std::to_string(region.layers) : "-");
  }
  line("all", std::to_string(quality.cells), fmt::format("{:.4f}", measure), fmt::format("{:.3f}", quality.min_eta),
       fmt::format("{:.3f}", quality.mean_eta), fmt::format("{:.1f} deg", quality.min_angle),
       fmt::format("{:.3f}", quality.min_jacobian), "");
  return text;
}

#define INSTANTIATE(Dim, Order)                                     \
  template int element_layers(const SimplexMesh<Dim, Order>&, int); \
  template MeshQuality measure_quality(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
