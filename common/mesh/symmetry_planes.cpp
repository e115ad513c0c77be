#include "mesh/symmetry_planes.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// Normal to a facet, as long as the facet is large; of edges, in the plane of the triangles.
template <int Dim, int Order>
Point facet_normal(const SimplexMesh<Dim, Order>& mesh, const typename SimplexMesh<Dim, Order>::Facet& facet) {
  const auto& x = mesh.nodes;
  if constexpr (Dim == 3) {
    return triangle_area_vector(x[facet[0]], x[facet[1]], x[facet[2]]);
  } else {
    const auto& cell = mesh.cells.front();
    const Point out_of_plane = triangle_area_vector(x[cell[0]], x[cell[1]], x[cell[2]]);
    return (1 / norm(out_of_plane)) * cross(x[facet[1]] - x[facet[0]], out_of_plane);
  }
}

template <int Dim, int Order>
Point mean_normal(const SimplexMesh<Dim, Order>& mesh,
                  const std::vector<typename SimplexMesh<Dim, Order>::Facet>& facets) {
  constexpr double rounding = 1e-10;
  Point largest{0, 0, 0}, sum{0, 0, 0};
  for (const auto& facet : facets)
    if (const Point normal = facet_normal(mesh, facet); norm(normal) > norm(largest)) largest = normal;
  for (const auto& facet : facets) {
    const Point normal = facet_normal(mesh, facet);
    sum = sum + (dot(normal, largest) < 0 ? -1.0 : 1.0) * normal;
  }
  for (double& component : sum)
    if (std::abs(component) < rounding * norm(sum)) component = 0;
  return (1 / norm(sum)) * sum;
}

}  // namespace

template <int Dim, int Order>
SymmetryPlanes<Dim, Order> symmetry_planes(const SimplexMesh<Dim, Order>& mesh) {
  SymmetryPlanes<Dim, Order> planes;
  if (mesh.cells.empty()) return planes;
  for (const auto& group : mesh.facet_groups) {
    if (!group::is_symmetry_plane(group.name) || group.facets.empty()) continue;
    Point normal{0, 0, 0};
    for (int axis = 0; axis < 3; ++axis)
      if (group.name == group::symmetry[axis]) normal[axis] = 1;
    planes.push_back({&group, norm(normal) > 0 ? normal : mean_normal(mesh, group.facets)});
  }
  return planes;
}

template <int Dim, int Order>
std::vector<MirrorPlane> mirror_planes(const SimplexMesh<Dim, Order>& mesh) {
  std::vector<MirrorPlane> planes;
  for (const auto& plane : symmetry_planes(mesh)) {
    const auto& facets = plane.group->facets;
    planes.push_back(
        {plane.normal, dot(plane.normal, mesh.nodes[facets[0][0]]), std::vector<char>(mesh.nodes.size(), 0)});
    for (const auto& facet : facets)
      for (const int node : facet) planes.back().holds[node] = 1;
  }
  return planes;
}

std::vector<MirrorPlane> of_part(std::vector<MirrorPlane> planes, const PartNodes& part) {
  for (MirrorPlane& plane : planes) {
    std::vector<char> here;
    for (const int node : part.mesh_node) here.push_back(plane.holds[node]);
    plane.holds = std::move(here);
  }
  return planes;
}

Point projected(Point x, const std::vector<const MirrorPlane*>& planes) {
  constexpr double parallel = 1e-6;                  // the sine of an angle
  std::vector<std::pair<Point, double>> orthogonal;  // unit normals and offsets, by Gram and Schmidt
  for (const MirrorPlane* plane : planes) {
    Point normal = plane->normal;
    double offset = plane->offset;
    for (const auto& [other, at] : orthogonal) {
      const double along = dot(plane->normal, other);
      normal = normal - along * other;
      offset -= along * at;
    }
    const double length = norm(normal);
    if (length > parallel) orthogonal.emplace_back((1 / length) * normal, offset / length);
  }
  for (const auto& [normal, offset] : orthogonal) x = x - (dot(normal, x) - offset) * normal;
  return x;
}

#define INSTANTIATE(Dim, Order)                                                        \
  template SymmetryPlanes<Dim, Order> symmetry_planes(const SimplexMesh<Dim, Order>&); \
  template std::vector<MirrorPlane> mirror_planes(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
