#include "mesh/wall_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "mesh/boundary.hpp"
#include "mesh/facet_division.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "parallel/even_stretch.hpp"

namespace fsi {

namespace {

template <int Dim, int Order>
using Facets = std::vector<typename SimplexMesh<Dim, Order>::Facet>;
template <int Dim>
using Keys = std::set<FacetKey<Dim>>;

template <int Dim, class List>
Keys<Dim> keys_of(const List& facets) {
  Keys<Dim> keys;
  for (const auto& facet : facets) keys.insert(facet_key<Dim>(facet));
  return keys;
}

/// The facets of a boundary that are among those, or are not.
template <int Dim, int Order>
Facets<Dim, Order> chosen(const std::vector<BoundaryFacet<Dim, Order>>& boundary, const Keys<Dim>& keys, bool among) {
  Facets<Dim, Order> facets;
  for (const auto& facet : boundary)
    if ((keys.count(facet_key<Dim>(facet.nodes)) > 0) == among) facets.push_back(facet.nodes);
  return facets;
}

/// Adds a facet's flat parts, with the points that are new.
template <int Dim, int Order>
void add_flat_parts(const SimplexMesh<Dim, Order>& mesh, const typename SimplexMesh<Dim, Order>::Facet& facet,
                    std::vector<Point>& points, std::vector<SurfaceDistance::Facet>& parts) {
  if constexpr (Order == 1) {
    parts.push_back({facet[0], facet[1], facet[Dim - 1]});  // an edge's last node twice
  } else {
    static const FacetDivision<Dim> division = divided_facet<Dim>();
    const auto first = static_cast<int>(points.size());
    for (const auto& l : division.points) points.push_back(point_of_facet<Dim>(mesh.nodes, facet, l));
    for (const auto& [a, b, c] : division.parts) parts.push_back({first + a, first + b, first + c});
  }
}

template <int Dim, int Order>
WallFace face_of(const SimplexMesh<Dim, Order>& mesh, const Facets<Dim, Order>& facets) {
  std::vector<Point> points;
  if (Order == 1) points = mesh.nodes;
  std::vector<SurfaceDistance::Facet> parts;
  std::set<int> nodes;
  for (const auto& facet : facets) {
    add_flat_parts<Dim, Order>(mesh, facet, points, parts);
    nodes.insert(facet.begin(), facet.end());
  }
  return {SurfaceDistance(std::move(points), std::move(parts)), {nodes.begin(), nodes.end()}};
}

template <int Dim, int Order>
struct FacetsOfWall {
  Facets<Dim, Order> inner, outer;
  std::vector<int> regions;  ///< of the wall
};

template <int Dim, int Order>
FacetsOfWall<Dim, Order> facets_of_wall(const SimplexMesh<Dim, Order>& mesh) {
  FacetsOfWall<Dim, Order> found;
  const int fluid = mesh.region_index(group::fluid);
  for (int r = 0; r < static_cast<int>(mesh.regions.size()); ++r)
    if (r != fluid) found.regions.push_back(r);
  if (found.regions.empty()) return found;
  const auto boundary = boundary_facets(mesh, found.regions);
  const auto* inner = mesh.facets(group::inner);
  if (fluid >= 0)
    found.inner = interface_facets(mesh, fluid, found.regions);
  else if (inner)
    found.inner = chosen<Dim, Order>(boundary, keys_of<Dim>(*inner), true);
  if (found.inner.empty()) return found;
  if (const auto* outer = mesh.facets(group::outer)) {
    found.outer = chosen<Dim, Order>(boundary, keys_of<Dim>(*outer), true);
    return found;
  }
  auto taken = keys_of<Dim>(found.inner);
  for (const auto& group : mesh.facet_groups) taken.merge(keys_of<Dim>(group.facets));
  found.outer = chosen<Dim, Order>(boundary, taken, false);
  return found;
}

/// Distances of some nodes from a surface. Processes that all have them measure a stretch each.
std::vector<double> distances(const std::vector<int>& from, const std::vector<Point>& nodes,
                              const SurfaceDistance& surface, const Communicator& processes) {
  const EvenStretch mine(static_cast<std::int64_t>(from.size()), processes);
  std::vector<double> found;
  int guess = -1;  // the last one's facet: nodes come in an order of neighbours
  for (auto i = mine.first; i < mine.last; ++i) {
    const auto nearest = surface.nearest(nodes[from[static_cast<std::size_t>(i)]], guess);
    guess = nearest.facet;
    found.push_back(nearest.distance);
  }
  return processes.gather(found);
}

ThicknessRange range_between(const std::string& name, const std::vector<Point>& nodes, const WallFace& inner,
                             const WallFace& outer, const Communicator& processes) {
  ThicknessRange range;
  range.name = name;
  const auto extremes = [&](const std::vector<int>& on_face, const SurfaceDistance& surface, auto& least, auto* most) {
    const auto away = distances(on_face, nodes, surface, processes);
    const auto extreme = [&](auto at) {
      return ThicknessRange::Extreme{*at, nodes[on_face[static_cast<std::size_t>(at - away.begin())]]};
    };
    least = extreme(std::min_element(away.begin(), away.end()));
    if (most) *most = extreme(std::max_element(away.begin(), away.end()));
  };
  extremes(outer.nodes, inner.surface, range.least, &range.most);
  extremes(inner.nodes, outer.surface, range.least_seen_from_inside, static_cast<ThicknessRange::Extreme*>(nullptr));
  return range;
}

template <int Dim, int Order>
struct Layer {
  std::string name;
  std::vector<BoundaryFacet<Dim, Order>> boundary;
};

/// The wall's layers, each with the parts NAME/REGION that were cut out of it (scene/wall_regions.hpp).
template <int Dim, int Order>
std::vector<Layer<Dim, Order>> unordered_layers(const SimplexMesh<Dim, Order>& mesh, const std::vector<int>& regions) {
  const auto name = [&](int region) { return mesh.regions[static_cast<std::size_t>(region)]; };
  const auto is_part = [&](int part, int layer) { return name(part).rfind(name(layer) + "/", 0) == 0; };
  std::vector<Layer<Dim, Order>> layers;
  for (const int region : regions) {
    if (std::any_of(regions.begin(), regions.end(), [&](int other) { return is_part(region, other); })) continue;
    std::vector<int> all{region};
    std::copy_if(regions.begin(), regions.end(), std::back_inserter(all),
                 [&](int other) { return is_part(other, region); });
    layers.push_back({name(region), boundary_facets(mesh, all)});
  }
  return layers;
}

/// The wall's layers from inside outwards, each with neighbours before and behind it alone; empty where they lie
/// otherwise.
template <int Dim, int Order>
std::vector<Layer<Dim, Order>> layers_of(const SimplexMesh<Dim, Order>& mesh, const FacetsOfWall<Dim, Order>& wall) {
  std::vector<Layer<Dim, Order>> layers, left = unordered_layers(mesh, wall.regions);
  auto reached = keys_of<Dim>(wall.inner);
  const auto is_next = [&](const Layer<Dim, Order>& layer) {
    return std::any_of(layer.boundary.begin(), layer.boundary.end(),
                       [&](const auto& facet) { return reached.count(facet_key<Dim>(facet.nodes)) > 0; });
  };
  while (!left.empty()) {
    const auto next = std::find_if(left.begin(), left.end(), is_next);
    if (std::count_if(left.begin(), left.end(), is_next) != 1) return {};
    for (const auto& facet : next->boundary) reached.insert(facet_key<Dim>(facet.nodes));
    layers.push_back(std::move(*next));
    left.erase(next);
  }
  return layers;
}

}  // namespace

template <int Dim, int Order>
std::optional<WallFaces> faces_of_wall(const SimplexMesh<Dim, Order>& mesh) {
  const auto found = facets_of_wall(mesh);
  if (found.inner.empty() || found.outer.empty()) return std::nullopt;
  return WallFaces{face_of<Dim, Order>(mesh, found.inner), face_of<Dim, Order>(mesh, found.outer)};
}

template <int Dim, int Order>
std::vector<double> nodal_thickness(const SimplexMesh<Dim, Order>& mesh) {
  const auto faces = faces_of_wall(mesh);
  if (!faces) return {};
  const int fluid = mesh.region_index(group::fluid);
  std::vector<char> in_wall(mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] != fluid)
      for (const int node : mesh.cells[c]) in_wall[node] = 1;
  std::vector<double> thickness(mesh.nodes.size(), 0.0);
  for (std::size_t i = 0; i < thickness.size(); ++i)
    if (in_wall[i] != 0)
      thickness[i] =
          faces->inner.surface.nearest(mesh.nodes[i]).distance + faces->outer.surface.nearest(mesh.nodes[i]).distance;
  return thickness;
}

template <int Dim, int Order>
std::vector<ThicknessRange> thickness_ranges(const SimplexMesh<Dim, Order>& mesh, const Communicator& processes) {
  std::vector<ThicknessRange> ranges;
  const auto wall = facets_of_wall(mesh);
  if (wall.inner.empty() || wall.outer.empty()) return ranges;
  const auto layers = layers_of(mesh, wall);
  auto near = face_of<Dim, Order>(mesh, wall.inner);
  for (std::size_t k = 0; layers.size() > 1 && k < layers.size(); ++k) {
    Facets<Dim, Order> far = wall.outer;
    if (k + 1 < layers.size()) {
      Keys<Dim> of_next;
      for (const auto& facet : layers[k + 1].boundary) of_next.insert(facet_key<Dim>(facet.nodes));
      far = chosen<Dim, Order>(layers[k].boundary, of_next, true);
    }
    auto next = face_of<Dim, Order>(mesh, far);
    ranges.push_back(range_between(layers[k].name, mesh.nodes, near, next, processes));
    near = std::move(next);
  }
  ranges.push_back(range_between(layers.size() == 1 ? layers[0].name : "wall", mesh.nodes,
                                 face_of<Dim, Order>(mesh, wall.inner), face_of<Dim, Order>(mesh, wall.outer),
                                 processes));
  return ranges;
}

std::string to_text(const std::vector<ThicknessRange>& ranges) {
  std::string text;
  for (const auto& [name, least, most, from_inside] : ranges)
    text += fmt::format(
        "{}: thickness {:.4g} mm at {} to {:.4g} mm at {}; between the nodes as little as {:.4g} mm at {}\n", name,
        least.distance, place_of(least.at), most.distance, place_of(most.at), from_inside.distance,
        place_of(from_inside.at));
  return text;
}

#define INSTANTIATE(Dim, Order)                                                    \
  template std::optional<WallFaces> faces_of_wall(const SimplexMesh<Dim, Order>&); \
  template std::vector<double> nodal_thickness(const SimplexMesh<Dim, Order>&);    \
  template std::vector<ThicknessRange> thickness_ranges(const SimplexMesh<Dim, Order>&, const Communicator&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
