#include "sampling/plane_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/nodal_layout.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/point_distance.hpp"
#include "sampling/level_cut.hpp"

namespace fsi {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double rounding = 1e-12;  // of the part's size: nodes this near to the plane lie on it

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
    // On a face of the part there are cells on one side only: that is the side that is cut.
    side_ = 1;
    if (cut_cells(distances(nodes_)).empty()) side_ = -1;
  }

  bool cuts_at_rest() const { return !cut_cells(distances(nodes_)).empty(); }

  PlaneRow look(const std::vector<double>& mesh, const std::vector<double>& fluid) const override {
    std::vector<Point> moved;
    if (!mesh.empty()) {
      moved = nodes_;
      for (std::size_t a = 0; a < moved.size(); ++a)
        for (int k = 0; k < Dim; ++k) moved[a][axes_[k]] += mesh[VectorLayout<Dim>::vector(static_cast<int>(a), k)];
    }
    const auto& x = mesh.empty() ? nodes_ : moved;
    const auto f = distances(x);
    const auto cut = cut_cells(f);
    PlaneRow row;
    if (cut.empty()) return row;
    const auto piece = pieces_of_cut<Dim, Order>(cells_, cut, [&](int cell) { return control_values(f, cell); });
    const int chosen = nearest_piece(x, f, cut, piece);
    double pressure = 0;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      if (piece[k] != chosen) continue;
      const Cell& cell = cells_[cut[k]];
      const Map map = map_of(x, cut[k]);
      cut_cell<Dim, Order>(at_cell(f, cut[k]), [&](const CutPiece<Dim>& part) {
        for_points_of<Dim, Order>(part, map, [&](const CutPoint<Dim>& point) {
          const double weight = side_ * (turned_ ? 2 * pi * point.at[0] : 1);
          const auto shape = Map::shape(point.place);
          for (std::size_t a = 0; a < cell.size(); ++a)
            for (int c = 0; c < Dim; ++c)
              row.flow += weight * shape[a] * point.area[axes_[c]] * fluid[MixedLayout<Dim>::vector(cell[a], c)];
          const double area = weight * dot(point.area, normal_);
          row.area += area;
          for (int a = 0; a <= Dim; ++a) pressure += area * point.place[a] * fluid[MixedLayout<Dim>::scalar(cell[a])];
        });
      });
    }
    if (row.area > 0) row.pressure = pressure / row.area;
    return row;
  }

 private:
  Map map_of(const std::vector<Point>& x, int cell) const {
    Map map;
    for (std::size_t i = 0; i < map.x.size(); ++i) map.x[i] = x[cells_[cell][i]];
    return map;
  }
  /// Distances of the nodes from the plane, mm, those on it exactly 0; positive on the side that zeros belong to.
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
  /// Numbers between which the distance lies in a cell: in a quadratic one those of its Bezier form.
  Values control_values(const std::vector<double>& f, int cell) const {
    Values values = at_cell(f, cell);
    if constexpr (Order == 2)
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        double& middle = values[Dim + 1 + e];
        middle = 2 * middle - 0.5 * (values[a] + values[b]);
        if (std::abs(middle) <= 4 * rounding * size_) middle = 0;
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
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < cut.size(); ++k) {
      const Map map = map_of(x, cut[k]);
      cut_cell<Dim, Order>(at_cell(f, cut[k]), [&](const CutPiece<Dim>& part) {
        const auto& c = part.corners;
        double away = distance(origin_, map.at(c[0]));
        double over = 0;  // not a number in pieces without extent
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
  Point origin_, normal_;
  bool turned_;
  double side_ = 1, size_ = 0;
  std::array<int, Dim> axes_{};  ///< of space, that components lie along
};

}  // namespace

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
