#include "mesher/column_tops.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesher/prism_columns.hpp"

namespace fsi {

namespace {

constexpr double poor = 0.35;    // mean ratio over that of the upright prism, below which tops are moved
constexpr double sharpness = 8;  // of the soft minimum
constexpr double most_exponent = 60;
constexpr double gain = 5e-3;  // of the penalty, below which a move is none

/// The tops of columns, and the quality of the prisms below them.
class SlidingTops {
 public:
  /// \param height  part of the thickness that the columns have
  SlidingTops(const ColumnGround& ground, const OffsetDistance& offset, std::vector<Point> tops, double height)
      : ground_(ground),
        offset_(offset),
        height_(height),
        tops_(std::move(tops)),
        around_(tops_.size()),
        beside_(tops_.size()) {
    for (std::size_t f = 0; f < ground.facets.size(); ++f) {
      const auto& facet = ground.facets[f];
      for (int k = 0; k < 3; ++k) {
        around_[facet[k]].push_back(static_cast<int>(f));
        beside_[facet[k]].insert(facet[(k + 1) % 3]);
        beside_[facet[k]].insert(facet[(k + 2) % 3]);
      }
      upright_.push_back(quality_of_upright(facet));
    }
    for (std::size_t i = 0; i < tops_.size(); ++i) {
      double sum = 0;
      for (const int other : beside_[i]) sum += distance(ground.nodes[i], ground.nodes[other]);
      step_.push_back(first_step * sum / static_cast<double>(beside_[i].size()));
      shortest_.push_back(shortest_step * step_.back());
    }
    for (std::size_t f = 0; f < ground.facets.size(); ++f) quality_.push_back(quality(static_cast<int>(f)));
  }

  /// Moves the tops of poor prisms and those around them half way to the mean of their neighbours', all at once, 4
  /// times.
  void spread() {
    constexpr int times = 4;
    for (int i = 0; i < times; ++i) {
      const auto movable = around_poor_prisms();
      const auto before = tops_;
      for (const int node : movable) {
        if (ground_.planes[node].size() > 1) continue;
        Point middle{0, 0, 0};
        for (const int other : beside_[node])
          middle = middle + (1 / static_cast<double>(beside_[node].size())) * before[other];
        const auto& planes = ground_.planes[node];
        tops_[node] = offset_.onto(before[node] + 0.5 * in_planes(middle - before[node], planes), height_, planes);
      }
      for (std::size_t f = 0; f < ground_.facets.size(); ++f) quality_[f] = quality(static_cast<int>(f));
    }
  }

  /// Moves tops until no prism is poor or no move helps. Returns the smallest quality.
  double slide() {
    constexpr int most_rounds = 100;
    for (int round = 0; round < most_rounds; ++round) {
      const auto movable = around_poor_prisms();
      if (movable.empty()) break;
      bool moved = false;
      for (const int node : movable) moved = better(node) || moved;
      if (!moved) break;
    }
    return *std::min_element(quality_.begin(), quality_.end());
  }

  const std::vector<Point>& tops() const { return tops_; }

 private:
  static constexpr double first_step = 0.4;      // of the mean edge
  static constexpr double shortest_step = 0.03;  // of the first

  Point level(int node, std::size_t number) const {
    if (number == 0) return ground_.nodes[node];
    return ground_.nodes[node] + ground_.levels[number - 1] * (tops_[node] - ground_.nodes[node]);
  }

  /// visit(mean ratio over the upright prism's) for each tetrahedron of a facet's column.
  template <class Visit>
  void each_cell(int f, Visit visit) const {
    const auto& facet = ground_.facets[f];
    const int count = static_cast<int>(ground_.nodes.size());
    const auto cells = prism_cells(facet, {facet[0] + count, facet[1] + count, facet[2] + count});
    for (std::size_t step = 0; step < ground_.levels.size(); ++step)
      for (const auto& cell : cells) {
        std::array<Point, 4> corners;
        for (int a = 0; a < 4; ++a) corners[a] = level(cell[a] % count, cell[a] < count ? step : step + 1);
        visit(mean_ratio(corners) / upright_[f][step]);
      }
  }

  double quality(int f) const {
    double least = std::numeric_limits<double>::infinity();
    each_cell(f, [&](double ratio) { least = std::min(least, ratio); });
    return least;
  }

  /// Penalty of a top for the cells around it: large where one is poor.
  double penalty(int node) const {
    double sum = 0;
    for (const int f : around_[node])
      each_cell(f, [&](double ratio) { sum += std::exp(std::min(-sharpness * ratio, most_exponent)); });
    return sum;
  }

  std::vector<double> quality_of_upright(const std::array<int, 3>& facet) const {
    std::array<Point, 3> below{};
    double thickness = 0;
    for (int k = 0; k < 3; ++k) {
      below[k] = ground_.nodes[facet[k]];
      thickness += height_ * ground_.thickness[facet[k]] / 3;
    }
    const Point area = cross(below[1] - below[0], below[2] - below[0]);
    std::vector<double> least;
    double reached = 0;
    for (const double next : ground_.levels) {
      const Point up = ((next - reached) * thickness / norm(area)) * area;
      reached = next;
      double smallest = std::numeric_limits<double>::infinity();
      for (const auto& cell : prism_cells({0, 1, 2}, {3, 4, 5})) {
        std::array<Point, 4> corners;
        for (int a = 0; a < 4; ++a) corners[a] = cell[a] < 3 ? below[cell[a]] : below[cell[a] - 3] + up;
        smallest = std::min(smallest, mean_ratio(corners));
      }
      least.push_back(smallest);
    }
    return least;
  }

  /// Nodes of poor prisms and those beside them, ascending.
  std::set<int> around_poor_prisms() const {
    std::set<int> nodes;
    for (std::size_t f = 0; f < ground_.facets.size(); ++f)
      if (quality_[f] < poor)
        for (const int node : ground_.facets[f]) {
          nodes.insert(node);
          nodes.insert(beside_[node].begin(), beside_[node].end());
        }
    return nodes;
  }

  /// Moves a top to the best of some places around it: the mean of its neighbours', half of the way there, and those
  /// one step away. Halves the step where none is better; false once it is too short.
  bool better(int node) {
    const auto& planes = ground_.planes[node];
    if (planes.size() > 1) return false;
    const Point here = tops_[node];
    const auto place = offset_.at(here);
    const double now = penalty(node);
    Point middle{0, 0, 0};
    for (const int other : beside_[node])
      middle = middle + (1 / static_cast<double>(beside_[node].size())) * tops_[other];
    std::vector<Point> ways{middle - here, 0.5 * (middle - here)};
    const auto [first, second] = tangents(place.away, planes);
    for (const double sign : {1.0, -1.0}) {
      ways.push_back(sign * step_[node] * first);
      if (!planes.empty()) continue;
      ways.push_back(sign * step_[node] * second);
      for (const double other : {1.0, -1.0}) ways.push_back(0.7 * step_[node] * (sign * first + other * second));
    }
    Point best = here;
    double least = (1 - gain) * now;
    for (const Point& way : ways) {
      tops_[node] = offset_.onto(here + in_planes(way, planes), height_, planes, place.facet);
      if (const double found = penalty(node); found < least) {
        least = found;
        best = tops_[node];
      }
    }
    tops_[node] = best;
    if (least < (1 - gain) * now) {
      for (const int f : around_[node]) quality_[f] = quality(f);
      return true;
    }
    if (step_[node] < shortest_[node]) return false;
    step_[node] *= 0.5;
    return true;
  }

  /// Two unit vectors along the offset surface; in a plane the first lies in it.
  static std::pair<Point, Point> tangents(const Point& away, const std::vector<Point>& planes) {
    Point first;
    if (planes.empty()) {
      const auto least =
          std::min_element(away.begin(), away.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
      Point axis{0, 0, 0};
      axis[least - away.begin()] = 1;
      first = cross(away, axis);
    } else {
      first = cross(away, planes.front());
    }
    first = (1 / std::max(norm(first), 1e-300)) * first;
    return {first, cross(away, first)};
  }

  const ColumnGround& ground_;
  const OffsetDistance& offset_;
  double height_;
  std::vector<Point> tops_;
  std::vector<std::vector<int>> around_;      // facets of each node
  std::vector<std::set<int>> beside_;         // neighbours of each node
  std::vector<std::vector<double>> upright_;  // smallest mean ratio of the upright prism, per facet and level
  std::vector<double> step_, shortest_;       // mm
  std::vector<double> quality_;               // of each facet's column
};

}  // namespace

std::vector<Point> column_tops(const ColumnGround& ground, const OffsetDistance& offset) {
  constexpr int rises = 10;
  const auto raised = [&](double reach, const auto& top_of) {
    std::vector<Point> tops;
    for (std::size_t i = 0; i < ground.nodes.size(); ++i)
      tops.push_back(offset.onto(top_of(i), reach, ground.planes[i]));
    return tops;
  };
  const auto along_normals = [&](double reach) {
    return raised(reach, [&](std::size_t i) {
      return offset.along(ground.nodes[i], ground.normals[i], ground.thickness[i], reach);
    });
  };
  SlidingTops at_once(ground, offset, along_normals(1), 1);
  if (at_once.slide() > 0) return at_once.tops();
  // In small rises, each from where the one before slid to.
  std::vector<Point> tops;
  for (int rise = 1; rise <= rises; ++rise) {
    const double reach = static_cast<double>(rise) / rises;
    SlidingTops rising(ground, offset,
                       rise == 1 ? along_normals(reach) : raised(reach, [&](std::size_t i) { return tops[i]; }), reach);
    rising.spread();
    rising.slide();
    tops = rising.tops();
  }
  return tops;
}

std::vector<Point> column_levels(const Point& bottom, const Point& top, const std::vector<double>& levels,
                                 const OffsetDistance& offset) {
  constexpr double exact = 1e-3;
  constexpr int halvings = 24;
  const double whole = offset.at(top).reach();
  std::vector<Point> column;
  double lower = 0;
  for (const double level : levels) {
    const auto point = [&](double part) { return bottom + part * (top - bottom); };
    const auto missing = [&](double part) { return level * whole - offset.at(point(part)).reach(); };
    double part = level;
    if (level < 1 && std::abs(missing(level)) > exact * level) {
      double upper = 1;
      for (int i = 0; i < halvings; ++i) {
        part = 0.5 * (lower + upper);
        (missing(part) > 0 ? lower : upper) = part;
      }
    }
    lower = part;
    column.push_back(point(part));
  }
  return column;
}

}  // namespace fsi
