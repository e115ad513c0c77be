#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/assembly_result.hpp"
#include "fem/element_packs.hpp"
#include "fem/nodal_layout.hpp"
#include "host/parallel_for.hpp"

namespace fsi {

/// The operator of the mesh motion: components do not couple, each node pair holds one number per component. Constant,
/// so assembled once, unless a case wants to see what that saves.
template <int n>
using MeshMotionMatrix = BlockMatrix<1, n>;

/// What moves the mesh of the fluid between its boundaries, by linear equations.
template <int n>
class MeshMotion {
 public:
  virtual ~MeshMotion() = default;
  /// That the operator is stored on.
  virtual std::shared_ptr<const NodeGraph> graph() const = 0;
  /// Overwrites the operator, without boundary conditions.
  virtual void assemble(MeshMotionMatrix<n>& matrix) const = 0;
  /// The smallest J of a mesh displacement, in the vector layout, and where it is.
  virtual AssemblyResult smallest_volume_ratio(const std::vector<double>& mesh) const = 0;
};

/// Assembles the operator of the harmonic mesh motion, without boundary conditions.
/// \tparam Element    a linear one
/// \param stiffness   k of each cell (stiffening.hpp); empty: 1
/// \param diagonals   n numbers a cell, set to the mean of the diagonal entries that its vertices get from it; null: not
///                    wanted
template <class Element>
void assemble_mesh_motion(const ElementPacks<Element>& packs, MeshMotionMatrix<Element::components>& matrix,
                          const std::vector<double>& stiffness = {}, std::vector<double>* diagonals = nullptr);

/// The smallest J of a mesh displacement at a quadrature point.
template <class Element>
AssemblyResult smallest_volume_ratio(const ElementPacks<Element>& packs, const std::vector<double>& mesh);

/// Harmonic mesh motion, plain or stiffened, on linear elements of the fluid, which must outlive it.
template <class Element>
class MotionOfAllNodes : public MeshMotion<Element::components> {
 public:
  static constexpr int n = Element::components;

  /// \param graph  of nodes that share a cell
  MotionOfAllNodes(const ElementPacks<Element>& packs, std::shared_ptr<const NodeGraph> graph,
                   std::vector<double> stiffness = {})
      : packs_(packs), graph_(std::move(graph)), stiffness_(std::move(stiffness)) {}
  std::shared_ptr<const NodeGraph> graph() const override { return graph_; }
  void assemble(MeshMotionMatrix<n>& matrix) const override { assemble_mesh_motion(packs_, matrix, stiffness_); }
  AssemblyResult smallest_volume_ratio(const std::vector<double>& mesh) const override {
    return fsi::smallest_volume_ratio(packs_, mesh);
  }

 private:
  const ElementPacks<Element>& packs_;
  std::shared_ptr<const NodeGraph> graph_;
  std::vector<double> stiffness_;
};

/// r = A d, both in the vector layout.
template <int n>
void multiply_mesh_motion(const MeshMotionMatrix<n>& matrix, const std::vector<double>& d, std::vector<double>& r) {
  const auto& graph = *matrix.graph;
  parallel_for(graph.rows(), graph.blocks() > 200000, [&](int row) {
    double sum[n] = {};
    for (int at = graph.offsets[row]; at < graph.offsets[row + 1]; ++at)
      for (int k = 0; k < n; ++k) sum[k] += matrix.block(at)[k] * d[VectorLayout<n>::vector(graph.columns[at], k)];
    for (int k = 0; k < n; ++k) r[VectorLayout<n>::vector(row, k)] = sum[k];
  });
}

}  // namespace fsi
