#include "mesher/surface/boundary_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesher/offset_distance.hpp"
#include "mesher/offset_normals.hpp"
#include "mesher/prism_columns.hpp"
#include "mesher/surface/local_radius.hpp"
#include "mesher/surface/remeshing.hpp"

namespace fsi {

namespace {

constexpr const char* remedy = "give fewer or thinner layers, or more --smoothing";

[[noreturn]] void refuse(const Point& at, const std::string& problem) {
  throw InputError("fsi-mesh", "--layers", problem + " at " + place_of(at), remedy);
}

/// Heights from the inner end of the layers to the wall, over their thickness; the thinnest layer is the last.
std::vector<NewLevel> levels_of(const BoundaryLayers& layers, int region) {
  std::vector<NewLevel> levels;
  double left = 0, thickness = layers.first;
  std::vector<double> from_wall{0};
  for (int i = 0; i < layers.count; ++i, thickness *= layers.growth) from_wall.push_back(left += thickness);
  for (int i = layers.count - 1; i >= 0; --i) levels.push_back({1 - from_wall[i] / left, region});
  return levels;
}

/// Sides of the layers at a rim go to the opening whose surface has nodes of that rim.
void add_to_openings(TetrahedralMesh& mesh, const std::vector<TetrahedralMesh::Facet>& sides, const Levels& levels) {
  const auto bottom = levels.bottoms();
  for (auto& group : mesh.facet_groups) {
    std::set<int> nodes;
    for (const auto& facet : group.facets) nodes.insert(facet.begin(), facet.end());
    for (const auto& side : sides)
      if (std::all_of(side.begin(), side.end(), [&](int node) { return nodes.count(bottom.at(node)) > 0; }))
        group.facets.push_back(side);
  }
}

}  // namespace

double BoundaryLayers::thickness() const {
  double sum = 0, layer = first;
  for (int i = 0; i < count; ++i, layer *= growth) sum += layer;
  return sum;
}

TriangleSurface moved_inwards(const TriangleSurface& wall, const BoundaryLayers& layers) {
  constexpr double most = 0.4;  // of the local radius
  constexpr int smoothing = 4;
  const double thickness = layers.thickness();
  const auto radius = local_radius(wall, 3);
  const auto narrowest = std::min_element(radius.begin(), radius.end());
  if (thickness > most * *narrowest)
    refuse(wall.nodes[narrowest - radius.begin()],
           fmt::format("are {:.3g} mm thick together, more than 0.4 of the radius {:.3g} mm", thickness, *narrowest));
  TriangleSurface inner = wall;
  const OffsetDistance offset(wall.nodes, wall.triangles, std::vector<double>(wall.nodes.size(), thickness));
  for (const auto& [node, normal] : offset_normals(wall.nodes, wall.triangles, smoothing).normals)
    inner.nodes[node] = offset.along(wall.nodes[node], -1 * normal, thickness, 1);
  for (const auto& [a, b, c] : wall.triangles) {
    const Point before = triangle_area_vector(wall.nodes[a], wall.nodes[b], wall.nodes[c]);
    const Point after = triangle_area_vector(inner.nodes[a], inner.nodes[b], inner.nodes[c]);
    if (!(dot(before, after) > 0.5 * norm(before) * norm(after))) refuse(wall.nodes[a], "fold");
  }
  require_no_cuts(inner, "--layers", remedy);
  return inner;
}

Levels grow_layers(TetrahedralMesh& lumen, const TriangleSurface& wall, const TriangleSurface& inner,
                   const BoundaryLayers& layers) {
  std::map<Point, int> number;
  for (std::size_t i = 0; i < lumen.nodes.size(); ++i) number[lumen.nodes[i]] = static_cast<int>(i);
  std::map<int, Point> ways;
  for (std::size_t i = 0; i < inner.nodes.size(); ++i) ways[number.at(inner.nodes[i])] = wall.nodes[i] - inner.nodes[i];
  std::vector<TetrahedralMesh::Facet> facets;
  for (auto triangle : inner.triangles) {
    for (int& node : triangle) node = number.at(inner.nodes[node]);
    facets.push_back(triangle);
  }
  const std::size_t first = lumen.cells.size();
  Levels levels = raise_levels(levels_of(layers, lumen.region_index(group::fluid)), ways, lumen);
  fill_with_prisms(facets, levels, lumen);
  for (std::size_t c = first; c < lumen.cells.size(); ++c) {
    std::array<Point, 4> corners;
    for (int a = 0; a < 4; ++a) corners[a] = lumen.nodes[lumen.cells[c][a]];
    if (!(mean_ratio(corners) > 0)) refuse(corners[0], "fold");
  }
  const auto rim = offset_normals(lumen.nodes, facets, 0).rim;
  add_to_openings(lumen, sides_of_columns(lumen, rim, levels), levels);
  return levels;
}

}  // namespace fsi
