#include "sampling/plane_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/nodal_layout.hpp"
#include "math/pi.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_distance.hpp"
#include "sampling/level_cut.hpp"

namespace fsi {

namespace {

constexpr double rounding = 1e-12;  // of the part's size: nodes this near to the plane lie on it
constexpr int most_vertices = 4;    // of a cell

/// Integrals over pieces of the plane.
struct Sums {
  double flow = 0, area = 0;
  double pressure = 0;  ///< times area

  PlaneRow row() const { return {flow, area > 0 ? pressure / area : 0, area}; }
};

/// A connected piece of the cut, as far as a process has it.
struct SeenPiece {
  double away = std::numeric_limits<double>::infinity();  ///< from the plane's origin, mm
  Sums sums;
};

template <int Dim, int Order>
class PlaneCutOf : public PlaneCut {
  using Part = Submesh<Dim, Order>;
  using Cell = typename Part::Cell;
  using Values = std::array<double, nodes_of_simplex(Dim, Order)>;
  using Map = CellMap<Dim, Order>;

 public:
  PlaneCutOf(const Part& part, const Point& origin, const Point& normal, bool turned)
      : nodes_(part.nodes), cells_(part.cells), origin_(origin), normal_(normal), turned_(turned) {
    for (int k = 0; k < Dim; ++k) axes_[k] = Dim == 2 && turned ? 2 * k : k;
    const Point corner = part.nodes.empty() ? Point{0, 0, 0} : part.nodes.front();
    for (const Point& x : part.nodes) size_ = std::max(size_, distance(x, corner));
    // Where the plane lies on a face of the part there are cells on one side only: zeros belong to the other.
    side_ = 1;
    if (cut_cells(distances(nodes_)).empty()) side_ = -1;
  }

  bool cuts_at_rest() const { return !cut_cells(distances(nodes_)).empty(); }

  /// The plane of `other` through a share of its part, with the side and size that hold for the whole part.
  PlaneCutOf(const PlaneCutOf& other, const Part& here)
      : nodes_(here.nodes),
        cells_(here.cells),
        here_(&here),
        origin_(other.origin_),
        normal_(other.normal_),
        turned_(other.turned_),
        side_(other.side_),
        size_(other.size_),
        axes_(other.axes_) {}

  std::shared_ptr<const PlaneCut> through(const PartNodes& here) const override {
    return std::make_shared<const PlaneCutOf>(*this, static_cast<const Part&>(here));
  }

  PlaneRow look(const std::vector<double>& mesh, const std::vector<double>& fluid) const override {
    const auto x = moved(mesh);
    const auto f = distances(*x);
    const auto cut = cut_cells(f);
    if (cut.empty()) return {};
    const auto piece = pieces_of_cut<Dim, Order>(cells_, cut, [&](int cell) { return control_values(f, cell); });
    return integrals(*x, f, cut, piece, nearest_piece(*x, f, cut, piece), fluid).row();
  }

  /// Appends the number of pieces; for each its distance and its sums over the cells counted here; the number of cut
  /// cells that other processes have, too; for each the numbers of its vertices in the whole part, and its piece.
  void say(const std::vector<double>& mesh, const std::vector<double>& fluid,
           std::vector<double>& said) const override {
    const auto x = moved(mesh);
    const auto f = distances(*x);
    const auto cut = cut_cells(f);
    const auto piece = pieces_of_cut<Dim, Order>(cells_, cut, [&](int cell) { return control_values(f, cell); });
    std::vector<SeenPiece> seen(cut.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1);
    std::vector<double> shared;
    for (std::size_t p = 0; p < seen.size(); ++p) {
      nearest_piece(*x, f, cut, piece, static_cast<int>(p), seen[p].away);
      seen[p].sums = integrals(*x, f, cut, piece, static_cast<int>(p), fluid);
    }
    for (std::size_t k = 0; k < cut.size(); ++k) {
      if (!here_->share) continue;
      const Cell& cell = cells_[cut[k]];
      if (std::all_of(cell.begin(), cell.end(), [&](int node) { return here_->owns(node); })) continue;
      std::array<int, most_vertices> vertices;
      vertices.fill(-1);
      for (int a = 0; a <= Dim; ++a) vertices[a] = here_->share->whole_node[cell[a]];
      shared.insert(shared.end(), vertices.begin(), vertices.end());
      shared.push_back(piece[k]);
    }
    said.push_back(static_cast<double>(seen.size()));
    for (const SeenPiece& one : seen)
      said.insert(said.end(), {one.away, one.sums.flow, one.sums.area, one.sums.pressure});
    const std::size_t cells = shared.size() / (most_vertices + 1);
    said.push_back(static_cast<double>(cells));
    said.insert(said.end(), shared.begin(), shared.end());
  }

 private:
  /// Where the nodes are now.
  std::shared_ptr<const std::vector<Point>> moved(const std::vector<double>& mesh) const {
    if (mesh.empty()) return {std::shared_ptr<void>(), &nodes_};
    auto now = std::make_shared<std::vector<Point>>(nodes_);
    for (std::size_t a = 0; a < now->size(); ++a)
      for (int k = 0; k < Dim; ++k) (*now)[a][axes_[k]] += mesh[VectorLayout<Dim>::vector(static_cast<int>(a), k)];
    return now;
  }
  /// Sums over the cells of a piece that are counted here.
  Sums integrals(const std::vector<Point>& x, const std::vector<double>& f, const std::vector<int>& cut,
                 const std::vector<int>& piece, int chosen, const std::vector<double>& fluid) const {
    Sums sums;
    double pressure = 0;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      if (piece[k] != chosen || !is_counted(cut[k])) continue;
      const Cell& cell = cells_[cut[k]];
      const Map map = map_of(x, cut[k]);
      cut_cell<Dim, Order>(at_cell(f, cut[k]), [&](const CutPiece<Dim>& part) {
        for_points_of<Dim, Order>(part, map, [&](const CutPoint<Dim>& point) {
          const double weight = side_ * (turned_ ? 2 * pi * point.at[0] : 1);
          const auto shape = Map::shape(point.place);
          for (std::size_t a = 0; a < cell.size(); ++a)
            for (int c = 0; c < Dim; ++c)
              sums.flow += weight * shape[a] * point.area[axes_[c]] * fluid[MixedLayout<Dim>::vector(cell[a], c)];
          const double area = weight * dot(point.area, normal_);
          sums.area += area;
          for (int a = 0; a <= Dim; ++a) pressure += area * point.place[a] * fluid[MixedLayout<Dim>::scalar(cell[a])];
        });
      });
    }
    sums.pressure = pressure;
    return sums;
  }
  bool is_counted(int cell) const { return !here_ || here_->counted.empty() || here_->counted[cell] != 0; }
  Map map_of(const std::vector<Point>& x, int cell) const {
    Map map;
    for (std::size_t i = 0; i < map.x.size(); ++i) map.x[i] = x[cells_[cell][i]];
    return map;
  }
  /// Distances of the nodes from the plane, mm, 0 on it; positive on the side that zeros belong to.
  std::vector<double> distances(const std::vector<Point>& x) const {
    std::vector<double> f(x.size());
    for (std::size_t a = 0; a < x.size(); ++a) {
      f[a] = side_ * dot(normal_, x[a] - origin_);
      if (std::abs(f[a]) <= rounding * size_) f[a] = 0;
    }
    return f;
  }
  Values at_cell(const std::vector<double>& f, int cell) const {
    Values values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = f[cells_[cell][i]];
    return values;
  }
  /// Numbers that bound the distance in a cell: in a quadratic one its Bezier coefficients.
  Values control_values(const std::vector<double>& f, int cell) const {
    Values values = at_cell(f, cell);
    if constexpr (Order == 2)
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        double& middle = values[Dim + 1 + e];
        middle = 2 * middle - 0.5 * (values[a] + values[b]);
      }
    return values;
  }
  std::vector<int> cut_cells(const std::vector<double>& f) const {
    std::vector<int> cut;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const Values values = control_values(f, static_cast<int>(c));
      const auto below = std::count_if(values.begin(), values.end(), [](double value) { return value < 0; });
      if (below > 0 && below < static_cast<std::ptrdiff_t>(values.size())) cut.push_back(static_cast<int>(c));
    }
    return cut;
  }
  int nearest_piece(const std::vector<Point>& x, const std::vector<double>& f, const std::vector<int>& cut,
                    const std::vector<int>& piece) const {
    double least = std::numeric_limits<double>::infinity();
    return nearest_piece(x, f, cut, piece, -1, least);
  }
  /// The piece nearest to the origin. \param alone  the only one to consider; negative: all
  /// \param least  distance that it must be below, mm; becomes its distance
  int nearest_piece(const std::vector<Point>& x, const std::vector<double>& f, const std::vector<int>& cut,
                    const std::vector<int>& piece, int alone, double& least) const {
    int nearest = 0;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      if (alone >= 0 && piece[k] != alone) continue;
      const Map map = map_of(x, cut[k]);
      cut_cell<Dim, Order>(at_cell(f, cut[k]), [&](const CutPiece<Dim>& part) {
        const auto& c = part.corners;
        double away = distance(origin_, map.at(c[0]));
        double over = 0;  // NaN for pieces without extent
        if constexpr (Dim == 3)
          over = distance_to_triangle(origin_, map.at(c[0]), map.at(c[1]), map.at(c[2]));
        else
          over = distance_to_segment(origin_, map.at(c[0]), map.at(c[1]));
        if (over < away) away = over;
        if (away >= least) return;
        least = away;
        nearest = piece[k];
      });
    }
    return nearest;
  }

  const std::vector<Point>& nodes_;  ///< of the part
  const std::vector<Cell>& cells_;
  const Part* here_ = nullptr;  ///< of a share of the part
  Point origin_, normal_;
  bool turned_;
  double side_ = 1, size_ = 0;
  std::array<int, Dim> axes_{};  ///< of space, that components lie along
};

}  // namespace

std::vector<PlaneRow> look_at(const std::vector<const PlaneCut*>& planes, const std::vector<double>& mesh,
                              const std::vector<double>& fluid, const Communicator& processes) {
  if (!processes.is_alone()) return rows_of_messages(processes.gather(message_on(planes, mesh, fluid)), planes.size());
  std::vector<PlaneRow> rows;
  for (const PlaneCut* plane : planes) rows.push_back(plane->look(mesh, fluid));
  return rows;
}

std::vector<double> message_on(const std::vector<const PlaneCut*>& planes, const std::vector<double>& mesh,
                               const std::vector<double>& fluid) {
  std::vector<double> message{0};
  for (const PlaneCut* plane : planes) plane->say(mesh, fluid, message);
  message[0] = static_cast<double>(message.size());
  return message;
}

std::vector<PlaneRow> rows_of_messages(const std::vector<double>& messages, std::size_t planes) {
  std::vector<std::size_t> at;  // per process, where its message continues
  for (std::size_t first = 0; first < messages.size(); first += static_cast<std::size_t>(messages[first]))
    at.push_back(first + 1);
  using SharedCell = std::array<int, most_vertices + 1>;  // vertices, piece among those of all processes
  std::vector<PlaneRow> rows;
  for (std::size_t plane = 0; plane < planes; ++plane) {
    std::vector<SeenPiece> seen;
    std::vector<SharedCell> shared;
    for (std::size_t& next : at) {
      const int first = static_cast<int>(seen.size());
      for (auto count = static_cast<std::size_t>(messages[next++]); count > 0; --count, next += 4)
        seen.push_back({messages[next], {messages[next + 1], messages[next + 2], messages[next + 3]}});
      for (auto count = static_cast<std::size_t>(messages[next++]); count > 0; --count) {
        SharedCell cell;
        for (int& number : cell) number = static_cast<int>(messages[next++]);
        cell.back() += first;
        shared.push_back(cell);
      }
    }
    std::sort(shared.begin(), shared.end());
    DisjointSets sets(seen.size());
    for (std::size_t i = 1; i < shared.size(); ++i)
      if (std::equal(shared[i].begin(), shared[i].end() - 1, shared[i - 1].begin()))
        sets.join(shared[i].back(), shared[i - 1].back());
    int nearest = 0;
    for (std::size_t i = 1; i < seen.size(); ++i)
      if (seen[i].away < seen[nearest].away) nearest = static_cast<int>(i);
    Sums sums;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (sets.root(static_cast<int>(i)) != sets.root(nearest)) continue;
      sums.flow += seen[i].sums.flow;
      sums.area += seen[i].sums.area;
      sums.pressure += seen[i].sums.pressure;
    }
    rows.push_back(sums.row());
  }
  return rows;
}

template <int Dim, int Order>
std::shared_ptr<const PlaneCut> plane_cut(const Submesh<Dim, Order>& part, const Point& origin, const Point& normal,
                                          bool turned) {
  Point in_plane = normal;
  if constexpr (Dim == 2) in_plane[turned ? 1 : 2] = 0;
  const double length = norm(in_plane);
  if (!(length > 0)) return nullptr;
  auto cut = std::make_shared<const PlaneCutOf<Dim, Order>>(part, origin, (1 / length) * in_plane, turned);
  if (!cut->cuts_at_rest()) return nullptr;
  return cut;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order) \
  template std::shared_ptr<const PlaneCut> plane_cut(const Submesh<Dim, Order>&, const Point&, const Point&, bool);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
