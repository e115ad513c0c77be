#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/assembly_result.hpp"
#include "fem/element_packs.hpp"
#include "mesh_motion/mesh_motion.hpp"
#include "mesh_motion/pseudo_solid.hpp"

namespace fsi {

/// The derivative of the rows of a mesh motion whose components couple, by the mesh displacement.
template <int n>
using MeshMotionTangent = BlockMatrix<n, n>;

/// What moves the mesh of the fluid by equations that are not linear in its displacement.
template <int n>
class NonlinearMeshMotion {
 public:
  virtual ~NonlinearMeshMotion() = default;
  /// The graph that its tangent is stored on.
  virtual std::shared_ptr<const NodeGraph> graph() const = 0;
  /// Overwrites the rows at the mesh displacement, both in the vector layout and without boundary conditions, and the
  /// tangent where one is passed. \returns the smallest J and where it is; rows count only where it is positive
  virtual AssemblyResult assemble(const std::vector<double>& mesh, std::vector<double>& residual,
                                  MeshMotionTangent<n>* tangent = nullptr) const = 0;
  /// The smallest J of a mesh displacement and where it is.
  virtual AssemblyResult smallest_volume_ratio(const std::vector<double>& mesh) const = 0;
};

/// The pseudo-solid on the elements of the fluid, which must outlive it.
template <class Element>
class ElasticMeshMotion : public NonlinearMeshMotion<Element::components> {
 public:
  static constexpr int n = Element::components;

  /// \param stiffness  k of each cell (stiffening.hpp)
  ElasticMeshMotion(const ElementPacks<Element>& packs, std::shared_ptr<const NodeGraph> graph, const PseudoSolid& form,
                    std::vector<double> stiffness)
      : packs_(packs), graph_(std::move(graph)), form_(form), stiffness_(std::move(stiffness)) {}

  std::shared_ptr<const NodeGraph> graph() const override { return graph_; }
  AssemblyResult assemble(const std::vector<double>& mesh, std::vector<double>& residual,
                          MeshMotionTangent<n>* tangent = nullptr) const override;
  AssemblyResult smallest_volume_ratio(const std::vector<double>& mesh) const override {
    return fsi::smallest_volume_ratio(packs_, mesh);
  }

 private:
  const ElementPacks<Element>& packs_;
  std::shared_ptr<const NodeGraph> graph_;
  PseudoSolid form_;
  std::vector<double> stiffness_;
};

}  // namespace fsi
