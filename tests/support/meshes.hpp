#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mesh/boundary.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesh/submesh.hpp"
#include "support/random.hpp"

namespace fsi::test {

/// A logical grid of n[0] x n[1] x n[2] boxes, each cut into six tetrahedra about its main diagonal (Kuhn's
/// subdivision: conforming, all tetrahedra positively oriented when the placement keeps orientation). \param place
/// position of grid point (i, j, k) \param region  region of box (i, j, k), an index into `regions`
template <class Place, class Region>
TetrahedralMesh grid_mesh(std::array<int, 3> n, const std::vector<std::string>& regions, Place place, Region region) {
  TetrahedralMesh mesh;
  mesh.regions = regions;
  const auto number = [&](int i, int j, int k) { return i + (n[0] + 1) * (j + (n[1] + 1) * k); };
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) mesh.nodes.push_back(place(i, j, k));
  static constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                       {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};  // even ones first
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        for (int o = 0; o < 6; ++o) {
          std::array<int, 3> at{i, j, k};
          TetrahedralMesh::Cell cell;
          cell[0] = number(i, j, k);
          for (int s = 0; s < 3; ++s) {
            ++at[orders[o][s]];
            cell[s + 1] = number(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(cell[2], cell[3]);
          mesh.cells.push_back(cell);
          mesh.cell_region.push_back(region(i, j, k));
        }
  return mesh;
}

inline double volume(const TetrahedralMesh& mesh, const TetrahedralMesh::Cell& cell) {
  double e[3][3];
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < 3; ++i) e[s][i] = mesh.nodes[cell[s + 1]][i] - mesh.nodes[cell[0]][i];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

/// 1 for every node on the boundary of one of the regions, interfaces between regions included.
inline std::vector<char> boundary_marks(const TetrahedralMesh& mesh) {
  std::vector<char> marks(mesh.nodes.size(), 0);
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    for (const auto& facet : boundary_facets(mesh, {static_cast<int>(r)}))
      for (int node : facet.nodes) marks[node] = 1;
  return marks;
}

/// Moves every inner node by a fixed pseudo-random vector with components up to `amount`: no element is like another.
inline void distort(TetrahedralMesh& mesh, double amount, unsigned seed = 7) {
  const auto fixed = boundary_marks(mesh);
  Random random(seed);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    for (int i = 0; i < 3; ++i) {
      const double shift = amount * random();
      if (!fixed[a]) mesh.nodes[a][i] += shift;
    }
  for (const auto& cell : mesh.cells)
    if (!(volume(mesh, cell) > 0)) throw std::logic_error("the distortion inverts an element");
}

/// The unit cube with n boxes a side, one region, irregular inside.
inline TetrahedralMesh irregular_cube(int n, double distortion = 0.15, const std::string& region = "fluid") {
  const double h = 1.0 / n;
  auto mesh = grid_mesh(
      {n, n, n}, {region},
      [&](int i, int j, int k) {
        return Point{i * h, j * h, k * h};
      },
      [](int, int, int) { return 0; });
  distort(mesh, distortion * h);
  return mesh;
}

/// Boundary facets of a region all of whose nodes satisfy a predicate, normals out of the region.
template <class Predicate>
std::vector<TetrahedralMesh::Facet> facets_where(const TetrahedralMesh& mesh, const std::string& region,
                                                 Predicate holds) {
  std::vector<TetrahedralMesh::Facet> found;
  for (const auto& facet : boundary_facets(mesh, {mesh.region_index(region)}))
    if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return holds(mesh.nodes[node]); }))
      found.push_back(facet.nodes);
  return found;
}

/// Fluid below, two wall layers above, conforming on z = 1: 0 < x, y < 1, fluid 0 < z < 1, media up to 1.26, adventitia
/// up to 1.39. Inlet x = 0, outlet x = 1; the wall is held on its four sides and free on top.
inline TetrahedralMesh fluid_and_wall_box(int n) {
  const double h = 1.0 / n;
  const auto height = [&](int k) { return k <= n ? k * h : (k == n + 1 ? 1.26 : 1.39); };
  auto mesh = grid_mesh(
      {n, n, n + 2}, {"fluid", "media", "adventitia"},
      [&](int i, int j, int k) {
        return Point{i * h, j * h, height(k)};
      },
      [&](int, int, int k) { return k < n ? 0 : (k == n ? 1 : 2); });
  distort(mesh, 0.15 * h);
  const auto at = [](int axis, double value) {
    return [=](const Point& x) { return std::abs(x[axis] - value) < 1e-12; };
  };
  mesh.facet_groups.push_back({"inlet", facets_where(mesh, "fluid", at(0, 0.0))});
  mesh.facet_groups.push_back({"outlet", facets_where(mesh, "fluid", at(0, 1.0))});
  std::vector<TetrahedralMesh::Facet> sides, top;
  for (const auto* layer : {"media", "adventitia"}) {
    for (int axis = 0; axis < 2; ++axis)
      for (double value : {0.0, 1.0}) {
        const auto facets = facets_where(mesh, layer, at(axis, value));
        sides.insert(sides.end(), facets.begin(), facets.end());
      }
    const auto facets = facets_where(mesh, layer, at(2, 1.39));
    top.insert(top.end(), facets.begin(), facets.end());
  }
  mesh.facet_groups.push_back({"wall_ends", sides});
  mesh.facet_groups.push_back({"outer", top});
  return mesh;
}

/// A logical grid of n[0] x n[1] quadrilaterals in the (r, z) plane, each cut into two triangles, counter-clockwise
/// with r to the right and z upwards.
template <class Place, class Region>
TriangleMesh triangle_grid(std::array<int, 2> n, const std::vector<std::string>& regions, Place place, Region region) {
  TriangleMesh mesh;
  mesh.regions = regions;
  const auto number = [&](int i, int j) { return i + (n[0] + 1) * j; };
  for (int j = 0; j <= n[1]; ++j)
    for (int i = 0; i <= n[0]; ++i) mesh.nodes.push_back(place(i, j));
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i) {
      mesh.cells.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.cells.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
      for (int twice = 0; twice < 2; ++twice) mesh.cell_region.push_back(region(i, j));
    }
  return mesh;
}

/// Sides that only one triangle has, in its direction of rotation: the outward normal is to their right.
inline std::vector<TriangleMesh::Facet> boundary_sides(const TriangleMesh& mesh) {
  std::vector<std::array<int, 4>> sides;  // sorted pair, then the side as its cell runs through it
  for (const auto& cell : mesh.cells)
    for (int a = 0; a < 3; ++a) {
      const int from = cell[a], to = cell[(a + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), from, to});
    }
  std::sort(sides.begin(), sides.end());
  std::vector<TriangleMesh::Facet> boundary;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto same = [&](std::size_t t) { return sides[s][0] == sides[t][0] && sides[s][1] == sides[t][1]; };
    if ((s > 0 && same(s - 1)) || (s + 1 < sides.size() && same(s + 1))) continue;
    boundary.push_back({sides[s][2], sides[s][3]});
  }
  return boundary;
}

/// A body of revolution 1 < r < 2, 0 < z < 1 with n quadrilaterals a side, irregular inside.
inline TriangleMesh irregular_ring(int n, const std::string& region = "fluid", double first_radius = 1) {
  const double h = 1.0 / n;
  auto mesh = triangle_grid(
      {n, n}, {region},
      [&](int i, int j) {
        return Point{first_radius + i * h, 0, j * h};
      },
      [](int, int) { return 0; });
  Random random(11);
  for (auto& x : mesh.nodes) {
    const double dr = 0.15 * h * random(), dz = 0.15 * h * random();
    const auto inside = [](double s) { return s > 1e-9 && s < 1 - 1e-9; };
    if (inside(x[0] - first_radius) && inside(x[2])) {
      x[0] += dr;
      x[2] += dz;
    }
  }
  return mesh;
}

inline std::vector<char> boundary_marks(const TriangleMesh& mesh) {
  std::vector<char> marks(mesh.nodes.size(), 0);
  for (const auto& side : boundary_sides(mesh))
    for (int node : side) marks[node] = 1;
  return marks;
}

/// Gives cells of region 1 and up their own copies of the nodes they share with region 0: a crack. Lists (node, copy).
template <int Dim>
std::vector<std::pair<int, int>> split_off_first_region(SimplexMesh<Dim>& mesh) {
  std::vector<char> in_first(mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] == 0)
      for (int node : mesh.cells[c]) in_first[node] = 1;
  std::vector<int> copy(mesh.nodes.size(), -1);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cell_region[c] > 0)
      for (int& node : mesh.cells[c]) {
        if (!in_first[node]) continue;
        if (copy[node] < 0) {
          copy[node] = static_cast<int>(mesh.nodes.size());
          pairs.push_back({node, copy[node]});
          const Point x = mesh.nodes[node];
          mesh.nodes.push_back(x);
          in_first.push_back(0);
        }
        node = copy[node];
      }
  return pairs;
}

/// The whole mesh as one part.
template <int Dim, int Order>
Submesh<Dim, Order> whole(const SimplexMesh<Dim, Order>& mesh) {
  std::vector<int> all(mesh.regions.size());
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = static_cast<int>(r);
  return submesh(mesh, all);
}

}  // namespace fsi::test
