#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "mesh/cell_map.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesh_io/gmsh_reader.hpp"

namespace fsi {

/// Nodes in the middles of edges, by the edges' ends.
class EdgeMiddles {
 public:
  /// \return the node and whether it is new, then numbered `next`
  std::pair<int, bool> find_or_add(int a, int b, int next) {
    const auto [found, is_new] = node_.try_emplace(key(a, b), next);
    return {found->second, is_new};
  }
  int at(int a, int b) const { return node_.at(key(a, b)); }

  /// A number for an edge, the same for both directions.
  static std::uint64_t key(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }

 private:
  std::unordered_map<std::uint64_t, int> node_;
};

/// The shape functions of a quadratic simplex half way between its nodes p and q, in barycentric coordinates.
template <int Dim>
std::array<double, nodes_of_simplex(Dim, 2)> weights_between(int p, int q) {
  std::array<double, Dim + 1> lambda{};
  for (const int place : {p, q}) {
    if (place <= Dim) {
      lambda[place] += 0.5;
      continue;
    }
    for (const int vertex : SimplexEdges<Dim>::vertices[place - Dim - 1]) lambda[vertex] += 0.25;
  }
  return CellMap<Dim, 2>::shape(lambda);
}

/// The point half way between the nodes p and q of a quadratic cell, in barycentric coordinates; mm.
template <int Dim>
Point point_between(const std::vector<Point>& nodes, const std::array<int, nodes_of_simplex(Dim, 2)>& cell, int p,
                    int q) {
  const auto weights = weights_between<Dim>(p, q);
  Point x{0, 0, 0};
  for (std::size_t i = 0; i < weights.size(); ++i) x = x + weights[i] * nodes[cell[i]];
  return x;
}

/// Refuses a part of a cell that read_gmsh() would refuse as inverted or degenerate.
/// \param cell  vertices first
/// \param sign  of its volume, as its vertices stand: 1 or -1
/// \throws InputError where the straight cell between the vertices is inverted or flat
template <int Dim, int Order, std::size_t Nodes>
void require_upright(const std::vector<Point>& nodes, const std::array<int, Nodes>& cell, int sign,
                     const std::string& file) {
  std::array<Point, Dim + 1> x;
  for (int i = 0; i <= Dim; ++i) x[i] = nodes[cell[i]];
  double least = smallest_relative_volume, longest = 0;
  for (int a = 0; a <= Dim; ++a)
    for (int b = a + 1; b <= Dim; ++b) longest = std::max(longest, distance(x[a], x[b]));
  for (int d = 0; d < Dim; ++d) least *= longest;
  const double volume = sign * simplex_volume<Dim>(x.data());
  if (volume > least) return;
  throw InputError(
      file, fmt::format("{} near ({:.6g}, {:.6g}, {:.6g}) mm", CellWords<Dim>::cell, x[0][0], x[0][1], x[0][2]),
      fmt::format("cannot be refined: a part of it would be {}, {} {:.3g} {}", volume < -least ? "inverted" : "flat",
                  CellWords<Dim>::measure, volume, CellWords<Dim>::unit),
      Order == 1 ? "mesh again, with Mesh.Optimize = 1" : "its edges are curved too much: mesh finer there");
}

}  // namespace fsi
