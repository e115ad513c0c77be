#pragma once

#include <vector>

#include "algebra/block_products.hpp"
#include "algebra/direct_solver.hpp"
#include "system/linear_solver.hpp"

namespace fsi {

/// The mesh motion's equations, solved exactly. Their matrix is constant and, the components not coupling, one scalar
/// matrix for each distinct component: factorised once, or as often as the scene assembles it.
template <class Element>
class HarmonicExtension {
 public:
  static constexpr int n = Element::components;

  explicit HarmonicExtension(const JacobianBlocks<Element>& blocks) : scene_(blocks.scene), matrix_(*blocks.mesh) {
    const auto& graph = *matrix_.graph;
    const auto& numbering = blocks.numbering;
    // Equations of the mesh motion exist at its inner nodes only.
    inner_.assign(graph.rows(), -1);
    for (int a = 0; a < graph.rows(); ++a)
      if (numbering.mesh_rows[static_cast<std::size_t>(a) * n].index >= 0) inner_[a] = inner_nodes_++;
    factorise();
    values_.resize(static_cast<std::size_t>(graph.rows()) * n);
    rows_ = values_;
  }

  /// Sets the inner values of `field` (n numbers per fluid node) so that the rows of A field at inner nodes equal
  /// `right` there; the other values of `field` are given.
  void solve(const std::vector<double>& right, std::vector<double>& field) {
    if (factorised_ != scene_.mesh_motion_assemblies) factorise();
    for (int a = 0; a < matrix_.graph->rows(); ++a)
      for (int k = 0; k < n; ++k) {
        const std::size_t i = static_cast<std::size_t>(a) * n + k;
        values_[i] = inner_[a] >= 0 ? 0 : field[i];
      }
    multiply_components<n>(matrix_, values_, rows_);
    if (inner_nodes_ == 0) return;
    for (int solver = 0; solver < n; ++solver) {  // all components of one matrix at once
      right_.clear();
      for (int k = 0; k < n; ++k) {
        if (solver_of_[k] != solver) continue;
        right_.emplace_back(inner_nodes_);
        for (int a = 0; a < matrix_.graph->rows(); ++a)
          if (inner_[a] >= 0) {
            const std::size_t i = static_cast<std::size_t>(a) * n + k;
            right_.back()[inner_[a]] = right[i] - rows_[i];
          }
      }
      if (right_.empty()) continue;
      solvers_[solver].solve_each(scalars_[solver], right_, solution_);
      std::size_t next = 0;
      for (int k = 0; k < n; ++k) {
        if (solver_of_[k] != solver) continue;
        const auto& solution = solution_[next++];
        for (int a = 0; a < matrix_.graph->rows(); ++a)
          if (inner_[a] >= 0) field[static_cast<std::size_t>(a) * n + k] = solution[inner_[a]];
      }
    }
  }

  double memory_mib() const {
    double bytes = 0;
    for (int k = 0; k < n; ++k)
      if (solver_of_[k] == k) bytes += 16.0 * static_cast<double>(solvers_[k].factor_nonzeros());
    return bytes / (1 << 20);
  }

 private:
  void factorise() {
    for (int k = 0; k < n; ++k) {
      solver_of_[k] = k;
      for (int earlier = 0; earlier < k && solver_of_[k] == k; ++earlier)
        if (same_component(earlier, k)) solver_of_[k] = solver_of_[earlier];
      if (solver_of_[k] == k) factorise(k);
    }
    factorised_ = scene_.mesh_motion_assemblies;
    scene_.profile.count("mesh motion factorisations");
  }

  bool same_component(int i, int k) const {
    for (int at = 0; at < matrix_.graph->blocks(); ++at)
      if (matrix_.block(at)[i] != matrix_.block(at)[k]) return false;
    return true;
  }

  void factorise(int component) {
    // The matrix is symmetric: its rows serve as columns.
    const auto& graph = *matrix_.graph;
    SparseMatrix& a = scalars_[component];
    a = {};
    a.offsets = {0};
    for (int row = 0; row < graph.rows(); ++row) {
      if (inner_[row] < 0) continue;
      for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
        if (inner_[graph.columns[at]] >= 0) {
          a.rows.push_back(inner_[graph.columns[at]]);
          a.values.push_back(matrix_.block(at)[component]);
        }
      a.offsets.push_back(static_cast<std::int64_t>(a.rows.size()));
    }
    solvers_[component] = DirectSolver();
    if (inner_nodes_ > 0) solvers_[component].factorise(a);
  }

  const Scene<Element>& scene_;
  const MeshMotionMatrix<Element>& matrix_;
  int factorised_ = 0;      ///< the assembly whose operator it is
  std::vector<int> inner_;  ///< per fluid node, its row; -1 where the displacement is given
  int inner_nodes_ = 0;
  int solver_of_[n] = {};
  SparseMatrix scalars_[n];
  DirectSolver solvers_[n];
  std::vector<std::vector<double>> right_, solution_;  ///< by component
  std::vector<double> values_, rows_;
};

}  // namespace fsi
