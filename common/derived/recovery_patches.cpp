#include "derived/recovery_patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/pi.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double same_direction = 1e-6;  // of unit vectors
constexpr double same_place = 1e-6;      // against the size of the cells
constexpr int most_images = 120;         // around a point: all of any reflection group but those of narrow wedges
constexpr Mat3<double> no_turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Length of a cell's longest edge, mm.
double size_of(const RecoveryCells& cells, std::size_t cell) {
  const auto vertices = static_cast<std::size_t>(cells.corners);
  const int* node = &cells.nodes[cell * static_cast<std::size_t>(cells.nodes_per_cell)];
  double largest = 0;
  for (std::size_t a = 0; a < vertices; ++a)
    for (std::size_t b = 0; b < a; ++b)
      largest = std::max(largest, distance(cells.points[node[a]], cells.points[node[b]]));
  return largest;
}

}  // namespace

Point RecoveryPatches::Isometry::operator()(const Point& x) const {
  Point y = shift;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) y[i] += turn(i, j) * x[j];
  return y;
}

RecoveryPatches::RecoveryPatches(const RecoveryCells& cells) : cells_(cells), offsets_(cells.points.size() + 1, 0) {
  for (const int node : cells.nodes) ++offsets_[static_cast<std::size_t>(node) + 1];
  for (std::size_t a = 1; a < offsets_.size(); ++a) offsets_[a] += offsets_[a - 1];
  cells_of_.resize(cells.nodes.size());
  auto next = offsets_;
  for (std::size_t i = 0; i < cells.nodes.size(); ++i)
    cells_of_[next[cells.nodes[i]]++] = i / static_cast<std::size_t>(cells.nodes_per_cell);
  first_.assign(cells.points.size(), -1);
  isometries_.push_back({no_turn, {0, 0, 0}});
  set_planes();
  after_mirror_.emplace_back(planes_.size(), -1);
}

void RecoveryPatches::set_planes() {
  for (const auto& mirror : cells_.mirrors) {
    double offset = 0, count = 0;
    for (const int node : mirror.nodes)
      if (offsets_[node] < offsets_[static_cast<std::size_t>(node) + 1]) {
        offset += dot(mirror.normal, cells_.points[node]);
        ++count;
      }
    if (count == 0) continue;
    planes_at_.resize(cells_.points.size());
    for (const int node : mirror.nodes) planes_at_[node].push_back(static_cast<int>(planes_.size()));
    planes_.push_back({mirror.normal, offset / count});
  }
  for (std::size_t a = 0; a < planes_at_.size(); ++a)
    if (!are_mirrors(static_cast<int>(a), planes_at_[a])) planes_at_[a].clear();
}

bool RecoveryPatches::are_mirrors(int node, const std::vector<int>& planes) const {
  std::vector<Point> outward;  // different ones
  for (const int p : planes) {
    double below = 0, above = 0, size = 0;
    for (std::size_t k = offsets_[node]; k < offsets_[static_cast<std::size_t>(node) + 1]; ++k) {
      size = std::max(size, size_of(cells_, cells_of_[k]));
      for (int a = 0; a < cells_.nodes_per_cell; ++a) {
        const int other = cells_.nodes[cells_of_[k] * static_cast<std::size_t>(cells_.nodes_per_cell) + a];
        const double height = dot(planes_[p].normal, cells_.points[other]) - planes_[p].offset;
        below = std::min(below, height);
        above = std::max(above, height);
      }
    }
    if (std::min(-below, above) > same_place * size) return false;
    const Point normal = above > -below ? -1.0 * planes_[p].normal : planes_[p].normal;
    if (std::none_of(outward.begin(), outward.end(),
                     [&](const Point& known) { return distance(known, normal) < same_direction; }))
      outward.push_back(normal);
  }
  for (std::size_t i = 0; i < outward.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double angle = std::acos(std::clamp(-dot(outward[i], outward[j]), -1.0, 1.0));  // between the planes
      const double parts = pi / angle;
      if (!(parts < most_images) || std::abs(parts - std::round(parts)) > same_direction * parts * parts) return false;
    }
  return true;
}

int RecoveryPatches::after_mirror(int image, int plane) {
  int& known = after_mirror_[image][plane];
  if (known >= 0) return known;
  const Point& n = planes_[plane].normal;
  const Isometry outer = isometries_[image];
  Mat3<double> mirror = no_turn;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mirror(i, j) -= 2 * n[i] * n[j];
  const Isometry both{outer.turn * mirror, outer(2 * planes_[plane].offset * n)};
  const double size = 1 + norm(both.shift);
  const auto same = [&](const Isometry& other) {
    const Mat3<double> difference = other.turn + (-1.0) * both.turn;
    return std::sqrt(contract(difference, difference)) < same_direction &&
           distance(other.shift, both.shift) < same_direction * size;
  };
  const auto found = std::find_if(isometries_.begin(), isometries_.end(), same);
  const int number = static_cast<int>(found - isometries_.begin());
  known = number;
  if (found == isometries_.end()) {
    isometries_.push_back(both);
    after_mirror_.emplace_back(planes_.size(), -1);  // `known` is no longer valid
  }
  return number;
}

std::vector<int> RecoveryPatches::images_around(const PatchPoint& point) {
  std::vector<int> images{point.image};
  if (planes_at_.empty()) return images;
  for (std::size_t i = 0; i < images.size() && images.size() < most_images; ++i)
    for (const int plane : planes_at_[point.node])
      if (const int image = after_mirror(images[i], plane);
          std::find(images.begin(), images.end(), image) == images.end())
        images.push_back(image);
  return images;
}

void RecoveryPatches::begin(int node) {
  for (const auto& point : patch_) first_[point.node] = -1;
  patch_.clear();
  next_.clear();
  grown_ = 0;
  add(node, 0);
}

void RecoveryPatches::add(int node, int image) {
  const Point position = isometries_[image](cells_.points[node]);
  for (int i = first_[node]; i >= 0; i = next_[i]) {
    if (patch_[i].image == image) return;
    // A node in a plane and its image: one point, but for rounding.
    if (!planes_at_[node].empty() &&
        distance(patch_[i].position, position) < same_place * size_of(cells_, cells_of_[offsets_[node]]))
      return;
  }
  next_.push_back(first_[node]);
  first_[node] = static_cast<int>(patch_.size());
  patch_.push_back({node, image, position});
}

void RecoveryPatches::grow() {
  const std::size_t known = patch_.size();
  const auto count = static_cast<std::size_t>(cells_.nodes_per_cell);
  for (; grown_ < known; ++grown_) {
    const PatchPoint point = patch_[grown_];
    for (const int image : images_around(point))
      for (std::size_t k = offsets_[point.node]; k < offsets_[static_cast<std::size_t>(point.node) + 1]; ++k)
        for (std::size_t a = 0; a < count; ++a) add(cells_.nodes[cells_of_[k] * count + a], image);
  }
}

}  // namespace fsi
