#include "sampling/centre_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/for_each_mesh.hpp"
#include "sampling/harmonic_coordinate.hpp"
#include "sampling/level_cut.hpp"
#include "sampling/point_sampling.hpp"
#include "sampling/smooth_curve.hpp"

namespace fsi {

namespace {

constexpr double end_level = 1e-9;  // of the first surface: just inside the opening
constexpr int first_levels = 33;    // of the rough curve along which the others are spaced evenly
constexpr int most_levels = 2000;

[[noreturn]] void not_found(const char* why) {
  throw ConvergenceError(std::string("there is no centre line: ") + why,
                         "openings at the two ends of one tube, or a line by from and to");
}

/// The surfaces of constant harmonic coordinate.
template <int Dim, int Order>
class Levels {
 public:
  using Values = std::array<double, Dim + 1>;

  Levels(const Submesh<Dim, Order>& part, std::vector<double> h, bool turned, const std::vector<MirrorPlane>& planes)
      : part_(part), h_(std::move(h)), turned_(turned), planes_(planes) {}

  /// Centroids of the surfaces, in the order of the levels, which ascend.
  std::vector<Point> centroids(const std::vector<double>& levels) const {
    // One pass over the cells, whatever the number of levels.
    std::vector<std::vector<int>> cut(levels.size());
    for (std::size_t c = 0; c < part_.cells.size(); ++c) {
      const auto h = values(static_cast<int>(c), 0);
      const auto [low, high] = std::minmax_element(h.begin(), h.end());
      const auto first = std::upper_bound(levels.begin(), levels.end(), *low) - levels.begin();
      for (auto k = static_cast<std::size_t>(first); k < levels.size() && levels[k] <= *high; ++k)
        cut[k].push_back(static_cast<int>(c));
    }
    std::vector<Point> centres;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (cut[k].empty()) not_found("the fluid does not connect the openings");
      centres.push_back(centroid(cut[k], levels[k]));
    }
    return centres;
  }

 private:
  /// The coordinate at the vertices of a cell, less a level; between them it is linear.
  Values values(int cell, double level) const {
    Values f;
    const auto& nodes = part_.cells[cell];
    for (int i = 0; i <= Dim; ++i) f[i] = h_[nodes[i]] - level;
    return f;
  }

  Point centroid(const std::vector<int>& cells, double level) const {
    const auto f_of = [&](int cell) { return values(cell, level); };
    const auto piece = pieces_of_cut<Dim, 1>(part_.cells, cells, f_of);
    struct Sum {
      double area = 0, flux = 0;
      Point moment{0, 0, 0};
    };
    std::vector<Sum> sums(1 + *std::max_element(piece.begin(), piece.end()));
    for (std::size_t k = 0; k < cells.size(); ++k) {
      CellMap<Dim, Order> map;
      for (std::size_t i = 0; i < map.x.size(); ++i) map.x[i] = part_.nodes[part_.cells[cells[k]][i]];
      const auto f = f_of(cells[k]);
      const auto [low, high] = std::minmax_element(f.begin(), f.end());
      const double steepness = (*high - *low) / std::pow(std::abs(simplex_volume<Dim>(map.x.data())), 1.0 / Dim);
      Sum& sum = sums[piece[k]];
      cut_cell<Dim, 1>(f, [&](const CutPiece<Dim>& part) {
        for_points_of<Dim, Order>(part, map, [&](const CutPoint<Dim>& point) {
          const double area = norm(point.area) * (turned_ ? point.at[0] : 1);
          sum.area += area;
          sum.flux += steepness * area;
          sum.moment = sum.moment + area * (turned_ ? Point{0, 0, point.at[2]} : point.at);
        });
      });
    }
    const auto main =
        std::max_element(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) { return a.flux < b.flux; });
    if (!(main->area > 0)) not_found("a surface across it has no area");
    std::vector<const MirrorPlane*> reached;
    for (const MirrorPlane& plane : planes_)
      for (std::size_t k = 0; k < cells.size(); ++k)
        if (piece[k] == main - sums.begin() && reaches(plane, cells[k], level)) {
          reached.push_back(&plane);
          break;
        }
    return projected((1 / main->area) * main->moment, reached);
  }

  /// Whether a level cuts an edge of a cell that lies in a plane.
  bool reaches(const MirrorPlane& plane, int cell, double level) const {
    const auto f = values(cell, level);
    bool below = false, above = false;
    for (int i = 0; i <= Dim; ++i)
      if (plane.holds[part_.cells[cell][i]] != 0) (f[i] < 0 ? below : above) = true;
    return below && above;
  }

  const Submesh<Dim, Order>& part_;
  std::vector<double> h_;
  bool turned_;
  const std::vector<MirrorPlane>& planes_;
};

/// Edge of a regular cell of the mean volume, mm.
template <int Dim, int Order>
double mean_edge(const Submesh<Dim, Order>& part) {
  double volume = 0;
  for (const auto& cell : part.cells) {
    std::array<Point, Dim + 1> x;
    for (int i = 0; i <= Dim; ++i) x[i] = part.nodes[cell[i]];
    volume += std::abs(simplex_volume<Dim>(x.data()));
  }
  const double each = volume / static_cast<double>(part.cells.size());
  return Dim == 3 ? std::cbrt(6 * std::sqrt(2.0) * each) : std::sqrt(4 / std::sqrt(3.0) * each);
}

/// Drops points that coincide with the one before: no direction leads from one to the other.
std::vector<Point> distinct(const std::vector<Point>& points) {
  std::vector<Point> kept;
  double size = 0;
  for (const Point& x : points) size = std::max(size, distance(x, points.front()));
  for (const Point& x : points)
    if (kept.empty() || distance(x, kept.back()) > 1e-9 * size) kept.push_back(x);
  if (kept.size() < 2) not_found("its ends lie in one place");
  return kept;
}

}  // namespace

template <int Dim, int Order>
CurvePoints centre_line(const Submesh<Dim, Order>& part, const std::vector<typename Submesh<Dim, Order>::Facet>& from,
                        const std::vector<typename Submesh<Dim, Order>::Facet>& to, int count, bool turned,
                        const std::vector<MirrorPlane>& planes) {
  const Levels<Dim, Order> surfaces(
      part, harmonic_coordinate<Dim>(part.nodes, vertices_of_cells(part), facet_nodes(from), facet_nodes(to), turned),
      turned, planes);
  std::vector<double> levels = evenly_spaced(0, 1, first_levels);
  levels.front() = end_level;
  levels.back() = 1 - end_level;
  const auto rough = surfaces.centroids(levels);
  std::vector<double> reached{0};
  for (std::size_t k = 1; k < rough.size(); ++k) reached.push_back(reached[k - 1] + distance(rough[k], rough[k - 1]));

  // Levels at equal distances along the rough curve.
  const int pieces = std::clamp(static_cast<int>(std::lround(reached.back() / mean_edge(part))), 2, most_levels);
  std::vector<double> even;
  for (int k = 0; k <= pieces; ++k) {
    const double s = reached.back() * k / pieces;
    std::size_t at = 1;
    while (at + 1 < reached.size() && reached[at] < s) ++at;
    const double stretch = reached[at] - reached[at - 1];
    const double t = stretch > 0 ? std::clamp((s - reached[at - 1]) / stretch, 0.0, 1.0) : 0;
    const double level = (1 - t) * levels[at - 1] + t * levels[at];
    if (even.empty() || level > even.back()) even.push_back(level);
  }
  const SmoothCurve curve(distinct(surfaces.centroids(even)));
  CurvePoints line;
  line.s = evenly_spaced(0, curve.length(), count);
  for (const double s : line.s) line.at.push_back(curve.at(s));
  return line;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                                                                \
  template CurvePoints centre_line(const Submesh<Dim, Order>&, const std::vector<Submesh<Dim, Order>::Facet>&, \
                                   const std::vector<Submesh<Dim, Order>::Facet>&, int, bool,                  \
                                   const std::vector<MirrorPlane>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
