#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "algebra/block_products.hpp"
#include "algebra/sparse_matrix.hpp"
#include "fem/nodal_layout.hpp"
#include "monolithic/coupled_solvers/block/coupled_vector.hpp"

namespace fsi {

/// The paper's coupled matrix ([Langer2018], section 3.4; docs/theory.md, section 9.2) of one level, n components of a
/// vector,
///
///       [ Am   0    Ams ]   mesh motion:  d_m per fluid node; boundary: identity rows; interface: d_m - d_s = 0
///   K = [ Afm  Af   Afs ]   flow:         (u, p_f) per fluid node; momentum rows of the interface sum fluid and wall
///       [ 0    Asf  As  ]   wall:         (d_s, p_s) per wall node; -u + d_s / period = 0 on the interface
///
/// Entries without unknown (Dirichlet) have identity rows and zero columns. The interface conditions tie all components
/// of two vectors alike, so Ams and Asf hold one number per pair of nodes: -1 on the finest level. `period` is that of
/// InterfaceKinematics. The blocks are not owned and must outlive this: on the finest level CoupledSystem has them, on
/// coarse levels CoupledMultigrid and the hierarchies of its sub-problems.
template <int n>
struct CoupledMatrix {
  const BlockMatrix<1, n>* mesh = nullptr;                              ///< Am, one number per component
  const BlockMatrix<1, 1>* mesh_wall = nullptr;                         ///< Ams: fluid nodes x wall nodes
  const BlockMatrix<MixedLayout<n>::entries, n>* fluid_mesh = nullptr;  ///< Afm
  const BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>* fluid = nullptr;  ///< Af
  const BlockMatrix<n, MixedLayout<n>::entries>* fluid_wall =
      nullptr;                                    ///< Afs, momentum rows only: fluid nodes x wall nodes
  const BlockMatrix<1, 1>* wall_fluid = nullptr;  ///< Asf: wall nodes x fluid nodes
  const BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>* wall = nullptr;  ///< As

  int mesh_nodes() const { return mesh->graph->rows(); }  ///< as many as fluid nodes on the finest level
  int fluid_nodes() const { return fluid->graph->rows(); }
  int wall_nodes() const { return wall->graph->rows(); }
  CoupledVector zero_vector() const {
    return {std::vector<double>(static_cast<std::size_t>(mesh_nodes()) * n, 0.0),
            std::vector<double>(MixedLayout<n>::size(fluid_nodes()), 0.0),
            std::vector<double>(MixedLayout<n>::size(wall_nodes()), 0.0)};
  }

  // Products with one block, y -= A x.
  void subtract_mesh(const std::vector<double>& d_m, std::vector<double>& y) const {
    multiply_add_components<n>(*mesh, d_m, y, -1);
  }
  void subtract_mesh_wall(const std::vector<double>& s, std::vector<double>& y) const {
    subtract_tie<n, MixedLayout<n>::entries>(*mesh_wall, s, y);
  }
  void subtract_fluid(const std::vector<double>& f, std::vector<double>& y) const { multiply_subtract(*fluid, f, y); }
  void subtract_fluid_mesh(const std::vector<double>& d_m, std::vector<double>& y) const {
    multiply_subtract(*fluid_mesh, d_m, y);
  }
  /// Most rows are empty: nodes off the interface.
  void subtract_fluid_wall(const std::vector<double>& s, std::vector<double>& y) const {
    const auto& graph = *fluid_wall->graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > serial_blocks)
    for (int row = 0; row < graph.rows(); ++row) {
      double* to = y.data() + MixedLayout<n>::vector(row);
      for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at) {
        const double* block = fluid_wall->block(at);
        const double* from = s.data() + MixedLayout<n>::vector(graph.columns[at]);
        for (int r = 0; r < n; ++r)
          for (int c = 0; c <= n; ++c) to[r] -= block[MixedLayout<n>::in_block(r, c)] * from[c];
      }
    }
  }
  void subtract_wall_fluid(const std::vector<double>& f, std::vector<double>& y) const {
    subtract_tie<MixedLayout<n>::entries, MixedLayout<n>::entries>(*wall_fluid, f, y);
  }
  void subtract_wall(const std::vector<double>& s, std::vector<double>& y) const {
    multiply_subtract(*wall, s, y);
  }

  // Residuals of the three block rows, r = b - K x.
  void mesh_residual(const CoupledVector& b, const CoupledVector& x, std::vector<double>& r) const {
    r = b.mesh;
    subtract_mesh(x.mesh, r);
    subtract_mesh_wall(x.wall, r);
  }
  void fluid_residual(const CoupledVector& b, const CoupledVector& x, std::vector<double>& r) const {
    r = b.fluid;
    subtract_fluid_mesh(x.mesh, r);
    subtract_fluid(x.fluid, r);
    subtract_fluid_wall(x.wall, r);
  }
  void wall_residual(const CoupledVector& b, const CoupledVector& x, std::vector<double>& r) const {
    r = b.wall;
    subtract_wall_fluid(x.fluid, r);
    subtract_wall(x.wall, r);
  }
  void residual(const CoupledVector& b, const CoupledVector& x, CoupledVector& r) const {
    mesh_residual(b, x, r.mesh);
    fluid_residual(b, x, r.fluid);
    wall_residual(b, x, r.wall);
  }

  /// Stored numbers.
  std::int64_t nonzeros() const {
    return static_cast<std::int64_t>(mesh->values.size() + fluid->values.size() + fluid_mesh->values.size() +
                                     fluid_wall->values.size() + wall->values.size() + mesh_wall->values.size() +
                                     wall_fluid->values.size());
  }
  double memory_mib() const {
    return 8.0 * static_cast<double>(nonzeros()) / (1 << 20);
  }

 private:
  /// y -= A x on the vectors of nodes with RowEntries and ColumnEntries numbers each.
  template <int RowEntries, int ColumnEntries>
  static void subtract_tie(const BlockMatrix<1, 1>& a, const std::vector<double>& x, std::vector<double>& y) {
    const auto& graph = *a.graph;
    for (int row = 0; row < graph.rows(); ++row)
      for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
        for (int k = 0; k < n; ++k)
          y[static_cast<std::size_t>(row) * RowEntries + k] -=
              a.values[at] * x[static_cast<std::size_t>(graph.columns[at]) * ColumnEntries + k];
  }
};

/// The whole of K for direct solvers and tests, unknowns as flatten() puts them; entries that are zero are left out.
template <int n>
SparseMatrix sparse_matrix(const CoupledMatrix<n>& k) {
  struct Entry {
    std::int64_t row;
    double value;
  };
  const std::int64_t fluid0 = static_cast<std::int64_t>(k.mesh_nodes()) * n,
                     wall0 = fluid0 + static_cast<std::int64_t>(MixedLayout<n>::size(k.fluid_nodes())),
                     size = wall0 + static_cast<std::int64_t>(MixedLayout<n>::size(k.wall_nodes()));
  std::vector<std::vector<Entry>> columns(static_cast<std::size_t>(size));
  const auto put = [&](std::int64_t row, std::int64_t column, double value) {
    if (value != 0) columns[static_cast<std::size_t>(column)].push_back({row, value});
  };
  // Row by row, the block rows in turn: the rows of each column come out in ascending order.
  const auto put_blocks = [&](const auto& matrix, std::int64_t row0, int row_stride, std::int64_t column0, int node) {
    const auto& graph = *matrix.graph;
    using Matrix = std::decay_t<decltype(matrix)>;
    for (int r = 0; r < Matrix::rows; ++r)
      for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at)
        for (int c = 0; c < Matrix::columns; ++c)
          put(row0 + static_cast<std::int64_t>(node) * row_stride + r,
              column0 + static_cast<std::int64_t>(graph.columns[at]) * Matrix::columns + c,
              matrix.block(at)[r * Matrix::columns + c]);
  };
  // Ties: the same number for the n components of two nodes.
  const auto put_tie = [&](const BlockMatrix<1, 1>& tie, std::int64_t row, std::int64_t column0, int node, int c) {
    const auto& graph = *tie.graph;
    for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at)
      put(row, column0 + static_cast<std::int64_t>(MixedLayout<n>::vector(graph.columns[at], c)), tie.values[at]);
  };
  for (int a = 0; a < k.mesh_nodes(); ++a)
    for (int c = 0; c < n; ++c) {
      const auto& graph = *k.mesh->graph;
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
        put(static_cast<std::int64_t>(VectorLayout<n>::vector(a, c)),
            static_cast<std::int64_t>(VectorLayout<n>::vector(graph.columns[at], c)), k.mesh->block(at)[c]);
      put_tie(*k.mesh_wall, static_cast<std::int64_t>(VectorLayout<n>::vector(a, c)), wall0, a, c);
    }
  for (int a = 0; a < k.fluid_nodes(); ++a) {
    put_blocks(*k.fluid_mesh, fluid0, MixedLayout<n>::entries, 0, a);
    put_blocks(*k.fluid, fluid0, MixedLayout<n>::entries, fluid0, a);
    put_blocks(*k.fluid_wall, fluid0, MixedLayout<n>::entries, wall0, a);
  }
  for (int a = 0; a < k.wall_nodes(); ++a) {
    for (int c = 0; c < n; ++c)
      put_tie(*k.wall_fluid, wall0 + static_cast<std::int64_t>(MixedLayout<n>::vector(a, c)), fluid0, a, c);
    put_blocks(*k.wall, wall0, MixedLayout<n>::entries, wall0, a);
  }
  SparseMatrix matrix;
  matrix.offsets.assign(1, 0);
  for (const auto& column : columns) {
    for (const auto& entry : column) {
      matrix.rows.push_back(entry.row);
      matrix.values.push_back(entry.value);
    }
    matrix.offsets.push_back(static_cast<std::int64_t>(matrix.rows.size()));
  }
  return matrix;
}

}  // namespace fsi
