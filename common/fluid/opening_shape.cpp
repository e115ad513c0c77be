#include "fluid/opening_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "fem/facet_load.hpp"
#include "mesh/boundary.hpp"
#include "mesh/point_math.hpp"
#include "mesh/surface_pieces.hpp"

namespace fsi {

namespace {

/// The mean normal into the fluid; components that are rounding are zero, so that nothing passes planes of symmetry.
template <class Element>
Point mean_inward(const InflowOpening<Element>& opening, const std::vector<int>& nodes) {
  constexpr int n = Element::components;
  const auto weights = normal_weights<Element, VectorLayout<n>>(opening.nodes, opening.facets);
  Point inward{0, 0, 0};
  for (const int a : nodes)
    for (int k = 0; k < n; ++k) inward[Element::axis[k]] -= weights[VectorLayout<n>::vector(a, k)];
  const auto areas = nodal_areas<Element>(opening.nodes, opening.facets);
  double area = 0;
  for (const int a : nodes) area += areas[a];
  const double length = norm(inward);
  if (!(length > 1e-6 * area)) {
    const SurfacePieces pieces = pieces_of<Element::dim>(opening.nodes, opening.facets);
    const bool apart = pieces.pieces.size() > 1;
    throw InputError(opening.file, "opening." + opening.name,
                     "this surface has no mean normal for the flow to follow" +
                         (apart ? ": it " + said_of<Element::dim>(pieces) : std::string()),
                     apart ? "give each opening a surface and an [[opening]] of its own"
                           : "take a flow rate through a surface that does not surround the fluid");
  }
  for (double& component : inward) component = std::abs(component) < 1e-10 * length ? 0.0 : component / length;
  return (1 / norm(inward)) * inward;
}

/// A point of the rim, with its neighbour and what lies between them.
struct RimEdge {
  int from, to, middle;  ///< the middle -1 where the edge has no node there, or is straight
};

/// Edges that only one facet has.
template <class Element>
std::vector<RimEdge> rim_edges(const InflowOpening<Element>& opening) {
  std::map<std::pair<int, int>, std::pair<int, RimEdge>> uses;
  for (const auto& facet : opening.facets)
    for (int i = 0; i < 3; ++i) {
      const int a = facet[i], b = facet[(i + 1) % 3];
      int middle = -1;
      if constexpr (Element::order == 2) {
        const auto& x = opening.nodes;
        const Point chord = 0.5 * (x[a] + x[b]);
        if (distance(x[facet[3 + i]], chord) > 1e-6 * distance(x[a], x[b])) middle = facet[3 + i];
      }
      auto& [count, edge] = uses[std::minmax(a, b)];
      ++count;
      edge = {a, b, middle};
    }
  std::vector<RimEdge> rim;
  for (const auto& [ends, use] : uses)
    if (use.first == 1) rim.push_back(use.second);
  return rim;
}

/// Solves A x = b of three equations, A symmetric and positive; false when it is singular.
bool solve(std::array<Point, 3> a, Point b, Point& x) {
  const double scale = std::abs(dot(a[0], cross(a[1], a[2])));
  double size = 1;
  for (const auto& row : a) size *= norm(row);
  if (!(scale > 1e-10 * size)) return false;
  const double determinant = dot(a[0], cross(a[1], a[2]));
  const Point c0 = cross(a[1], a[2]), c1 = cross(a[2], a[0]), c2 = cross(a[0], a[1]);
  x = (1 / determinant) * (b[0] * c0 + b[1] * c1 + b[2] * c2);
  return true;
}

/// The circle in the plane normal to `normal` that fits points best: least squares of |x - c|^2 - R^2 [Kasa1976].
bool fit_circle(const std::vector<Point>& points, const Point& normal, Point& centre, double& radius) {
  Point origin{0, 0, 0};
  for (const auto& x : points) origin = origin + (1.0 / static_cast<double>(points.size())) * x;
  // Axes of the plane.
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) < std::abs(normal[least])) least = i;
  Point along{0, 0, 0};
  along[least] = 1;
  Point e1 = cross(normal, along);
  e1 = (1 / norm(e1)) * e1;
  const Point e2 = cross(normal, e1);
  double size = 0;
  for (const auto& x : points) size = std::max(size, distance(x, origin));
  if (!(size > 0)) return false;
  // s^2 + t^2 = 2 a s + 2 b t + c
  std::array<Point, 3> matrix{};
  Point right{0, 0, 0};
  for (const auto& x : points) {
    const double s = dot(x - origin, e1) / size, t = dot(x - origin, e2) / size;
    const Point row{2 * s, 2 * t, 1};
    for (int i = 0; i < 3; ++i) matrix[i] = matrix[i] + row[i] * row;
    right = right + (s * s + t * t) * row;
  }
  Point solution;
  if (!solve(matrix, right, solution)) return false;
  const double square = solution[2] + solution[0] * solution[0] + solution[1] * solution[1];
  if (!(square > 0)) return false;
  centre = origin + size * (solution[0] * e1 + solution[1] * e2);
  radius = size * std::sqrt(square);
  return true;
}

/// Of three dimensions.
template <class Element>
void find_circle(const InflowOpening<Element>& opening, const std::vector<int>& nodes, OpeningShape& shape) {
  const auto& x = opening.nodes;
  const auto edges = rim_edges(opening);
  std::vector<Point> points;
  for (const auto& edge : edges)
    if (opening.sticking[edge.from] && opening.sticking[edge.to]) {
      points.push_back(x[edge.from]);
      points.push_back(x[edge.to]);
      if (edge.middle >= 0) points.push_back(x[edge.middle]);
    }
  Point centre;
  double radius = 0;
  if (points.size() < 4 || !fit_circle(points, shape.inward, centre, radius)) return;
  const double miss = OpeningShape::tolerance * radius;
  for (const int a : nodes)
    if (std::abs(dot(x[a] - centre, shape.inward)) > miss) return;
  for (const auto& point : points)
    if (std::abs(distance(point, centre) - radius) > miss) return;
  for (const int a : nodes)  // no wall but on the rim
    if (opening.sticking[a] && distance(x[a], centre) < radius * std::cos(0.5 * OpeningShape::largest_step) - miss)
      return;
  for (const auto& edge : edges) {
    const Point a = x[edge.from] - centre, b = x[edge.to] - centre;
    if (opening.sticking[edge.from] && opening.sticking[edge.to]) {
      const double angle = std::acos(std::clamp(dot(a, b) / (norm(a) * norm(b)), -1.0, 1.0));
      if (angle > (edge.middle >= 0 ? 2 : 1) * OpeningShape::largest_step) return;
      if (dot(cross(a, b), shape.inward) >= 0) return;  // the fluid is outside: a hole in the opening
    } else if (norm(cross(a, b)) > miss * distance(a, b)) {
      return;  // a free side that does not point at the centre
    }
  }
  shape.kind = OpeningShape::Kind::circle;
  shape.centre = centre;
  shape.radius = radius;
}

/// Of three dimensions.
template <class Element>
std::optional<OpeningRectangle> find_rectangle(const InflowOpening<Element>& opening, const Point& inward) {
  const auto& x = opening.nodes;
  const auto nodes = facet_nodes(opening.facets);
  const auto rim = rim_edges(opening);
  const auto wall = std::find_if(rim.begin(), rim.end(), [&](const RimEdge& edge) {
    return opening.sticking[edge.from] && opening.sticking[edge.to];
  });
  if (wall == rim.end()) return std::nullopt;
  OpeningRectangle found;
  found.sides[0].along = (1 / distance(x[wall->from], x[wall->to])) * (x[wall->to] - x[wall->from]);
  found.sides[1].along = cross(inward, found.sides[0].along);
  double area = 1;
  for (auto& side : found.sides) {
    side.from = side.to = dot(x[nodes.front()], side.along);
    for (const int a : nodes) {
      side.from = std::min(side.from, dot(x[a], side.along));
      side.to = std::max(side.to, dot(x[a], side.along));
    }
    area *= side.to - side.from;
  }
  double covered = 0;
  for (const double of_node : nodal_areas<Element>(x, opening.facets)) covered += of_node;
  if (!(std::abs(covered - area) < OpeningShape::tolerance * area)) return std::nullopt;
  const double miss = 1e-4 * std::sqrt(area);
  std::vector<char> on_wall(x.size(), 0);
  for (auto& side : found.sides)
    for (const bool last : {false, true}) {
      const double end = last ? side.to : side.from;
      std::vector<int> there;
      for (const int a : nodes)
        if (std::abs(dot(x[a], side.along) - end) < miss) there.push_back(a);
      bool& walled = last ? side.last_walled : side.first_walled;
      walled = std::all_of(there.begin(), there.end(), [&](int a) { return opening.sticking[a] != 0; });
      if (walled)
        for (const int a : there) on_wall[a] = 1;
    }
  for (const int a : nodes) {
    if (opening.sticking[a] && !on_wall[a]) return std::nullopt;
    if (std::abs(dot(x[a] - x[nodes.front()], inward)) > miss) return std::nullopt;
  }
  return found;
}

/// Of triangle meshes, whose facets are edges.
template <class Element>
void find_segment(const InflowOpening<Element>& opening, const std::vector<int>& nodes, OpeningShape& shape) {
  const auto& x = opening.nodes;
  const auto ends = rim_nodes<2>(opening.facets);
  if (ends.size() != 2) return;
  int first = ends[0], last = ends[1];
  if (Element::axisymmetric ? x[first][0] > x[last][0] : opening.sticking[first] && !opening.sticking[last])
    std::swap(first, last);
  const double length = distance(x[first], x[last]);
  const double miss = OpeningShape::tolerance * length;
  for (const int a : nodes)
    if (std::abs(dot(x[a] - x[first], shape.inward)) > miss) return;
  for (const int a : nodes)  // no wall but at the ends
    if (opening.sticking[a] && a != first && a != last) return;
  if (!opening.sticking[last]) return;
  if constexpr (Element::axisymmetric) {
    const bool on_axis = x[first][0] < 1e-9 * length && !opening.sticking[first];
    if (!on_axis || std::abs(shape.inward[0]) > OpeningShape::tolerance) return;
    shape.kind = OpeningShape::Kind::circle;
    shape.centre = x[first];
    shape.radius = length;
  } else {
    const bool whole = opening.sticking[first];
    shape.kind = OpeningShape::Kind::segment;
    shape.centre = whole ? 0.5 * (x[first] + x[last]) : x[first];
    shape.radius = whole ? 0.5 * length : length;
  }
}

}  // namespace

template <class Element>
OpeningShape shape_of(const InflowOpening<Element>& opening) {
  OpeningShape shape;
  const auto nodes = facet_nodes(opening.facets);
  const auto sticking = std::count_if(nodes.begin(), nodes.end(), [&](int a) { return opening.sticking[a] != 0; });
  if (sticking == static_cast<std::ptrdiff_t>(nodes.size()))
    throw InputError(opening.file, "opening." + opening.name,
                     "the fluid sticks at every node of this surface, so that none can flow through it",
                     "refine the mesh there, so that nodes lie inside the opening");
  shape.walled = sticking > 0;
  shape.inward = mean_inward(opening, nodes);
  if constexpr (Element::dim == 3)
    find_circle(opening, nodes, shape);
  else
    find_segment(opening, nodes, shape);
  return shape;
}

double OpeningRectangle::Side::parabola(const Point& x) const {
  if (!first_walled && !last_walled) return 1;
  const double top = first_walled && last_walled ? 0.5 * (from + to) : first_walled ? to : from;
  const double s = (dot(x, along) - top) / (first_walled ? top - from : to - top);
  return 1 - s * s;
}

template <class Element>
std::optional<OpeningRectangle> rectangle_of(const InflowOpening<Element>& opening, const Point& inward) {
  if constexpr (Element::dim == 3)
    return find_rectangle(opening, inward);
  else
    return std::nullopt;
}

#define FSI_INSTANTIATE(Element)                                          \
  template OpeningShape shape_of<Element>(const InflowOpening<Element>&); \
  template std::optional<OpeningRectangle> rectangle_of<Element>(const InflowOpening<Element>&, const Point&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
