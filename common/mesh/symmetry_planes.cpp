#include "mesh/symmetry_planes.hpp"

#include <cmath>

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

#define INSTANTIATE(Dim, Order) template SymmetryPlanes<Dim, Order> symmetry_planes(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
