#include "partitioned/block_newton/joint_iteration.hpp"

#include <algorithm>

#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"
#include "partitioned/interface/sub_problem.hpp"

namespace fsi {

namespace {

/// Weight of the datum's rows against those of the media: the gap converges last (docs/archive.md).
constexpr float weight_of_gap = 3;

}  // namespace

template <int n>
JointIteration<n>::JointIteration(const Scene<n>& scene, const Numbering& fluid, const Numbering& wall)
    : scene_(scene), fluid_numbering_(fluid), wall_numbering_(wall) {}

template <int n>
void JointIteration<n>::update(MediumPreconditioner& fluid, MediumPreconditioner& wall,
                               const std::vector<double>& impedance) {
  fluid_ = &fluid;
  wall_ = &wall;
  layout_ = {fluid.size(), wall.size(), scene_.interface.size() * n};
  links_.clear();
  for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
    const auto& node = scene_.interface[i];
    Link link{fluid.place(node.fluid),
              wall.place(node.wall),
              static_cast<float>(impedance[i]),
              scene_.fluid_frames.at(node.fluid),
              scene_.wall_frames.at(node.wall),
              {},
              {}};
    for (int k = 0; k < n; ++k) {
      link.fluid_free[k] = fluid_numbering_.fluid_rows[MixedLayout<n>::vector(node.fluid, k)].index >= 0;
      link.wall_free[k] = wall_numbering_.wall_rows[MixedLayout<n>::vector(node.wall, k)].index >= 0;
    }
    links_.push_back(link);
  }
}

template <int n>
typename JointIteration<n>::Vector JointIteration<n>::vector_at(VectorView<const float> x, int place,
                                                                const NodalAxes<n>* axes) {
  Vector v{};
  if (place < 0) return v;
  if (axes == nullptr) {
    std::copy_n(x.begin() + place, n, v.begin());
    return v;
  }
  Direction<n> turned{};
  std::copy_n(x.begin() + place, n, turned.begin());
  NodalFrames<n>::to_space(*axes, turned.data());
  for (int k = 0; k < n; ++k) v[k] = static_cast<float>(turned[k]);
  return v;
}

template <int n>
void JointIteration<n>::add_to(const Vector& x, int place, const NodalAxes<n>* axes, const std::array<bool, n>& free,
                               VectorView<float> to) {
  if (place < 0) return;
  Direction<n> turned{};
  std::copy(x.begin(), x.end(), turned.begin());
  if (axes) NodalFrames<n>::to_frame(*axes, turned.data());
  for (int k = 0; k < n; ++k)
    if (free[k]) to[static_cast<std::size_t>(place) + k] += static_cast<float>(turned[k]);
}

template <int n>
void JointIteration<n>::load_wall(const Blocks& z, float sign, VectorView<float> wall) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    Vector load = vector_at(z.fluid, link.fluid, link.fluid_axes);
    for (int k = 0; k < n; ++k) load[k] = sign * link.impedance * (load[k] - z.datum[i * n + k]);
    add_to(load, link.wall, link.wall_axes, link.wall_free, wall);
  }
}

template <int n>
void JointIteration<n>::add_interface_terms(const Blocks& z, const Blocks& products) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const Vector fluid = vector_at(z.fluid, link.fluid, link.fluid_axes);
    const Vector wall = vector_at(z.wall, link.wall, link.wall_axes);
    Vector force;
    for (int k = 0; k < n; ++k) {
      force[k] = -link.impedance * z.datum[i * n + k];
      products.datum[i * n + k] = weight_of_gap * link.impedance * (wall[k] - fluid[k]);
    }
    add_to(force, link.fluid, link.fluid_axes, link.fluid_free, products.fluid);
  }
  load_wall(z, -1, products.wall);
}

template <int n>
void JointIteration<n>::pass(const std::vector<float>& r, std::vector<float>& z, std::vector<float>& y,
                             const Seconds& seconds) {
  in_ = r;
  z.resize(layout_.size());
  y.resize(layout_.size());
  const Blocks in = layout_.view(in_), out = layout_.view(z), products = layout_.view(y);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    Vector force;
    for (int k = 0; k < n; ++k) {
      force[k] = -in.datum[i * n + k] / weight_of_gap;
      out.datum[i * n + k] = link.impedance > 0 ? force[k] / link.impedance : 0;
    }
    add_to(force, link.fluid, link.fluid_axes, link.fluid_free, in.fluid);
  }
  {
    const Stopwatch watch(seconds.fluid);
    fluid_->apply(in.fluid, out.fluid, products.fluid);
  }
  load_wall(out, 1, in.wall);
  {
    const Stopwatch watch(seconds.wall);
    wall_->apply(in.wall, out.wall, products.wall);
  }
  add_interface_terms(out, products);
}

template <int n>
int JointIteration<n>::solve(std::vector<float>& right, double tolerance, int most_iterations,
                             std::vector<float>& solution, const Seconds& seconds) {
  for (float& value : layout_.view(right).datum) value *= weight_of_gap;
  return gmres_
      .solve_from_zero([&](const auto& residual, auto& z, auto& y) { pass(residual, z, y, seconds); }, right, solution,
                       tolerance, most_iterations)
      .iterations;
}

#define FSI_INSTANTIATE(n) template class JointIteration<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
