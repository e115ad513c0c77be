#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "linear/interface/linear_solver.hpp"
#include "monolithic/coupled_solvers/block/coupled_matrix.hpp"

namespace fsi {

/// What is prescribed in the coupled system, one flag for each component of each node's vector.
struct CoupledConstraints {
  std::vector<char> mesh_fixed;      ///< d_m = 0, or equal to d_s
  std::vector<char> velocity_fixed;  ///< u = 0
  std::vector<char> wall_fixed;      ///< d_s = 0, or tied to u
};

/// Nodes of which all n components are flagged.
template <int n>
std::vector<char> whole_nodes(const std::vector<char>& components) {
  std::vector<char> nodes(components.size() / n, 1);
  for (std::size_t i = 0; i < components.size(); ++i) nodes[i / n] = nodes[i / n] && components[i];
  return nodes;
}

/// The paper's K x = b made from the Jacobian of a scene, whose numbering has one unknown on the interface: the matrix,
/// and the conversion of right-hand sides and solutions. Fluid and wall must both be there.
template <int n>
class CoupledSystem {
 public:
  explicit CoupledSystem(const JacobianBlocks<n>& blocks);

  CoupledSystem(const CoupledSystem&) = delete;  // the matrix refers to its blocks
  CoupledSystem& operator=(const CoupledSystem&) = delete;

  const CoupledMatrix<n>& matrix() const { return k_; }
  const CoupledConstraints& constraints() const { return constraints_; }
  /// The interface nodes that can move.
  const std::vector<InterfacePair>& interface() const { return interface_; }

  /// Takes over the values that the block matrices hold now.
  void update();

  /// Takes over the mesh motion's operator alone.
  void update_mesh_motion();

  /// b of K from b of the numbering: mesh, flow and wall equations to their rows. Identity rows are zero, and so are
  /// the wall's rows on the interface, whose equations are in the flow's rows.
  void expand(const std::vector<double>& condensed, CoupledVector& b) const;

  /// x of the numbering, `numbering.size` entries, from x of K: on the interface the wall's displacement.
  void compress(const CoupledVector& x, std::vector<double>& condensed) const;

 private:
  /// Minus the identity between each node and its partner, if it has one.
  static BlockMatrix<1, 1> tie(const std::vector<int>& partner);

  template <class Matrix>
  static void copy(const Matrix& from, Matrix& to) {
    const auto size = static_cast<std::ptrdiff_t>(from.values.size());
#pragma omp parallel for schedule(static) if (size > 100000)
    for (std::ptrdiff_t i = 0; i < size; ++i) to.values[i] = from.values[i];
  }

  /// Flags of the vector entries that have no unknown, n for each node of a map with `entries` numbers a node.
  static std::vector<char> without_unknown(const UnknownMap& map, int entries);
  /// Nodes whose scalar has no unknown.
  static std::vector<int> without_scalar(const UnknownMap& map);

  /// Vector rows of `fixed_rows` become diagonal, vector columns of `zero_columns` vanish elsewhere: n flags a node.
  /// The diagonal is asked for by the flag's place.
  template <int Rows, int Columns, class Diagonal>
  static void impose(BlockMatrix<Rows, Columns>& matrix, const std::vector<char>& fixed_rows,
                     const std::vector<char>& zero_columns, Diagonal diagonal) {
    const auto& graph = *matrix.graph;
#pragma omp parallel for schedule(static) if (graph.blocks() > 50000)
    for (int a = 0; a < graph.rows(); ++a)
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at) {
        double* block = matrix.block(at);
        const std::size_t row = static_cast<std::size_t>(a) * n,
                          column = static_cast<std::size_t>(graph.columns[at]) * n;
        for (int c = 0; c < n; ++c)
          if (zero_columns[column + c])
            for (int r = 0; r < Rows; ++r) block[r * Columns + c] = 0;
        for (int r = 0; r < n; ++r) {
          if (!fixed_rows[row + r]) continue;
          for (int c = 0; c < Columns; ++c) block[r * Columns + c] = 0;
          if (graph.columns[at] == a) block[r * Columns + r] = diagonal(row + r);
        }
      }
  }

  /// Identity rows and zero columns for scalars without unknown.
  static void impose_scalars(BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>& matrix,
                             const std::vector<int>& nodes);

  void impose_diagonal();

  JacobianBlocks<n> blocks_;
  BlockMatrix<1, n> mesh_;
  BlockMatrix<1, 1> mesh_wall_, wall_fluid_;
  BlockMatrix<MixedLayout<n>::entries, n> fluid_mesh_;
  BlockMatrix<n, MixedLayout<n>::entries> fluid_wall_;
  BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries> fluid_, wall_;
  CoupledMatrix<n> k_;
  CoupledConstraints constraints_;
  std::vector<InterfacePair> interface_;
  std::vector<char> wall_zero_, mesh_zero_, fixed_tractions_;  ///< n flags a node
  std::vector<int> no_pressure_, no_wall_pressure_;            ///< nodes without
  std::vector<int> traction_;                                  ///< position in the wall's matrix of each block of Afs
};

}  // namespace fsi
