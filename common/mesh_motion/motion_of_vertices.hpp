#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mesh/submesh.hpp"
#include "mesh_motion/mesh_motion.hpp"

namespace fsi {

/// Harmonic mesh motion, plain or stiffened, on quadratic elements of the fluid (docs/theory.md, section 6): vertices
/// move as those of linear elements on them would, and a node in the middle of an edge by the mean of its ends, so that
/// it keeps its distance from the straight edge; on the boundary it is given like any other node. About an eighth of
/// the unknowns of a quadratic motion in three dimensions, a quarter in two; a quadratic one would be no better, since
/// the mesh needs no accuracy of its own. The edges' rows come from 1/2 w |d_e - (d_a + d_b)/2|^2, w > 0: the operator
/// is symmetric, and what is sought does not depend on w.
template <class Element>
class MotionOfVertices : public MeshMotion<Element::components> {
 public:
  static constexpr int n = Element::components;
  using Part = Submesh<Element::dim, Element::order>;

  /// \param part, packs  of the fluid, must outlive this
  MotionOfVertices(const Part& part, const ElementPacks<Element>& packs, std::vector<double> stiffness = {});
  std::shared_ptr<const NodeGraph> graph() const override { return graph_; }
  void assemble(MeshMotionMatrix<n>& matrix) const override;
  AssemblyResult smallest_volume_ratio(const std::vector<double>& mesh) const override {
    return fsi::smallest_volume_ratio(packs_, mesh);
  }

 private:
  const Part& part_;
  const ElementPacks<Element>& packs_;
  std::shared_ptr<const NodeGraph> graph_;
  std::vector<double> stiffness_;
};

/// MotionOfAllNodes for linear elements, MotionOfVertices for quadratic ones.
/// \param part, packs  of the fluid, must outlive it
/// \param graph        of nodes that share a cell; quadratic elements make their own
/// \param stiffness    k of each cell (stiffening.hpp); empty: 1
template <class Element>
std::unique_ptr<MeshMotion<Element::components>> harmonic_mesh_motion(const Submesh<Element::dim, Element::order>& part,
                                                                      const ElementPacks<Element>& packs,
                                                                      const std::shared_ptr<const NodeGraph>& graph,
                                                                      std::vector<double> stiffness = {}) {
  if constexpr (Element::order == 1)
    return std::make_unique<MotionOfAllNodes<Element>>(packs, graph, std::move(stiffness));
  else
    return std::make_unique<MotionOfVertices<Element>>(part, packs, std::move(stiffness));
}

}  // namespace fsi
