#include "fields/point_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fsi {

namespace {

constexpr std::size_t most_near = 12;
constexpr double inside = -1e-9;       // a barycentric coordinate of a place in a cell
constexpr double least_spread = 0.03;  // of squares along a direction, of those along the widest, for a slope along it

using Matrix = std::array<Point, 3>;

/// Eigenvalues of a symmetric matrix, which becomes diagonal, and eigenvectors as columns of `axes`, by Jacobi's
/// rotations.
void diagonalise(Matrix& a, Matrix& axes) {
  axes = {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  for (int sweep = 0; sweep < 12; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        for (int k = 0; k < 3; ++k) {
          const double kp = axes[k][p], kq = axes[k][q];
          axes[k][p] = c * kp - s * kq;
          axes[k][q] = s * kp + c * kq;
        }
      }
}

}  // namespace

double median_spacing(const NearPoints& points) {
  constexpr std::size_t most_asked = 1000;
  const std::size_t count = points.points().size(), stride = 1 + count / most_asked;
  std::vector<double> spacing;
  for (std::size_t i = 0; i < count; i += stride)
    spacing.push_back(std::sqrt(points.nearest(points.points()[i], 2).back().first));
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  return *middle;
}

PointField::PointField(FieldSamples samples, double within)
    : points_(std::move(samples.places)),
      values_(std::move(samples.values)),
      of_cells_(!samples.place_of_cell.empty()),
      within_(within > 0 ? within : 3 * median_spacing(points_)) {
  keep_cells(samples);
}

void PointField::keep_cells(FieldSamples& samples) {
  const bool solid =
      std::any_of(samples.cells.begin(), samples.cells.end(), [](const auto& cell) { return cell[3] >= 0; });
  const auto all_zero = [&](int axis) {
    return std::all_of(samples.nodes.begin(), samples.nodes.end(), [&](const Point& x) { return x[axis] == 0; });
  };
  if (!solid && !all_zero(1) && !all_zero(2)) return;  // a surface in space
  std::vector<int> all;
  for (std::size_t c = 0; c < samples.cells.size(); ++c) {
    const auto& cell = samples.cells[c];
    if (solid != (cell[3] >= 0)) continue;
    all.push_back(static_cast<int>(all.size()));
    if (solid)
      tetrahedra_.mesh.cells.push_back(cell);
    else
      triangles_.mesh.cells.push_back({cell[0], cell[1], cell[2]});
    if (of_cells_) (solid ? tetrahedra_.places : triangles_.places).push_back(samples.place_of_cell[c]);
  }
  if (all.empty()) return;
  if (solid) {
    tetrahedra_.mesh.nodes = std::move(samples.nodes);
    tetrahedra_.grid.emplace(tetrahedra_.mesh, all);
  } else {
    triangles_.mesh.nodes = std::move(samples.nodes);
    triangles_.grid.emplace(triangles_.mesh, all);
  }
}

template <int Dim>
std::optional<double> PointField::Cells<Dim>::at(const Point& x, const std::vector<double>& values) const {
  if (!grid) return std::nullopt;
  const auto [begin, end] = grid->near(x);
  double most = inside;
  std::optional<double> found;
  for (const int* c = begin; c != end; ++c) {
    const auto l = map_of(mesh, *c).straight(x);
    const double least = *std::min_element(l.begin(), l.end());
    if (!(least >= most) || (found && least <= most)) continue;
    most = least;
    if (!places.empty()) {
      found = values[static_cast<std::size_t>(places[static_cast<std::size_t>(*c)])];
      continue;
    }
    found = 0;
    for (std::size_t i = 0; i < l.size(); ++i)
      *found += l[i] * values[static_cast<std::size_t>(mesh.cells[static_cast<std::size_t>(*c)][i])];
  }
  return found;
}

double PointField::distance_to(const Point& x) const {
  return std::sqrt(points_.nearest(x, 1).front().first);
}

std::optional<double> PointField::at(const Point& x) const {
  if (const auto found = tetrahedra_.at(x, values_)) return found;
  if (const bool in_plane = x[1] == 0 || x[2] == 0; in_plane)
    if (const auto found = triangles_.at(x, values_)) return found;
  const auto nearest = points_.nearest(x, 1).front();
  if (!(std::sqrt(nearest.first) <= within_)) return std::nullopt;
  return of_cells_ ? values_[nearest.second] : fitted(x);
}

double PointField::fitted(const Point& x) const {
  const auto near = points_.nearest(x, most_near);
  const double softening = 1e-12 * near.back().first;
  double weights = 0, mean = 0, low = values_[near.front().second], high = low;
  Point centre{0, 0, 0};
  std::vector<double> weight;
  for (const auto& [squared, number] : near) {
    weight.push_back(squared + softening > 0 ? 1 / (squared + softening) : 1);
    weights += weight.back();
    mean += weight.back() * values_[number];
    centre = centre + weight.back() * (points_.points()[number] - x);
    low = std::min(low, values_[number]);
    high = std::max(high, values_[number]);
  }
  mean /= weights;
  centre = (1 / weights) * centre;
  Matrix spread{}, axes;
  Point moment{0, 0, 0};
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Point off = points_.points()[near[i].second] - x - centre;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) spread[r][c] += weight[i] * off[r] * off[c];
    moment = moment + (weight[i] * (values_[near[i].second] - mean)) * off;
  }
  diagonalise(spread, axes);
  const double widest = std::max({spread[0][0], spread[1][1], spread[2][2]});
  double value = mean;
  for (int k = 0; k < 3; ++k) {
    if (!(spread[k][k] > least_spread * widest)) continue;
    const Point axis{axes[0][k], axes[1][k], axes[2][k]};
    value -= dot(axis, moment) / spread[k][k] * dot(axis, centre);
  }
  return std::clamp(value, low, high);
}

}  // namespace fsi
