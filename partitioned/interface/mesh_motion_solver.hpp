#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mesh_motion/harmonic_extension.hpp"
#include "system/numbering.hpp"

namespace fsi {

/// Takes the fluid's mesh along with its interface: a harmonic extension, prepared once per run or as often as the
/// scene assembles its operator.
template <int n>
class MeshMotionSolver {
 public:
  explicit MeshMotionSolver(Scene<n>& scene) : scene_(scene) {
    const Numbering numbering = number_mesh_motion(scene);
    std::vector<char> inner(numbering.mesh_rows.size());
    for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = numbering.mesh_rows[i].index >= 0;
    zero_.assign(inner.size(), 0.0);
    const auto phase = scene_.profile.phase("factorisation: mesh motion");
    extension_ = std::make_unique<HarmonicExtension<n>>(scene_.mesh_motion, std::move(inner),
                                                        HarmonicExtensionOptions{}, &scene_.fluid_frames);
    version_ = scene_.mesh_motion_assemblies;
  }

  /// Overwrites the inner values of d_m, n numbers per fluid node, from those on the boundary.
  void solve(std::vector<double>& mesh) {
    scene_.renew_constant_operators();
    if (version_ != scene_.mesh_motion_assemblies) {
      const auto phase = scene_.profile.phase("factorisation: mesh motion");
      extension_->update();
      version_ = scene_.mesh_motion_assemblies;
    }
    const auto phase = scene_.profile.phase("solve: mesh motion");
    scene_.fluid_frames.template to_frames<VectorLayout<n>>(mesh);
    extension_->solve(zero_, mesh);
    scene_.fluid_frames.template to_space<VectorLayout<n>>(mesh);
  }

 private:
  Scene<n>& scene_;
  std::unique_ptr<HarmonicExtension<n>> extension_;
  int version_ = 0;  ///< the assembly whose operator it is
  std::vector<double> zero_;
};

}  // namespace fsi
