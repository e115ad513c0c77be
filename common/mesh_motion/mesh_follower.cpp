#include "mesh_motion/mesh_follower.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

template <int n>
MeshFollower<n>::MeshFollower(const NonlinearMeshMotion<n>& motion, std::vector<char> inner,
                              const NodalFrames<n>* frames, const MeshFollowerOptions& options,
                              const SharedMesh<n>& shared)
    : motion_(motion),
      inner_(std::move(inner)),
      frames_(frames && !frames->empty() ? frames : nullptr),
      options_(options),
      tangent_(motion.graph()),
      share_(shared.share) {
  if (share_)
    extension_ = shared.make_extension(tangent_, inner_);
  else
    extension_ = std::make_unique<TangentExtension<n>>(tangent_, inner_, options.linear);
  increment_.resize(inner_.size());
  right_ = increment_;
}

template <int n>
bool MeshFollower<n>::evaluate(const std::vector<double>& mesh) {
  const bool inverted = motion_.assemble(mesh, residual_).inverted();
  if (share_ ? share_->processes->any(inverted) : inverted) return false;
  if (frames_) frames_->template to_frames<VectorLayout<n>>(residual_);
  keep_equations();
  return true;
}

template <int n>
void MeshFollower<n>::keep_equations() {
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (!inner_[i] || (share_ && !share_->owned[i / n])) residual_[i] = 0;
}

template <int n>
double MeshFollower<n>::norm(const std::vector<double>& field) const {
  if (!share_) return fsi::norm(field);
  double sum = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
    if (share_->owned[i / n]) sum += field[i] * field[i];
  return std::sqrt(share_->processes->sum(sum));
}

template <int n>
bool MeshFollower<n>::unfolded(const std::vector<double>& mesh) {
  return evaluate(mesh);
}

template <int n>
void MeshFollower<n>::linearise(const std::vector<double>& mesh) {
  motion_.assemble(mesh, residual_, &tangent_);
  if (frames_) {
    frames_->template to_frames<VectorLayout<n>>(residual_);
    frames_->turn_blocks(tangent_);
  }
  keep_equations();
  extension_->update();
  linearised_ = true;
  ++tangents_;
}

template <int n>
void MeshFollower<n>::solve(const std::vector<double>& given) {
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right_[i] = -residual_[i];
    increment_[i] = inner_[i] ? 0 : given.empty() ? 0 : given[i];
  }
  extension_->solve(right_, increment_, options_.linear.tolerance);
  if (frames_) frames_->template to_space<VectorLayout<n>>(increment_);
  ++iterations_;
}

template <int n>
void MeshFollower<n>::follow(const std::vector<double>& target, std::vector<double>& mesh) {
  assert(target.size() == inner_.size() && mesh.size() == inner_.size());
  std::vector<double> way(target.size());  // of the given values, in the frames
  for (std::size_t i = 0; i < way.size(); ++i) way[i] = target[i] - mesh[i];
  if (frames_) frames_->template to_frames<VectorLayout<n>>(way);
  for (std::size_t i = 0; i < way.size(); ++i)
    if (inner_[i]) way[i] = 0;
  std::vector<double> here = mesh, step(way.size()), trial;
  double gone = 0, part = 1;
  const double smallest = std::ldexp(1.0, -options_.max_halvings);
  while (gone < 1) {
    part = std::min(part, 1 - gone);
    scaled_copy(part, way, step);
    trial = here;
    if (go(step, trial)) {
      std::swap(here, trial);
      gone += part;
      part *= 2;
      continue;
    }
    linearised_ = false;  // the next try begins with a tangent of this place
    part /= 2;
    if (part < smallest) throw ConvergenceError("the mesh motion finds no way without a folded element", "");
  }
  mesh = std::move(here);
}

template <int n>
bool MeshFollower<n>::go(const std::vector<double>& step, std::vector<double>& mesh) {
  if (!linearised_)
    linearise(mesh);
  else if (!evaluate(mesh))
    return false;
  solve(step);
  axpy(1, increment_, mesh);
  return evaluate(mesh) && settle(mesh);
}

template <int n>
bool MeshFollower<n>::settle(std::vector<double>& mesh) {
  bool fresh = false;
  double last = 0;
  std::vector<double> trial;
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
    const double before = norm(residual_);
    if (before == 0) return true;
    solve({});
    const double increment = norm(increment_), size = norm(mesh);
    if (!std::isfinite(increment)) return false;
    const double contraction = last > 0 ? increment / last : 1;
    trial = mesh;
    axpy(1, increment_, trial);
    const bool valid = evaluate(trial);
    if (valid && increment <= options_.tolerance * size) {
      mesh = trial;
      return true;
    }
    if (!valid || norm(residual_) > before) {
      if (valid && increment <= 1e3 * options_.tolerance * size) return true;  // rounding: the old iterate is as good
      if (fresh) {
        // Half the step, and again, as long as that folds an element or raises the residual.
        double length = 1;
        bool found = false;
        for (int k = 0; k < 10 && !found; ++k) {
          length /= 2;
          trial = mesh;
          axpy(length, increment_, trial);
          found = evaluate(trial) && norm(residual_) <= before;
        }
        if (!found) return false;
        mesh = trial;
        linearise(mesh);
        last = 0;
        continue;
      }
      linearise(mesh);
      fresh = true;
      last = 0;
      continue;
    }
    mesh = trial;
    fresh = false;
    if (last > 0 && contraction > options_.keep_contraction) {
      linearise(mesh);
      fresh = true;
      last = 0;
    } else {
      last = increment;
    }
  }
  return false;
}

template <int n>
double MeshFollower<n>::memory_mib() const {
  return extension_->memory_mib() + static_cast<double>(tangent_.values.size() * sizeof(double)) / (1 << 20);
}

#define FSI_INSTANTIATE(n) template class MeshFollower<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
