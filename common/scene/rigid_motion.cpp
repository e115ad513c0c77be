#include "scene/rigid_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

namespace {

constexpr double none = 1e-10;  // of the largest resistance: less is rounding

/// Rigid motions of a body in space, three translations and three rotations about its middle, over its size.
struct RigidMotions {
  Point middle{0, 0, 0};
  double size = 0;  ///< mm

  explicit RigidMotions(const PartNodes& part) {
    std::int64_t own = 0;
    for (int a = 0; a < part.node_count(); ++a) own += part.owns(a) ? 1 : 0;
    const auto count = static_cast<double>(part.processes().sum(own));
    for (int a = 0; a < part.node_count(); ++a)
      for (int i = 0; i < 3 && part.owns(a); ++i) middle[i] += part.nodes[a][i] / count;
    part.processes().sum(middle.data(), middle.size());
    for (const Point& x : part.nodes)
      for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(x[i] - middle[i]));
    size = part.processes().largest(size);
  }
  /// Displacement of a point in motion m, along axis i of space.
  double at(int m, const Point& x, int i) const {
    if (m < 3) return m == i ? 1 : 0;
    const int about = m - 3, j = (about + 1) % 3, k = (about + 2) % 3;
    return i == j ? -(x[k] - middle[k]) / size : i == k ? (x[j] - middle[j]) / size : 0;
  }
};

/// The motions that a scene's geometry allows: all in space, those in the plane, or along the axis of revolution.
template <int n>
std::vector<int> motions_of(const Scene<n>& scene) {
  if (n == 3) return {0, 1, 2, 3, 4, 5};
  return scene.axes[1] == 1 ? std::vector<int>{0, 1, 5} : std::vector<int>{2};
}

using Square = std::vector<std::vector<double>>;

/// A combination of motions that a symmetric matrix of resistances does not see; empty: it sees all. By elimination with
/// the largest pivot that is left on the diagonal.
std::vector<double> unresisted(Square a) {
  const std::size_t size = a.size();
  double largest = 0;
  for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, a[i][i]);
  std::vector<std::size_t> order(size);
  for (std::size_t i = 0; i < size; ++i) order[i] = i;
  for (std::size_t step = 0; step < size; ++step) {
    const auto pivot = std::max_element(order.begin() + static_cast<std::ptrdiff_t>(step), order.end(),
                                        [&](std::size_t i, std::size_t j) { return a[i][i] < a[j][j]; });
    std::iter_swap(order.begin() + static_cast<std::ptrdiff_t>(step), pivot);
    const std::size_t p = order[step];
    if (a[p][p] <= none * largest) {
      std::vector<double> free(size, 0.0);
      free[p] = 1;
      for (std::size_t k = step; k-- > 0;) {  // back through what has been eliminated
        const std::size_t row = order[k];
        double sum = 0;
        for (std::size_t l = k + 1; l <= step; ++l) sum += a[row][order[l]] * free[order[l]];
        free[row] = -sum / a[row][row];
      }
      return free;
    }
    for (std::size_t k = step + 1; k < size; ++k) {
      const std::size_t row = order[k];
      const double factor = a[row][p] / a[p][p];
      for (std::size_t l = step + 1; l < size; ++l) a[row][order[l]] -= factor * a[p][order[l]];
    }
  }
  return {};
}

}  // namespace

template <int n>
void require_no_rigid_motion(const Case& setup, const Scene<n>& scene) {
  if (!scene.wall || setup.supports.empty() || (setup.time && !setup.prestress)) return;
  const auto& nodes = scene.wall->nodes().nodes;
  const RigidMotions rigid(scene.wall->nodes());
  const Communicator& processes = scene.processes();
  const auto motions = motions_of(scene);
  Square resistance(motions.size(), std::vector<double>(motions.size(), 0.0));
  for (int node = 0; node < scene.wall->node_count(); ++node)
    for (int k = 0; k < n; ++k) {
      if (!scene.wall_conditions.fixes(node, k) || !scene.wall->nodes().owns(node)) continue;
      std::vector<double> along;  // of each motion, in the component that is held
      for (const int m : motions) {
        Direction<n> moved;
        for (int i = 0; i < n; ++i) moved[i] = rigid.at(m, nodes[node], scene.axes[i]);
        if (const auto* axes = scene.wall_frames.at(node)) NodalFrames<n>::to_frame(*axes, moved.data());
        along.push_back(moved[k]);
      }
      for (std::size_t i = 0; i < motions.size(); ++i)
        for (std::size_t j = 0; j < motions.size(); ++j) resistance[i][j] += along[i] * along[j];
    }
  const auto* supports = setup.prestress ? nullptr : scene.wall->supports();
  if (supports && supports->has_springs()) {
    std::vector<std::vector<double>> fields;
    for (const int m : motions) {
      std::vector<double> field(scene.wall->space().mixed_size(), 0.0);
      for (int node = 0; node < scene.wall->node_count(); ++node)
        for (int k = 0; k < n; ++k) field[MixedLayout<n>::vector(node, k)] = rigid.at(m, nodes[node], scene.axes[k]);
      fields.push_back(std::move(field));
    }
    double largest = 0;
    for (const auto& field : fields) largest = std::max(largest, 2 * processes.sum(supports->stored(field)));
    for (std::size_t i = 0; i < fields.size(); ++i)
      for (std::size_t j = 0; j < fields.size(); ++j)
        resistance[i][j] += supports->spring_product(fields[i], fields[j]) / largest;
  }
  for (auto& row : resistance) processes.sum(row);
  const auto free = unresisted(resistance);
  if (free.empty()) return;
  const auto strongest = static_cast<std::size_t>(
      std::max_element(free.begin(), free.end(), [](double x, double y) { return std::abs(x) < std::abs(y); }) -
      free.begin());
  const int motion = motions[strongest];
  throw InputError(
      setup.path.string(), "support",
      fmt::format("nothing resists {} {}: the wall could move as a rigid body",
                  motion < 3 ? "a displacement along" : "a rotation about", std::string(1, "xyz"[motion % 3])),
      setup.prestress ? "fix more components, or clamp wall_ends; springs are relaxed under a prestress"
                      : "fix more components, give springs, or clamp wall_ends");
}

#define FSI_INSTANTIATE(n) template void require_no_rigid_motion<n>(const Case&, const Scene<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
