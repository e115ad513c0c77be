#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "linear/distributed/mesh_extensions.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "mesh_motion/mesh_follower.hpp"
#include "system/numbering.hpp"

namespace fsi {

/// Moves the fluid's mesh with its interface. The operator of a harmonic extension is factorised once per run, or as
/// often as the scene assembles it; the tangent of a nonlinear motion once a stage at least. Collective.
template <int n>
class MeshMotionSolver {
 public:
  explicit MeshMotionSolver(Scene<n>& scene) : scene_(scene) {
    const Numbering numbering = number_mesh_motion(scene);
    std::vector<char> inner(numbering.mesh.size());
    for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = numbering.mesh[i].index >= 0;
    const PartNodes& part = scene.fluid->nodes();
    if (scene.nonlinear_mesh_motion) {
      SharedMesh<n> shared;
      shared.share = part.share.get();
      shared.make_extension = [&part](const MeshMotionTangent<n>& tangent, std::vector<char> sought) {
        return make_tangent_extension<n>(tangent, std::move(sought), part);
      };
      follower_ = std::make_unique<MeshFollower<n>>(*scene.nonlinear_mesh_motion, std::move(inner),
                                                    &scene_.fluid_frames, MeshFollowerOptions{}, shared);
      return;
    }
    zero_.assign(inner.size(), 0.0);
    const auto phase = scene_.profile.phase("factorisation: mesh motion");
    extension_ = make_harmonic_extension<n>(scene_.mesh_motion, std::move(inner), &scene_.fluid_frames, part);
    version_ = scene_.mesh_motion_assemblies;
  }

  /// A stage begins. Discards tangents of earlier stages, so that results do not depend on them.
  void start() {
    if (follower_) follower_->forget();
  }

  /// Overwrites the inner values of `mesh` by the motion of its boundary values.
  /// \param mesh      d_m, n numbers per fluid node, mm
  /// \param from      start of a nonlinear motion, alike, with any boundary values; not read by a harmonic extension
  /// \param unfolded  start in place of `from` where that has an inverted element
  /// \throws ConvergenceError where a nonlinear motion does not reach the boundary values
  void solve(std::vector<double>& mesh, const std::vector<double>& from, const std::vector<double>& unfolded) {
    if (follower_) {
      const auto phase = scene_.profile.phase("solve: mesh motion");
      const int before = follower_->tangents();
      std::vector<double> moved = follower_->unfolded(from) ? from : unfolded;
      follower_->follow(mesh, moved);
      mesh = std::move(moved);
      scene_.profile.count("mesh motion factorisations", follower_->tangents() - before);
      return;
    }
    scene_.renew_constant_operators();
    if (version_ != scene_.mesh_motion_assemblies) {
      const auto phase = scene_.profile.phase("factorisation: mesh motion");
      extension_->update();
      version_ = scene_.mesh_motion_assemblies;
    }
    const auto phase = scene_.profile.phase("solve: mesh motion");
    scene_.fluid_frames.template to_frames<VectorLayout<n>>(mesh);
    extension_->solve(zero_, mesh, HarmonicExtensionOptions{}.tolerance);
    scene_.fluid_frames.template to_space<VectorLayout<n>>(mesh);
  }

 private:
  Scene<n>& scene_;
  std::unique_ptr<MeshExtension<n>> extension_;
  std::unique_ptr<MeshFollower<n>> follower_;  ///< in its place, of a nonlinear motion
  int version_ = 0;                            ///< the assembly whose operator it is
  std::vector<double> zero_;
};

}  // namespace fsi
