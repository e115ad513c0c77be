#include "sampling/harmonic_coordinate.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "algebra/csr_matrix.hpp"
#include "algebra/node_graph.hpp"
#include "base/error.hpp"
#include "linear/amg/scalar_multigrid.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double tolerance = 1e-10;  // residual relative to that of zero inner values
constexpr int most_iterations = 500;

/// Volume times gradients of the barycentric coordinates of a simplex, and its volume: mm^2 and mm^3 (mm and mm^2).
template <int Dim>
double gradients(const std::array<Point, Dim + 1>& x, std::array<Point, Dim + 1>& g) {
  g[0] = {0, 0, 0};
  if constexpr (Dim == 3) {
    const Point a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    g[1] = (1.0 / 6) * cross(b, c);
    g[2] = (1.0 / 6) * cross(c, a);
    g[3] = (1.0 / 6) * cross(a, b);
  } else {
    const Point a = x[1] - x[0], b = x[2] - x[0], normal = cross(a, b);
    const double twice = norm(normal);
    g[1] = (0.5 / twice) * cross(b, normal);
    g[2] = (0.5 / twice) * cross(normal, a);
  }
  for (int i = 1; i <= Dim; ++i) g[0] = g[0] - g[i];
  return std::abs(simplex_volume<Dim>(x.data()));
}

/// Stiffness matrix of linear elements between all nodes.
template <int Dim>
CsrMatrix<double> laplacian(const std::vector<Point>& nodes, const std::vector<int>& vertices, bool turned) {
  const NodeGraph graph = graph_of_cells(static_cast<int>(nodes.size()), vertices, Dim + 1);
  CsrMatrix<double> a{graph.rows(), graph.offsets, graph.columns, std::vector<double>(graph.columns.size(), 0.0)};
  std::array<Point, Dim + 1> x, g;
  for (std::size_t cell = 0; cell * (Dim + 1) < vertices.size(); ++cell) {
    const int* of_cell = vertices.data() + cell * (Dim + 1);
    double weight = turned ? 0 : 1;
    for (int i = 0; i <= Dim; ++i) {
      x[i] = nodes[of_cell[i]];
      if (turned) weight += x[i][0] / (Dim + 1);
    }
    const double volume = gradients<Dim>(x, g);
    for (int i = 0; i <= Dim; ++i)
      for (int j = 0; j <= Dim; ++j) a.values[graph.find(of_cell[i], of_cell[j])] += weight * dot(g[i], g[j]) / volume;
  }
  return a;
}

/// The rows and columns whose nodes are unknowns. \param unknown  their numbers, per node; negative: none
CsrMatrix<double> inner_part(const CsrMatrix<double>& a, const std::vector<int>& unknown, int count) {
  CsrMatrix<double> inner;
  inner.columns = count;
  for (int row = 0; row < a.rows(); ++row) {
    if (unknown[row] < 0) continue;
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      if (const int column = unknown[a.indices[at]]; column >= 0) {
        inner.indices.push_back(column);
        inner.values.push_back(a.values[at]);
      }
    inner.offsets.push_back(static_cast<int>(inner.indices.size()));
  }
  return inner;
}

void multiply(const CsrMatrix<double>& a, const std::vector<double>& x, std::vector<double>& y) {
  for (int row = 0; row < a.rows(); ++row) {
    double sum = 0;
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) sum += a.values[at] * x[a.indices[at]];
    y[row] = sum;
  }
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Conjugate gradients around a multigrid cycle; beta = z . (r - r_old) / rho_old tolerates that the preconditioner
/// works in single precision.
std::vector<double> solve(const CsrMatrix<double>& a, const std::vector<double>& right) {
  const std::size_t size = right.size();
  ScalarMultigrid multigrid;
  ScalarMultigrid::Options options;
  options.post_smoothing = true;  // conjugate gradients need a symmetric cycle
  multigrid.set_up(a, options);
  std::vector<double> x(size, 0.0), r(right), p(size, 0.0), q(size), z(size), r_old(size);
  std::vector<float> single_r(size), single_z(size);
  const double reference = std::sqrt(product(right, right));
  double rho = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double residual = std::sqrt(product(r, r));
    if (residual <= tolerance * reference) return x;
    // Scaled, so that small residuals do not underflow in single precision.
    for (std::size_t i = 0; i < size; ++i) single_r[i] = static_cast<float>(r[i] / residual);
    multigrid.cycle(single_r, single_z);
    for (std::size_t i = 0; i < size; ++i) z[i] = residual * static_cast<double>(single_z[i]);
    const double next = product(z, r), beta = iteration == 0 ? 0 : (next - product(z, r_old)) / rho;
    rho = next;
    for (std::size_t i = 0; i < size; ++i) p[i] = z[i] + beta * p[i];
    multiply(a, p, q);
    const double alpha = rho / product(p, q);
    r_old = r;
    for (std::size_t i = 0; i < size; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
  }
  throw ConvergenceError("the harmonic coordinate between two openings was not found",
                         "a mesh with better shaped cells");
}

}  // namespace

template <int Dim>
std::vector<double> harmonic_coordinate(const std::vector<Point>& nodes, const std::vector<int>& vertices,
                                        const std::vector<int>& low, const std::vector<int>& high, bool turned) {
  std::vector<double> h(nodes.size(), 0.0);
  std::vector<int> unknown(nodes.size(), -1);
  for (const int node : vertices) unknown[node] = 0;
  for (const int node : low) unknown[node] = -1;
  for (const int node : high) {
    unknown[node] = -1;
    h[node] = 1;
  }
  int count = 0;
  for (int& number : unknown)
    if (number == 0) number = count++;
  if (count == 0) return h;
  const auto a = laplacian<Dim>(nodes, vertices, turned);
  std::vector<double> given(nodes.size()), right(count);
  multiply(a, h, given);
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (unknown[node] >= 0) right[unknown[node]] = -given[node];
  const auto inner = solve(inner_part(a, unknown, count), right);
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (unknown[node] >= 0) h[node] = inner[unknown[node]];
  return h;
}

template std::vector<double> harmonic_coordinate<2>(const std::vector<Point>&, const std::vector<int>&,
                                                    const std::vector<int>&, const std::vector<int>&, bool);
template std::vector<double> harmonic_coordinate<3>(const std::vector<Point>&, const std::vector<int>&,
                                                    const std::vector<int>&, const std::vector<int>&, bool);

}  // namespace fsi
