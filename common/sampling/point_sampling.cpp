#include "sampling/point_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "mesh/cell_grid.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_math.hpp"
#include "sampling/sampling_rules.hpp"

namespace fsi {

namespace {

constexpr double on_boundary = -1e-6;  // least barycentric coordinate in a cell: users type points with a few digits

template <int Dim, int Order, template <int, int> class Mesh>
PointSample sample_of(const Mesh<Dim, Order>& mesh, int cell, const std::array<double, Dim + 1>& l) {
  const auto& nodes = mesh.cells[cell];
  const auto weights = CellMap<Dim, Order>::shape(l);
  return {{nodes.begin(), nodes.end()}, {weights.begin(), weights.end()}, {l.begin(), l.end()}};
}

/// The listed cells whose bounding box contains a point: a grid of them alone is small where points are few.
template <int Dim, int Order, template <int, int> class Mesh>
std::vector<int> cells_near(const Mesh<Dim, Order>& mesh, const std::vector<int>& cells, std::vector<Point> points) {
  constexpr double margin = 1e-2;  // of a box: larger than the distance at which points count as in a cell
  const Point spread = BoundingBox(points).extent();
  const auto along = std::max_element(spread.begin(), spread.end()) - spread.begin();
  std::sort(points.begin(), points.end(), [&](const Point& a, const Point& b) { return a[along] < b[along]; });
  std::vector<int> near;
  for (const int c : cells) {
    const auto x = control_points(mesh, c);
    Point from = x[0], to = x[0];
    for (const Point& at : x)
      for (int d = 0; d < 3; ++d) {
        from[d] = std::min(from[d], at[d]);
        to[d] = std::max(to[d], at[d]);
      }
    const double more = margin * distance(from, to);
    const auto is_in = [&](const Point& at) {
      for (int d = 0; d < 3; ++d)
        if (at[d] < from[d] - more || at[d] > to[d] + more) return false;
      return true;
    };
    auto point = std::lower_bound(points.begin(), points.end(), from[along] - more,
                                  [&](const Point& at, double bound) { return at[along] < bound; });
    while (point != points.end() && (*point)[along] <= to[along] + more && !is_in(*point)) ++point;
    if (point != points.end() && is_in(*point)) near.push_back(c);
  }
  return near;
}

/// The cell that contains a point deepest, the first among equals.
template <int Dim>
struct Holder {
  int cell = -1;  ///< none
  std::array<double, Dim + 1> place{};
};

/// \param furthest  least barycentric coordinate of a point that counts as in a cell, negative
template <int Dim, int Order, template <int, int> class Mesh>
Holder<Dim> holder_of(const Mesh<Dim, Order>& mesh, const CellGrid& grid, const Point& x, double furthest) {
  const auto [begin, end] = grid.near(x);
  Holder<Dim> holder;
  double most = furthest;
  for (const int* c = begin; c != end; ++c) {
    std::array<double, Dim + 1> candidate;
    if (!map_of(mesh, *c).find(x, candidate)) continue;
    const double least = *std::min_element(candidate.begin(), candidate.end());
    if (least < most || (holder.cell >= 0 && least <= most)) continue;
    most = least;
    holder = {*c, candidate};
  }
  return holder;
}

/// The cell nearest to a point by the distance to the point's clamped image in it.
template <int Dim, int Order>
PointSample nearest_sample(const SimplexMesh<Dim, Order>& mesh, const std::vector<int>& cells, const Point& x,
                           const SamplingPlace& from) {
  int best = -1;
  std::array<double, Dim + 1> best_place{};
  double least = std::numeric_limits<double>::infinity();
  for (const int c : cells) {
    const auto map = map_of(mesh, c);
    std::array<double, Dim + 1> place;
    if (!map.find(x, place)) place = map.straight(x);
    const auto kept = clamped_weights(place);
    const double away = distance(map.at(kept), x);
    if (away >= least) continue;
    least = away;
    best = c;
    best_place = kept;
  }
  double longest = 0;
  if (best >= 0)
    for (int a = 0; a <= Dim; ++a)
      for (int b = 0; b <= Dim; ++b)
        longest = std::max(longest, distance(mesh.nodes[mesh.cells[best][a]], mesh.nodes[mesh.cells[best][b]]));
  if (!(least <= furthest_edges * longest))
    throw InputError(from.file, from.key,
                     fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) lies {:.3g} mm outside", x[0], x[1], x[2], least),
                     sampling_remedy);
  return sample_of(mesh, best, best_place);
}

}  // namespace

template <int Dim, int Order>
std::vector<PointSample> sample_in_cells(const SimplexMesh<Dim, Order>& mesh, int region,
                                         const std::vector<Point>& points, const SamplingPlace& from) {
  assert(mesh.cell_region.size() == mesh.cells.size());
  assert(region < static_cast<int>(mesh.regions.size()));
  std::vector<int> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (region < 0 || mesh.cell_region[c] == region) cells.push_back(static_cast<int>(c));
  std::vector<PointSample> samples;
  if (points.empty()) return samples;
  if (cells.empty()) throw InputError(from.file, from.key, "has no cells", "give it some");

  const auto near = cells_near(mesh, cells, points);
  std::optional<CellGrid> grid;
  if (!near.empty()) grid.emplace(mesh, near);
  samples.reserve(points.size());
  for (const Point& x : points) {
    const Holder<Dim> holder = grid ? holder_of(mesh, *grid, x, barycentric_inside) : Holder<Dim>();
    samples.push_back(holder.cell >= 0 ? sample_of(mesh, holder.cell, holder.place)
                                       : nearest_sample(mesh, cells, x, from));
  }
  return samples;
}

template <int Dim, int Order>
std::vector<std::optional<PointSample>> locate_in_cells(const Submesh<Dim, Order>& part,
                                                        const std::vector<Point>& points) {
  std::vector<std::optional<PointSample>> samples(points.size());
  if (points.empty() || part.cells.empty()) return samples;
  const auto near = cells_near(part, all_cells(part), points);
  if (near.empty()) return samples;
  const CellGrid grid(part, near);
  const auto off_plane = [&](const Point& x) {
    if constexpr (Dim == 3) return false;
    // The plane of the part is that of its first cell.
    const auto map = map_of(part, 0);
    const Point normal = cross(map.x[1] - map.x[0], map.x[2] - map.x[0]);
    return std::abs(dot(x - map.x[0], normal)) > -on_boundary * std::pow(norm(normal), 1.5);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (off_plane(points[i])) continue;
    const Holder<Dim> holder = holder_of(part, grid, points[i], on_boundary);
    if (holder.cell >= 0) samples[i] = sample_of(part, holder.cell, clamped_weights(holder.place));
  }
  return samples;
}

std::vector<double> evenly_spaced(double first, double last, int count) {
  assert(count >= 0);
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = (first * (count - 1 - i) + last * i) / std::max(1, count - 1);
  return values;
}

#define INSTANTIATE(Dim, Order)                                                                                     \
  template std::vector<PointSample> sample_in_cells(const SimplexMesh<Dim, Order>&, int, const std::vector<Point>&, \
                                                    const SamplingPlace&);                                          \
  template std::vector<std::optional<PointSample>> locate_in_cells(const Submesh<Dim, Order>&,                      \
                                                                   const std::vector<Point>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
