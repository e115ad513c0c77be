#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "fem/nodal_frames.hpp"
#include "mesh_motion/tangent_extension.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// How a nonlinear mesh motion is solved by itself.
struct MeshFollowerOptions {
  double tolerance = 1e-11;        ///< of the last increment, relative to the displacement
  double keep_contraction = 0.2;   ///< a tangent serves while an iteration contracts increments by this
  int max_iterations = 20;         ///< of Newton's method on one stretch of the way
  int max_halvings = 20;           ///< of the way
  TangentExtensionOptions linear;  ///< of each linear solve; on a shared mesh only the tolerance is used
};

/// Where the mesh is shared out among processes: how, and what solves the tangent's equations of all of them.
template <int n>
struct SharedMesh {
  const NodeShare* share = nullptr;  ///< null: the mesh is whole here
  std::function<std::unique_ptr<MeshExtension<n>>(const MeshMotionTangent<n>& tangent, std::vector<char> inner)>
      make_extension = {};
};

/// Takes a mesh of a nonlinear motion along with its boundary. Newton's method starts from the tangent's response to
/// the boundary's motion; where that folds an element, or the iteration fails, the way is gone in halves. So a motion
/// is followed as long as the boundary can go straight to its target without a folded mesh and halvings are left.
template <int n>
class MeshFollower {
 public:
  /// \param motion  must outlive this, and so must `frames`
  /// \param inner   per node and component: its value is sought; at nodes with a frame components are the frame's.
  ///                Where the mesh is shared out, right at ghosts too
  /// \param frames  null: none
  /// \param shared  its share must outlive this
  MeshFollower(const NonlinearMeshMotion<n>& motion, std::vector<char> inner, const NodalFrames<n>* frames = nullptr,
               const MeshFollowerOptions& options = {}, const SharedMesh<n>& shared = {});

  /// Moves `mesh`, an unfolded field along the axes of space, to where its given values are those of `target`.
  /// \throws ConvergenceError when there is no way; `mesh` is then as it was
  void follow(const std::vector<double>& target, std::vector<double>& mesh);
  /// The next call makes a tangent of its own, so that its result does not depend on those before.
  void forget() { linearised_ = false; }
  /// No element of the mesh is inverted, at any process. By all processes together.
  bool unfolded(const std::vector<double>& mesh);

  int tangents() const { return tangents_; }      ///< made in all calls
  int iterations() const { return iterations_; }  ///< of all calls: each a linear solve
  double memory_mib() const;

 private:
  /// Rows in the frames, zero where values are given. \returns false when an element is inverted, at any process
  bool evaluate(const std::vector<double>& mesh);
  void linearise(const std::vector<double>& mesh);
  /// Newton's method from `mesh`, given values fixed.
  bool settle(std::vector<double>& mesh);
  bool go(const std::vector<double>& step, std::vector<double>& mesh);
  /// increment_ = the tangent's response to the residual and to the change of `given` values.
  void solve(const std::vector<double>& given);
  /// Rows of this process's equations stay, others become zero.
  void keep_equations();
  /// Of a field of all processes.
  double norm(const std::vector<double>& field) const;

  const NonlinearMeshMotion<n>& motion_;
  std::vector<char> inner_;
  const NodalFrames<n>* frames_;
  MeshFollowerOptions options_;
  MeshMotionTangent<n> tangent_;
  const NodeShare* share_;
  std::unique_ptr<MeshExtension<n>> extension_;
  bool linearised_ = false;
  int tangents_ = 0, iterations_ = 0;
  std::vector<double> residual_, increment_, right_;
};

}  // namespace fsi
