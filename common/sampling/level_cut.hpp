#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "fem/simplex_rule.hpp"
#include "mesh/cell_map.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// A piece of a cell's cut by the zero level of a function: a triangle in a tetrahedron, a segment in a triangle, flat
/// in the cell's barycentric coordinates. The order of its corners makes its normal point to where the function is
/// larger.
template <int Dim>
struct CutPiece {
  using Barycentric = std::array<double, Dim + 1>;
  std::array<Barycentric, Dim> corners;
};

/// A quadrature point of a piece.
template <int Dim>
struct CutPoint {
  std::array<double, Dim + 1> place;  ///< barycentric
  Point at;                           ///< mm
  Point area;                         ///< normal times the area that belongs to it, mm^2; length in triangles, mm
};

namespace detail {

/// The 4 or 8 simplices that one is divided into by the middles of its edges, as numbers of a quadratic cell's nodes.
template <int Dim>
constexpr auto divided_simplex() {
  if constexpr (Dim == 2)
    return std::array<std::array<int, 3>, 4>{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  else  // corners, then the octahedron in between around its diagonal from node 4 to node 9
    return std::array<std::array<int, 4>, 8>{{{0, 4, 6, 7},
                                              {4, 1, 5, 8},
                                              {6, 5, 2, 9},
                                              {7, 8, 9, 3},
                                              {4, 9, 5, 6},
                                              {4, 9, 6, 7},
                                              {4, 9, 7, 8},
                                              {4, 9, 8, 5}}};
}

/// Whether the piece's normal in the space of the last Dim coordinates points along `to`.
template <int Dim>
bool points_along(const CutPiece<Dim>& piece, const std::array<double, Dim + 1>& to) {
  const auto& c = piece.corners;
  if constexpr (Dim == 3) {
    const auto edge = [&](int i) { return Point{c[i][1] - c[0][1], c[i][2] - c[0][2], c[i][3] - c[0][3]}; };
    return dot(cross(edge(1), edge(2)), {to[1], to[2], to[3]}) >= 0;
  } else {
    return (c[1][2] - c[0][2]) * to[1] - (c[1][1] - c[0][1]) * to[2] >= 0;
  }
}

}  // namespace detail

/// A place in a cell with the function there.
template <int Dim>
struct CutCorner {
  std::array<double, Dim + 1> place;
  double f;
};

/// Calls visit(CutPiece) for the pieces of the cut of a simplex in which f is linear.
template <int Dim, class Visit>
void cut_simplex(const std::array<CutCorner<Dim>, Dim + 1>& corners, const Visit& visit) {
  std::array<int, Dim + 1> below{}, above{};
  int n_below = 0, n_above = 0;
  for (int i = 0; i <= Dim; ++i) (corners[i].f < 0 ? below[n_below++] : above[n_above++]) = i;
  if (n_below == 0 || n_above == 0) return;
  const auto crossing = [&](int a, int b) {  // from a below to b above
    const double t = corners[a].f / (corners[a].f - corners[b].f);
    std::array<double, Dim + 1> place;
    for (int i = 0; i <= Dim; ++i) place[i] = (1 - t) * corners[a].place[i] + t * corners[b].place[i];
    return place;
  };
  std::array<double, Dim + 1> upwards;
  for (int i = 0; i <= Dim; ++i) upwards[i] = corners[above[0]].place[i] - corners[below[0]].place[i];
  const auto show = [&](CutPiece<Dim> piece) {
    if (!detail::points_along(piece, upwards)) std::swap(piece.corners[0], piece.corners[1]);
    visit(piece);
  };
  if constexpr (Dim == 2) {
    if (n_below == 1)
      show({{crossing(below[0], above[0]), crossing(below[0], above[1])}});
    else
      show({{crossing(below[0], above[0]), crossing(below[1], above[0])}});
  } else if (n_below == 1) {
    show({{crossing(below[0], above[0]), crossing(below[0], above[1]), crossing(below[0], above[2])}});
  } else if (n_above == 1) {
    show({{crossing(below[0], above[0]), crossing(below[1], above[0]), crossing(below[2], above[0])}});
  } else {
    const auto first = crossing(below[0], above[0]), across = crossing(below[1], above[1]);
    show({{first, crossing(below[0], above[1]), across}});
    show({{first, across, crossing(below[1], above[0])}});
  }
}

/// Calls visit(CutPiece) for the pieces of a cell's cut by f = 0. A zero counts as positive: where the level lies on a
/// facet, it cuts the cell on the negative side only. For quadratic f the cell is divided twice and f taken as linear
/// in each of the 16 or 64 parts: off the true cut by the square of a quarter of the cell's size.
/// \param f  at the nodes of the cell
template <int Dim, int Order, class Visit>
void cut_cell(const std::array<double, nodes_of_simplex(Dim, Order)>& f, const Visit& visit) {
  using Corners = std::array<CutCorner<Dim>, Dim + 1>;
  Corners whole{};
  for (int i = 0; i <= Dim; ++i) {
    whole[i].place[i] = 1;
    whole[i].f = f[i];
  }
  if constexpr (Order == 1) {
    cut_simplex<Dim>(whole, visit);
  } else {
    const auto divide = [&](const Corners& corners, const auto& take) {
      std::array<CutCorner<Dim>, nodes_of_simplex(Dim, 2)> nodes;
      std::copy(corners.begin(), corners.end(), nodes.begin());
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        CutCorner<Dim>& middle = nodes[Dim + 1 + e];
        for (int i = 0; i <= Dim; ++i) middle.place[i] = 0.5 * (corners[a].place[i] + corners[b].place[i]);
        const auto shape = CellMap<Dim, 2>::shape(middle.place);
        middle.f = 0;
        for (std::size_t i = 0; i < shape.size(); ++i) middle.f += shape[i] * f[i];
      }
      for (const auto& simplex : detail::divided_simplex<Dim>()) {
        Corners part;
        for (int i = 0; i <= Dim; ++i) part[i] = nodes[simplex[i]];
        take(part);
      }
    };
    divide(whole, [&](const Corners& half) {
      divide(half, [&](const Corners& quarter) { cut_simplex<Dim>(quarter, visit); });
    });
  }
}

/// Calls visit(CutPoint) for the quadrature points of a piece in a cell with nodes at map.x. Exact for quadratic fields
/// on quadratic cells, in triangles also times the distance from the axis.
template <int Dim, int Order, class Visit>
void for_points_of(const CutPiece<Dim>& piece, const CellMap<Dim, Order>& map, const Visit& visit) {
  static constexpr auto rule = [] {
    if constexpr (Dim == 3)
      return triangle_rule_4();
    else
      return line_rule_5();
  }();
  for (int q = 0; q < rule.points; ++q) {
    CutPoint<Dim> point{};
    for (int c = 0; c < Dim; ++c)
      for (int i = 0; i <= Dim; ++i) point.place[i] += rule.point[q][c] * piece.corners[c][i];
    point.at = map.at(point.place);
    const auto slope = map.slopes(point.place);
    std::array<Point, Dim - 1> tangent;
    for (int t = 0; t < Dim - 1; ++t) {
      tangent[t] = {0, 0, 0};
      for (int i = 0; i <= Dim; ++i)
        tangent[t] = tangent[t] + (piece.corners[t + 1][i] - piece.corners[0][i]) * slope[i];
    }
    if constexpr (Dim == 3) {
      point.area = (0.5 * rule.weight[q]) * cross(tangent[0], tangent[1]);
    } else {
      // The tangent turned clockwise in the plane of the mesh, seen from where the cell runs counter-clockwise.
      const Point across = cross(map.x[1] - map.x[0], map.x[2] - map.x[0]);
      point.area = (rule.weight[q] / norm(across)) * cross(tangent[0], across);
    }
    visit(point);
  }
}

/// Groups cut cells into pieces: cells that share a facet which is cut itself are in one piece.
/// \param cut     numbers of the cut cells
/// \param values  values(cell): numbers at the nodes of a cell that bound f: f itself where linear, or control values
/// \returns for each cut cell the number of its piece; pieces count from 0 in the order of their first cells
/// \tparam Order  of the numbers in `values`: 1, at the vertices alone, goes with any cells
template <int Dim, int Order, class Cell, class Values>
std::vector<int> pieces_of_cut(const std::vector<Cell>& cells, const std::vector<int>& cut, const Values& values) {
  struct Use {
    FacetKey<Dim> key;
    int cut;
  };
  std::vector<Use> uses;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const auto f = values(cut[k]);
    for (const auto& facet : OutwardFacets<Dim, Order>::table) {
      const bool below = f[facet[0]] < 0;
      if (std::all_of(facet.begin(), facet.end(), [&](int node) { return (f[node] < 0) == below; })) continue;
      auto nodes = facet;
      for (int& node : nodes) node = cells[cut[k]][node];
      uses.push_back({facet_key<Dim>(nodes), static_cast<int>(k)});
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const Use& a, const Use& b) { return a.key != b.key ? a.key < b.key : a.cut < b.cut; });
  DisjointSets sets(cut.size());
  for (std::size_t i = 1; i < uses.size(); ++i)
    if (uses[i].key == uses[i - 1].key) sets.join(uses[i - 1].cut, uses[i].cut);
  std::vector<int> number(cut.size(), -1), piece(cut.size());
  int count = 0;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    int& of_root = number[sets.root(static_cast<int>(k))];
    if (of_root < 0) of_root = count++;
    piece[k] = of_root;
  }
  return piece;
}

}  // namespace fsi
