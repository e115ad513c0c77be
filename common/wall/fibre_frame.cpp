#include "wall/fibre_frame.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/node_graph.hpp"
#include "fem/elements.hpp"
#include "linear/direct/direct_solver.hpp"
#include "wall/fibre_directions.hpp"

namespace fsi {

namespace {

/// Calls visit(cell numbers, number of filled lanes, geometry) for the elements of a part, in their order, a pack at a
/// time.
template <class Element, class Visit>
void for_each_pack(const Submesh<Element::dim, Element::order>& part, Visit visit) {
  const int count = static_cast<int>(part.cells.size());
  for (int first = 0; first < count; first += pack_width) {
    const int filled = std::min(pack_width, count - first);
    Vec3<Pack> x[Element::nodes]{};
    for (int lane = 0; lane < pack_width; ++lane)
      for (int a = 0; a < Element::nodes; ++a)
        for (int i = 0; i < 3; ++i) x[a][i].set(lane, part.nodes[part.cells[first + std::min(lane, filled - 1)][a]][i]);
    visit(first, filled, Element::geometry(x));
  }
}

/// (grad N_a, grad N_b) of the original nodes, symmetric.
struct Laplacian {
  NodeGraph graph;
  std::vector<double> values;  ///< per entry of the graph
};

template <class Element>
Laplacian laplacian_of(const Submesh<Element::dim, Element::order>& part) {
  constexpr int nodes = Element::nodes;
  std::vector<int> cell_nodes;
  cell_nodes.reserve(part.cells.size() * nodes);
  for (const auto& cell : part.cells)
    for (int node : cell) cell_nodes.push_back(part.original_of(node));
  Laplacian a{graph_of_cells(part.node_count(), cell_nodes, nodes), {}};
  a.values.assign(static_cast<std::size_t>(a.graph.blocks()), 0.0);
  for_each_pack<Element>(part, [&](int first, int filled, const auto& geometry) {
    Pack local[nodes][nodes] = {};
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      for (int i = 0; i < nodes; ++i)
        for (int k = 0; k < nodes; ++k) local[i][k] += g.weight * dot(g.vectors().gradient[i], g.vectors().gradient[k]);
    }
    for (int lane = 0; lane < filled; ++lane) {
      const int* cell = &cell_nodes[static_cast<std::size_t>(first + lane) * nodes];
      for (int i = 0; i < nodes; ++i)
        for (int k = 0; k < nodes; ++k) a.values[a.graph.find(cell[i], cell[k])] += local[i][k][lane];
    }
  });
  return a;
}

/// The potential that is 0 and 1 on the marked nodes.
std::vector<double> potential(const Laplacian& a, const PartNodes& part, const std::vector<char>& zero,
                              const std::vector<char>& one) {
  const int nodes = part.node_count();
  std::vector<double> field(nodes, 0.0);
  std::vector<int> row(nodes, -1);
  std::vector<int> free;
  for (int n = 0; n < nodes; ++n) {
    if (one[n] && !zero[n]) field[n] = 1;
    if (zero[n] || one[n] || part.original_of(n) != n || a.graph.offsets[n] == a.graph.offsets[n + 1]) continue;
    row[n] = static_cast<int>(free.size());
    free.push_back(n);
  }
  SparseMatrix matrix;
  matrix.offsets.push_back(0);
  std::vector<double> right(free.size(), 0.0), solution(free.size(), 0.0);
  for (std::size_t r = 0; r < free.size(); ++r) {
    for (int at = a.graph.offsets[free[r]]; at < a.graph.offsets[free[r] + 1]; ++at) {
      const int column = a.graph.columns[at];
      if (row[column] >= 0) {
        matrix.rows.push_back(row[column]);
        matrix.values.push_back(a.values[at]);
      } else {
        right[r] -= a.values[at] * field[column];
      }
    }
    matrix.offsets.push_back(matrix.nonzeros());
  }
  if (!free.empty()) {
    const OneDenseThread bits_for_any_number_of_threads;
    DirectSolver solver;
    solver.factorise(matrix);
    solver.solve(matrix, right, solution);
  }
  for (std::size_t r = 0; r < free.size(); ++r) field[free[r]] = solution[r];
  part.spread_to_copies(field);
  return field;
}

/// Solves A x = b in place, A symmetric and positive definite, by Cholesky's factors; the lower half of A is read.
template <int size>
void solve_dense(double (&a)[size][size], double (&b)[size]) {
  for (int j = 0; j < size; ++j) {
    for (int k = 0; k < j; ++k)
      for (int i = j; i < size; ++i) a[i][j] -= a[i][k] * a[j][k];
    const double pivot = std::sqrt(a[j][j]);
    for (int i = j; i < size; ++i) a[i][j] /= pivot;
  }
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (int i = size - 1; i >= 0; --i) {
    for (int k = i + 1; k < size; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
}

/// Gradients at the nodes, by least squares: of the quadratic polynomial through a node's value that is nearest to the
/// values of its neighbours and theirs, near ones counting more ([Zhang2005]). A linear element's own gradient is off
/// by the angle of its facets, which are not the wall's; this is of second order, at the boundary too. A polynomial
/// that the neighbours do not determine has small second derivatives.
template <class Element>
std::vector<Vec3<double>> nodal_slopes(const PartNodes& part, const NodeGraph& graph,
                                       const std::vector<double>& field) {
  constexpr int dim = Element::dim, terms = dim + dim * (dim + 1) / 2;
  std::vector<Vec3<double>> slopes(part.nodes.size(), Vec3<double>{{0, 0, 0}});
  std::vector<int> patch;
  for (int node = 0; node < part.node_count(); ++node) {
    if (part.original_of(node) != node || graph.offsets[node] == graph.offsets[node + 1]) continue;
    patch.clear();
    for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at) {
      const int near = graph.columns[at];
      patch.insert(patch.end(), &graph.columns[graph.offsets[near]], &graph.columns[graph.offsets[near + 1]]);
    }
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
    const auto squared_distance = [&](int other) {
      double sum = 0;
      for (int i : Element::axis) {
        const double x = part.nodes[other][i] - part.nodes[node][i];
        sum += x * x;
      }
      return sum;
    };
    double size_squared = 0;
    for (int other : patch) size_squared = std::max(size_squared, squared_distance(other));

    double matrix[terms][terms] = {}, right[terms] = {};
    for (int other : patch) {
      if (other == node) continue;
      double term[terms];
      for (int k = 0, next = dim; k < dim; ++k) {
        const auto along = [&](int axis) {
          return (part.nodes[other][Element::axis[axis]] - part.nodes[node][Element::axis[axis]]) /
                 std::sqrt(size_squared);
        };
        term[k] = along(k);
        for (int m = k; m < dim; ++m) term[next++] = along(k) * along(m);
      }
      const double weight = size_squared / squared_distance(other);
      for (int i = 0; i < terms; ++i) {
        for (int k = 0; k <= i; ++k) matrix[i][k] += weight * term[i] * term[k];
        right[i] += weight * term[i] * (field[other] - field[node]);
      }
    }
    constexpr double rounding = 1e-13, undetermined = 1e-9;
    double scale = 0;
    for (int i = 0; i < terms; ++i) scale += matrix[i][i];
    for (int i = 0; i < terms; ++i) matrix[i][i] += (i < dim ? rounding : undetermined) * scale;
    solve_dense(matrix, right);
    for (int k = 0; k < dim; ++k) slopes[node][Element::axis[k]] = right[k] / std::sqrt(size_squared);
  }
  part.spread_to_copies(slopes);
  return slopes;
}

}  // namespace

template <class Element>
FrameFields frame_fields(const Submesh<Element::dim, Element::order>& part, const FrameBoundary& boundary) {
  const Laplacian laplacian = laplacian_of<Element>(part);
  FrameFields fields;
  fields.radial = potential(laplacian, part, boundary.inner, boundary.outer);
  if (Element::dim == 3) fields.axial = potential(laplacian, part, boundary.start, boundary.end);
  if constexpr (Element::order == 1) {
    fields.radial_slope = nodal_slopes<Element>(part, laplacian.graph, fields.radial);
    if (Element::dim == 3) fields.axial_slope = nodal_slopes<Element>(part, laplacian.graph, fields.axial);
  }
  return fields;
}

LocalFrame frame_of(const Vec3<double>& radial_slope, const Vec3<double>& axial_slope) {
  constexpr double nothing = 1e-8;  // of a length, relative to the vector's own
  const auto length = [](const Vec3<double>& v) { return std::sqrt(dot(v, v)); };
  const auto axis = [](int i) {
    Vec3<double> e{{0, 0, 0}};
    e[i] = 1;
    return e;
  };
  LocalFrame frame;
  const double steepness = length(radial_slope);
  frame.radial = steepness > 0 ? (1 / steepness) * radial_slope : axis(0);
  Vec3<double> across = axial_slope - dot(axial_slope, frame.radial) * frame.radial;
  if (!(length(across) > nothing * length(axial_slope))) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(frame.radial[i]) < std::abs(frame.radial[least])) least = i;
    across = axis(least) - frame.radial[least] * frame.radial;
  }
  frame.axial = (1 / length(across)) * across;
  frame.circumferential = cross(frame.axial, frame.radial);
  return frame;
}

template <class Element>
FibreField<Element> fibre_directions(const ElementPacks<Element>& packs, const FrameFields& fields,
                                     const std::vector<std::array<int, Element::nodes>>& cells, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  FibreField<Element> all(packs.thread_count());
  for (int t = 0; t < packs.thread_count(); ++t)
    for (const auto& pack : packs.of_thread(t)) {
      all[t].emplace_back();
      for (int q = 0; q < Element::points; ++q) {
        const auto shapes = Element::at(pack.geometry, q).vectors();
        for (int lane = 0; lane < pack_width; ++lane) {
          const auto& cell = cells[pack.cell[lane]];
          const auto slope_of = [&](const std::vector<double>& field, const std::vector<Vec3<double>>& slopes) {
            Vec3<double> slope{{0, 0, 0}};
            for (int a = 0; a < Element::nodes; ++a)
              for (int i = 0; i < 3; ++i)
                slope[i] += slopes.empty() ? field[cell[a]] * shapes.gradient[a][i][lane]
                                           : shapes.value[a] * slopes[cell[a]][i];
            return slope;
          };
          const Vec3<double> radial = slope_of(fields.radial, fields.radial_slope);
          Vec3<double> axial{{0, 0, 1}};
          if constexpr (Element::dim == 3) axial = slope_of(fields.axial, fields.axial_slope);
          if constexpr (Element::axisymmetric) axial = cross(radial, Vec3<double>{{0, 1, 0}});
          const LocalFrame frame = frame_of(radial, axial);
          const Vec3<double> around = cosine * frame.circumferential, along = sine * frame.axial;
          const std::array<Vec3<double>, 2> directions{around + along, around - along};
          for (int family = 0; family < 2; ++family)
            for (int i = 0; i < 3; ++i) all[t].back()[q].direction[family][i].set(lane, directions[family][i]);
        }
      }
    }
  return all;
}

#define FSI_INSTANTIATE(Element)                                                                                  \
  template FrameFields frame_fields<Element>(const Submesh<Element::dim, Element::order>&, const FrameBoundary&); \
  template FibreField<Element> fibre_directions<Element>(const ElementPacks<Element>&, const FrameFields&,        \
                                                         const std::vector<std::array<int, Element::nodes>>&, double);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
