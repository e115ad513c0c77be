#include "mesh/curved_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "mesh/cell_map.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

template <int Dim>
constexpr int vertices = Dim + 1;
template <int Dim>
constexpr int coefficients = Dim == 3 ? 64 : 9;  // vertices to the power of the degree

/// A part of the reference cell: its corners, and the polar form of det J on them. Entry (k_1, .., k_Dim) in base
/// Dim + 1, symmetric in its indices, is the Bernstein coefficient of the monomial lambda_k1 .. lambda_kDim.
template <int Dim>
struct Part {
  std::array<std::array<double, vertices<Dim>>, vertices<Dim>> corner;  ///< barycentric coordinates
  std::array<double, coefficients<Dim>> coefficient;
  int depth = 0;

  double least() const { return *std::min_element(coefficient.begin(), coefficient.end()); }
  /// Value at a corner: all indices alike.
  double at_corner(int k) const { return coefficient[Dim == 3 ? k * 21 : k * 4]; }
};

template <int Dim>
double determinant(const std::array<Point, Dim>& columns) {
  if constexpr (Dim == 3)
    return dot(columns[0], cross(columns[1], columns[2]));
  else
    return planar_cross(columns[0], columns[1]);
}

/// dx/dlambda_i - dx/dlambda_0 for i = 1 .. Dim at each vertex; between them it is linear.
template <int Dim>
std::array<std::array<Point, Dim>, vertices<Dim>> columns_at_vertices(
    const std::array<Point, nodes_of_simplex(Dim, 2)>& x) {
  std::array<std::array<int, vertices<Dim>>, vertices<Dim>> middle{};
  for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
    const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
    middle[a][b] = middle[b][a] = vertices<Dim> + static_cast<int>(e);
  }
  std::array<std::array<Point, Dim>, vertices<Dim>> columns;
  for (int k = 0; k < vertices<Dim>; ++k) {
    // N_i = lambda_i (2 lambda_i - 1) and 4 lambda_i lambda_j, differentiated at lambda_k = 1.
    const auto slope = [&](int i) { return i == k ? 3.0 * x[k] : 4.0 * x[middle[i][k]] - x[i]; };
    const Point first = slope(0);
    for (int i = 0; i < Dim; ++i) columns[k][i] = slope(i + 1) - first;
  }
  return columns;
}

template <int Dim>
Part<Dim> whole_cell(const std::array<Point, nodes_of_simplex(Dim, 2)>& x) {
  const auto columns = columns_at_vertices<Dim>(x);
  constexpr int n = vertices<Dim>;
  Part<Dim> part;
  for (int i = 0; i < n; ++i) {
    part.corner[i].fill(0);
    part.corner[i][i] = 1;
  }
  // det is linear in each column and each column in lambda: the polar form is the mean over the orders of its indices.
  if constexpr (Dim == 3) {
    std::array<double, coefficients<3>> ordered;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        for (int c = 0; c < n; ++c)
          ordered[(a * n + b) * n + c] = determinant<3>({columns[a][0], columns[b][1], columns[c][2]});
    const auto at = [&](int a, int b, int c) { return ordered[(a * n + b) * n + c]; };
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        for (int c = 0; c < n; ++c)
          part.coefficient[(a * n + b) * n + c] =
              (at(a, b, c) + at(b, c, a) + at(c, a, b) + at(a, c, b) + at(c, b, a) + at(b, a, c)) / 6;
  } else {
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        part.coefficient[a * n + b] =
            0.5 * (determinant<2>({columns[a][0], columns[b][1]}) + determinant<2>({columns[b][0], columns[a][1]}));
  }
  return part;
}

/// The half of a part with corner `moved` in the middle of the edge to corner `kept` (de Casteljau's algorithm).
template <int Dim>
Part<Dim> half(Part<Dim> part, int kept, int moved) {
  constexpr int n = vertices<Dim>;
  for (int i = 0; i < n; ++i) part.corner[moved][i] = 0.5 * (part.corner[moved][i] + part.corner[kept][i]);
  for (int stride = 1; stride < coefficients<Dim>; stride *= n)
    for (int entry = 0; entry < coefficients<Dim>; ++entry)
      if (entry / stride % n == moved)
        part.coefficient[entry] = 0.5 * (part.coefficient[entry] + part.coefficient[entry + (kept - moved) * stride]);
  ++part.depth;
  return part;
}

/// The corners at the ends of the longest edge.
template <int Dim>
std::array<int, 2> longest_edge(const Part<Dim>& part) {
  std::array<int, 2> longest{0, 1};
  double most = -1;
  for (const auto& [a, b] : SimplexEdges<Dim>::vertices) {
    // The squared length in the reference cell with a right angle at corner 0.
    double square = 0;
    for (int i = 1; i < vertices<Dim>; ++i) {
      const double step = part.corner[a][i] - part.corner[b][i];
      square += step * step;
    }
    if (square <= most) continue;
    most = square;
    longest = {a, b};
  }
  return longest;
}

/// Mean over the cell: the Bernstein polynomials all have the same integral.
template <int Dim>
double mean(const Part<Dim>& part) {
  constexpr int n = vertices<Dim>;
  double sum = 0;
  int count = 0;
  for (int entry = 0; entry < coefficients<Dim>; ++entry) {
    int last = n;
    bool sorted = true;  // each coefficient once
    for (int left = entry, i = 0; i < Dim; ++i, left /= n) {
      sorted = sorted && left % n <= last;
      last = left % n;
    }
    if (!sorted) continue;
    sum += part.coefficient[entry];
    ++count;
  }
  return sum / count;
}

}  // namespace

template <int Dim>
CellJacobian cell_jacobian(const std::array<Point, nodes_of_simplex(Dim, 2)>& x) {
  constexpr double tolerance = 0.01;  // of the mean, for the minimum
  constexpr int deepest = 20;
  constexpr std::size_t most_parts = 4000;

  const Part<Dim> cell = whole_cell<Dim>(x);
  CellJacobian result{std::numeric_limits<double>::infinity(), mean(cell), x[0], true};
  std::array<double, vertices<Dim>> where{};
  std::size_t looked_at = 0;
  const auto look_at = [&](const Part<Dim>& part) {
    ++looked_at;
    for (int k = 0; k < vertices<Dim>; ++k)
      if (part.at_corner(k) < result.least) {
        result.least = part.at_corner(k);
        where = part.corner[k];
      }
  };
  look_at(cell);
  std::vector<Part<Dim>> open{cell};
  while (!open.empty()) {
    const Part<Dim> part = open.back();
    open.pop_back();
    const double bound = part.least();
    if (bound > 0 && bound >= result.least - tolerance * result.mean) continue;
    if (!(result.least > 0)) break;
    if (part.depth == deepest || looked_at >= most_parts) {
      if (!(bound > 0)) result.positive = false;
      continue;
    }
    const auto [a, b] = longest_edge(part);
    for (const auto& piece : {half(part, a, b), half(part, b, a)}) {
      look_at(piece);
      open.push_back(piece);
    }
  }
  if (!(result.least > 0)) result.positive = false;
  result.where = CellMap<Dim, 2>{x}.at(where);
  return result;
}

template <int Dim>
bool is_surely_positive(const std::array<Point, nodes_of_simplex(Dim, 2)>& x) {
  return whole_cell<Dim>(x).least() > 0;
}

std::string bad_curved_cell(const CellJacobian& jacobian) {
  return fmt::format("folded by its curved edges: det J is {:.3g} of its mean near ({:.6g}, {:.6g}, {:.6g}) mm",
                     jacobian.ratio(), jacobian.where[0], jacobian.where[1], jacobian.where[2]);
}

template bool is_surely_positive<2>(const std::array<Point, 6>&);
template bool is_surely_positive<3>(const std::array<Point, 10>&);
template CellJacobian cell_jacobian<2>(const std::array<Point, 6>&);
template CellJacobian cell_jacobian<3>(const std::array<Point, 10>&);

}  // namespace fsi
