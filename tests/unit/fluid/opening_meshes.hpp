#pragma once

#include <cmath>
#include <vector>

#include "fem/facet_load.hpp"
#include "fluid/inflow_profile.hpp"
#include "mesh/boundary.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"

namespace fsi::test {

/// Turns the plane z = 0 with its normal -z into one that looks no axis' way, and moves it.
inline Point tilted(const Point& x) {
  constexpr double a = 0.7, b = -0.4;
  const Point y{x[0] * std::cos(a) - x[1] * std::sin(a), x[0] * std::sin(a) + x[1] * std::cos(a), x[2]};
  return {y[0] + 0.3, y[1] * std::cos(b) - y[2] * std::sin(b) - 2, y[1] * std::sin(b) + y[2] * std::cos(b) + 5};
}
/// The normal of such a plane into the fluid, which lies above it.
inline Point tilted_inward() {
  return tilted({0, 0, 1}) - tilted({0, 0, 0});
}

/// A flat opening of a 3D part from a triangle mesh in the plane z = 0, fluid above. The fluid sticks at the nodes of
/// the rim where `walled(x)`, x before the plane is tilted. Mid-edge nodes are put where `bend` says.
template <class Element, class Walled, class Bend>
InflowOpening<Element> flat_opening(const TriangleMesh& plane, Walled walled, Bend bend) {
  InflowOpening<Element> opening;
  opening.name = "in";
  std::vector<Point> flat;
  const auto take = [&](const auto& mesh) {
    flat = mesh.nodes;
    for (auto cell : mesh.cells) {
      std::swap(cell[0], cell[1]);  // the outward normal is -z
      if constexpr (Element::order == 2) std::swap(cell[4], cell[5]);
      opening.facets.push_back(cell);
    }
  };
  if constexpr (Element::order == 2)
    take(with_mid_edge_nodes(plane));
  else
    take(plane);
  opening.sticking.assign(flat.size(), 0);
  for (const int a : rim_nodes<3>(opening.facets)) {
    opening.sticking[a] = walled(flat[a]);
    flat[a] = bend(flat[a]);
  }
  for (const auto& x : flat) opening.nodes.push_back(tilted(x));
  return opening;
}
template <class Element, class Walled>
InflowOpening<Element> flat_opening(const TriangleMesh& plane, Walled walled) {
  return flat_opening<Element>(plane, walled, [](const Point& x) { return x; });
}
inline bool everywhere(const Point&) {
  return true;
}

/// A sector of a disk: `rings` of nodes about the centre, `around` of them on the outermost.
inline TriangleMesh sector(double radius, double angle, int rings, int around) {
  TriangleMesh mesh;
  mesh.regions = {"fluid"};
  const bool whole = angle > 6.28;
  const int columns = whole ? around : around + 1;
  mesh.nodes.push_back({0, 0, 0});
  for (int i = 1; i <= rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const double r = radius * i / rings, phi = angle * j / around;
      mesh.nodes.push_back({r * std::cos(phi), r * std::sin(phi), 0});
    }
  const auto number = [&](int i, int j) { return i == 0 ? 0 : 1 + (i - 1) * columns + j % columns; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      mesh.cells.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      if (i > 0) mesh.cells.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  mesh.cell_region.assign(mesh.cells.size(), 0);
  return mesh;
}
inline TriangleMesh disk(double radius, int rings, int around) {
  return sector(radius, 2 * std::acos(-1.0), rings, around);
}

/// A rectangle of n x m boxes.
inline TriangleMesh rectangle(double width, double height, int n, int m) {
  TriangleMesh mesh;
  mesh.regions = {"fluid"};
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) mesh.nodes.push_back({width * i / n, height * j / m, 0});
  const auto number = [&](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.cells.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.cells.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  mesh.cell_region.assign(mesh.cells.size(), 0);
  return mesh;
}

/// The opening of a triangle mesh between two points, n facets, fluid to the left of the way from the first to the
/// second.
template <class Element>
InflowOpening<Element> line_opening(const Point& from, const Point& to, int n, bool from_sticks, bool to_sticks) {
  InflowOpening<Element> opening;
  opening.name = "in";
  constexpr int order = Element::order;
  for (int i = 0; i <= order * n; ++i) {
    opening.nodes.push_back(from + (static_cast<double>(i) / (order * n)) * (to - from));
    opening.sticking.push_back((i == 0 && from_sticks) || (i == order * n && to_sticks));
  }
  for (int i = 0; i < n; ++i) {
    if constexpr (order == 2)
      opening.facets.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    else
      opening.facets.push_back({i, i + 1});
  }
  return opening;
}

/// What flows into the fluid, mm^3/ms: minus the dot product with the weights of the loads.
template <class Element>
double discrete_inflow(const InflowOpening<Element>& opening, const std::vector<double>& velocity) {
  using Layout = VectorLayout<Element::components>;
  const auto weights = normal_weights<Element, Layout>(opening.nodes, opening.facets);
  double flow = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) flow -= weights[i] * velocity[i];
  return flow;
}

/// The velocity of a node along a direction.
template <class Element>
double along(const std::vector<double>& velocity, int node, const Point& direction) {
  using Layout = VectorLayout<Element::components>;
  double sum = 0;
  for (int k = 0; k < Element::components; ++k) sum += velocity[Layout::vector(node, k)] * direction[Element::axis[k]];
  return sum;
}

}  // namespace fsi::test
