#include "derived/surface_shape.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/facets.hpp"
#include "mesh/point_math.hpp"
#include "mesh/smooth_surface.hpp"

namespace fsi {

namespace {

constexpr double near_centre = 0.3;        // of the radius of curvature
constexpr double least_bend = 1e-6;        // of curvature times length
constexpr double left_by_bending = 0.003;  // of a curved surface's heights, at most, once it is straightened
constexpr double same_layer = 0.7;         // cosine of the angle between normals of one layer
constexpr double nearby_weight = 0.1;      // of weights, as those of GradientFit
constexpr double dependent_column = 1e-3;  // of the columns of a fit
constexpr int most_fit_steps = 20, most_surface_rings = 3;

/// A facet of the body's boundary.
struct OutsideFacet {
  std::vector<int> nodes;  ///< vertices first
  Point normal;            ///< outward, unit vector
};

/// Arc length and distance of (t, z) along and from the circle through the origin with centre (0, -1/curvature).
std::optional<std::pair<double, double>> unbent(double t, double z, double curvature) {
  const double radius = 1 / std::abs(curvature), side = curvature > 0 ? 1 : -1;
  const double height = radius + side * z, from_centre = std::hypot(t, height);
  if (!(from_centre > near_centre * radius)) return std::nullopt;
  // The distance is that from the centre less the radius, without cancellation.
  return std::pair(radius * std::atan2(t, height),
                   side * (t * t + z * z + 2 * side * z * radius) / (from_centre + radius));
}

std::array<Point, 2> tangents(const Point& normal, const std::vector<int>& axes) {
  if (axes.size() == 2) {
    Point t{};
    t[axes[0]] = -normal[axes[1]];
    t[axes[1]] = normal[axes[0]];
    return {t, Point{}};
  }
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
  Point axis{};
  axis[least] = 1;
  Point t = axis - dot(axis, normal) * normal;
  t = (1 / norm(t)) * t;
  return {t, cross(normal, t)};
}

/// The shape with a tensor of curvature in the tangent plane.
template <class Curvature>
SurfaceShape shape_of(const Point& normal, const std::vector<int>& axes, Curvature curvature) {
  const auto t = tangents(normal, axes);
  SurfaceShape shape{normal, {t[0], t[1]}, {0, 0}};
  if (axes.size() == 2) {
    shape.curvatures[0] = curvature(t[0], t[0]);
    return shape;
  }
  const double first = curvature(t[0], t[0]), both = curvature(t[0], t[1]), second = curvature(t[1], t[1]);
  Eigen::JacobiRotation<double> turn;  // (c, -s) and (s, c) are the principal directions
  turn.makeJacobi(first, both, second);
  const double change = both == 0 ? 0 : turn.s() / turn.c() * both, principal[2] = {first - change, second + change};
  const Point along[2] = {turn.c() * t[0] - turn.s() * t[1], turn.s() * t[0] + turn.c() * t[1]};
  const int flatter = std::abs(principal[0]) <= std::abs(principal[1]) ? 0 : 1;
  for (int i = 0; i < 2; ++i) {
    shape.directions[i] = along[i == 0 ? flatter : 1 - flatter];
    shape.curvatures[i] = principal[i == 0 ? flatter : 1 - flatter];
  }
  return shape;
}

double curvature_between(const SurfaceShape& shape, const Point& a, const Point& b) {
  double sum = 0;
  for (int i = 0; i < 2; ++i) sum += shape.curvatures[i] * dot(shape.directions[i], a) * dot(shape.directions[i], b);
  return sum;
}

/// The mirrors that nodes lie in, by number.
std::vector<std::vector<int>> mirrors_at(const RecoveryCells& cells) {
  std::vector<std::vector<int>> at(cells.points.size());
  for (std::size_t m = 0; m < cells.mirrors.size(); ++m)
    for (const int node : cells.mirrors[m].nodes) at[node].push_back(static_cast<int>(m));
  return at;
}

/// Facets that belong to one cell only, without those in planes of symmetry.
std::vector<OutsideFacet> boundary_of(const RecoveryCells& cells) {
  const auto dim = static_cast<int>(cells.axes.size());
  std::vector<std::vector<int>> places;
  const auto take = [&](const auto& table) {
    for (const auto& facet : table) places.emplace_back(facet.begin(), facet.end());
  };
  if (dim == 3)
    cells.order == 1 ? take(OutwardFacets<3, 1>::table) : take(OutwardFacets<3, 2>::table);
  else
    cells.order == 1 ? take(OutwardFacets<2, 1>::table) : take(OutwardFacets<2, 2>::table);

  struct Side {
    std::array<int, 3> key;
    std::size_t cell;
    int facet;
  };
  std::vector<Side> sides;
  const auto count = static_cast<std::size_t>(cells.nodes_per_cell);
  for (std::size_t c = 0; c * count < cells.nodes.size(); ++c)
    for (int f = 0; f <= dim; ++f) {
      Side side{{-1, -1, -1}, c, f};
      for (int k = 0; k < dim; ++k) side.key[k] = cells.nodes[c * count + static_cast<std::size_t>(places[f][k])];
      std::sort(side.key.begin(), side.key.end());
      sides.push_back(side);
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.key, a.cell) < std::tie(b.key, b.cell); });

  const auto planes_at = mirrors_at(cells);
  const auto in_mirror = [&](const std::vector<int>& nodes) {
    return std::any_of(planes_at[nodes[0]].begin(), planes_at[nodes[0]].end(), [&](int m) {
      return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
        return std::find(planes_at[node].begin(), planes_at[node].end(), m) != planes_at[node].end();
      });
    });
  };

  std::vector<OutsideFacet> facets;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if ((i > 0 && sides[i - 1].key == sides[i].key) || (i + 1 < sides.size() && sides[i + 1].key == sides[i].key))
      continue;
    const int* cell = &cells.nodes[sides[i].cell * count];
    OutsideFacet facet;
    for (const int place : places[sides[i].facet]) facet.nodes.push_back(cell[place]);
    if (in_mirror(facet.nodes)) continue;
    const Point& a = cells.points[facet.nodes[0]];
    Point along = cells.points[facet.nodes[1]] - a;
    if (dim == 3)
      facet.normal = cross(along, cells.points[facet.nodes[2]] - a);
    else
      facet.normal = tangents(along, cells.axes)[0];
    const double length = norm(facet.normal);
    if (!(length > 0)) continue;
    // The vertex opposite to facet f of a cell is its vertex f.
    const bool inward = dot(facet.normal, cells.points[cell[sides[i].facet]] - a) > 0;
    facet.normal = (inward ? -1 / length : 1 / length) * facet.normal;
    facets.push_back(std::move(facet));
  }
  return facets;
}

/// Groups of facets that are smooth surfaces.
std::vector<std::vector<int>> smooth_surfaces(const std::vector<OutsideFacet>& facets, int dim) {
  std::vector<int> root(facets.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  std::map<std::array<int, 2>, std::vector<int>> at_ridge;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int i = 0; i < dim; ++i) {
      std::array<int, 2> ridge{facets[f].nodes[i], dim == 3 ? facets[f].nodes[(i + 1) % 3] : -1};
      std::sort(ridge.begin(), ridge.end());
      at_ridge[ridge].push_back(static_cast<int>(f));
    }
  for (const auto& [ridge, meet] : at_ridge)
    for (std::size_t i = 1; i < meet.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (dot(facets[meet[i]].normal, facets[meet[j]].normal) > smooth_surface_cosine) {
          const int a = find(meet[i]), b = find(meet[j]);
          root[std::max(a, b)] = std::min(a, b);
        }
  std::map<int, std::vector<int>> groups;
  for (std::size_t f = 0; f < facets.size(); ++f) groups[find(static_cast<int>(f))].push_back(static_cast<int>(f));
  std::vector<std::vector<int>> surfaces;
  for (auto& [first, members] : groups) surfaces.push_back(std::move(members));
  return surfaces;
}

/// A smooth surface, its nodes numbered anew.
struct Surface {
  std::vector<int> nodes;      ///< of the body
  std::vector<Point> points;   ///< of the nodes, mm
  std::vector<Point> normals;  ///< likewise, sums of those of the facets around
  RecoveryCells cells;

  /// \param number  work space: -1 per node of the body, restored at the end
  Surface(const RecoveryCells& body, const std::vector<OutsideFacet>& facets, const std::vector<int>& members,
          std::vector<int>& number)
      : cells{points, {}, static_cast<int>(facets[members[0]].nodes.size()), body.order, body.axes} {
    cells.corners = static_cast<int>(body.axes.size());
    for (const int f : members)
      for (const int node : facets[f].nodes) {
        if (number[node] < 0) {
          number[node] = static_cast<int>(nodes.size());
          nodes.push_back(node);
          points.push_back(body.points[node]);
          normals.push_back(Point{});
        }
        cells.nodes.push_back(number[node]);
        normals[number[node]] = normals[number[node]] + facets[f].normal;
      }
    std::vector<std::vector<Point>> normals_at(nodes.size());
    if (!body.mirrors.empty())
      for (const int f : members)
        for (const int node : facets[f].nodes) normals_at[number[node]].push_back(facets[f].normal);
    for (const auto& mirror : body.mirrors) {
      RecoveryMirror here{mirror.normal, {}};
      const auto smooth = [&](const Point& normal) {  // with its image
        const double across = dot(normal, mirror.normal);
        return 1 - 2 * across * across > smooth_surface_cosine;
      };
      for (const int node : mirror.nodes)
        if (const int a = number[node]; a >= 0 && std::all_of(normals_at[a].begin(), normals_at[a].end(), smooth))
          here.nodes.push_back(a);
      if (!here.nodes.empty()) cells.mirrors.push_back(std::move(here));
    }
    for (const int node : nodes) number[node] = -1;
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
};

double strength(const SurfaceShape& shape) {
  return std::max(std::abs(shape.curvatures[0]), std::abs(shape.curvatures[1]));
}

/// The surface through points around the first of them, by Gauss-Newton steps: slopes and curvatures are corrected by a
/// fit to the distances that are left.
std::optional<SurfaceShape> fitted(const std::vector<PatchPoint>& patch, const Point& first_normal,
                                   const std::vector<int>& axes) {
  const bool solid = axes.size() == 3;
  const Eigen::Index unknowns = solid ? 5 : 2, rows = static_cast<Eigen::Index>(patch.size()) - 1;
  SurfaceShape shape = shape_of(first_normal, axes, [](const Point&, const Point&) { return 0.0; });
  double square = 0;
  for (const auto& point : patch) square += dot(point.position - patch[0].position, point.position - patch[0].position);
  const double size = std::sqrt(square / static_cast<double>(rows));
  if (!(size > 0)) return std::nullopt;
  Eigen::MatrixXd matrix(rows, unknowns);
  Eigen::VectorXd left(rows);
  double squares = 0, heights = 0;
  for (int step = 0; step < most_fit_steps; ++step) {
    squares = heights = 0;
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Point y = patch[static_cast<std::size_t>(i) + 1].position - patch[0].position;
      const auto flat_y = shape.straightened(y);
      if (!flat_y) return std::nullopt;
      const double s = dot(*flat_y, shape.directions[0]) / size, t = dot(*flat_y, shape.directions[1]) / size;
      const double height = dot(*flat_y, shape.normal) / size;
      const double weight = 1 / (s * s + t * t + nearby_weight);
      if (solid)
        matrix.row(i) << s, t, 0.5 * s * s, s * t, 0.5 * t * t;
      else
        matrix.row(i) << s, 0.5 * s * s;
      matrix.row(i) *= weight;
      left[i] = -weight * height;
      squares += left[i] * left[i];
      heights += weight * weight * dot(y, shape.normal) * dot(y, shape.normal) / (size * size);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(dependent_column);
    const Eigen::VectorXd found = solver.compute(matrix).solve(left);
    Point tilted = shape.normal + found[0] * shape.directions[0];
    if (solid) tilted = tilted + found[1] * shape.directions[1];
    tilted = (1 / norm(tilted)) * tilted;
    const SurfaceShape old = shape;
    const auto more = [&](const Point& a, const Point& b) {
      double sum = curvature_between(old, a, b);
      const auto& d = old.directions;
      if (!solid) return sum + found[1] / size * dot(d[0], a) * dot(d[0], b);
      sum += found[2] / size * dot(d[0], a) * dot(d[0], b) + found[4] / size * dot(d[1], a) * dot(d[1], b);
      return sum + found[3] / size * (dot(d[0], a) * dot(d[1], b) + dot(d[1], a) * dot(d[0], b));
    };
    shape = shape_of(tilted, axes, more);
    if (found.norm() < 1e-12) break;
  }
  const double largest = strength(shape);
  if (!(largest * size > least_bend) || !(squares < left_by_bending * left_by_bending * heights)) return std::nullopt;
  for (double& curvature : shape.curvatures)
    if (std::abs(curvature) * size <= least_bend) curvature = 0;
  return shape;
}

}  // namespace

std::optional<Point> SurfaceShape::straightened(const Point& y) const {
  double z = dot(normal, y), along[2];
  for (int i = 0; i < 2; ++i) {
    along[i] = dot(directions[i], y);
    if (curvatures[i] == 0) continue;
    const auto straight = unbent(along[i], z, curvatures[i]);
    if (!straight) return std::nullopt;
    along[i] = straight->first;
    z = straight->second;
  }
  return z * normal + along[0] * directions[0] + along[1] * directions[1];
}

std::optional<SurfaceShape> SurfaceShape::moved(const Point& y) const {
  const auto straight = straightened(y);
  if (!straight) return std::nullopt;
  SurfaceShape there = *this;
  const double across = dot(normal, y), height = dot(normal, *straight);
  for (int i = 0; i < 2; ++i) {
    const double stretch = 1 + curvatures[i] * height, to_centre = 1 + curvatures[i] * across;
    if (!(std::min(stretch, to_centre) > near_centre)) return std::nullopt;
    there.curvatures[i] = curvatures[i] / stretch;  // the centre stays where it is
    there.normal = there.normal + (dot(directions[i], y) * curvatures[i] / to_centre) * directions[i];
  }
  there.normal = (1 / norm(there.normal)) * there.normal;
  for (int i = 0; i < 2; ++i) {
    if (dot(directions[i], directions[i]) == 0) continue;  // in two dimensions there is one
    const Point along = directions[i] - dot(directions[i], there.normal) * there.normal;
    there.directions[i] = (1 / norm(along)) * along;
  }
  return there;
}

SurfaceShapes::SurfaceShapes(const RecoveryCells& cells) : place_(cells.points.size(), -1) {
  std::vector<std::vector<Point>> flat_normals(cells.points.size());
  fit_to_boundary(cells, flat_normals);
  if (!shapes_.empty()) carry_inwards(cells, flat_normals);
}

void SurfaceShapes::fit_to_boundary(const RecoveryCells& cells, std::vector<std::vector<Point>>& flat_normals) {
  const auto dim = static_cast<int>(cells.axes.size());
  // The unknowns of a fit, the node itself, and in space so many more that no irregular surface seems to have a shape:
  // straightened by a wrong one, layers bend by more than they are thick.
  const std::size_t enough = dim == 3 ? 24 : 5;
  const std::vector<OutsideFacet> facets = boundary_of(cells);
  std::vector<int> number(cells.points.size(), -1);
  for (const auto& members : smooth_surfaces(facets, dim)) {
    const Surface surface(cells, facets, members, number);
    RecoveryPatches patches(surface.cells);
    for (std::size_t a = 0; a < surface.nodes.size(); ++a) {
      const double length = norm(surface.normals[a]);
      if (!(length > 0)) continue;
      const Point normal = (1 / length) * surface.normals[a];
      patches.begin(static_cast<int>(a));
      for (int ring = 0; ring < most_surface_rings && (ring == 0 || patches.points().size() < enough); ++ring)
        patches.grow();
      const auto shape =
          dim == 3 && patches.points().size() < enough ? std::nullopt : fitted(patches.points(), normal, cells.axes);
      int& place = place_[surface.nodes[a]];
      if (!shape) {
        flat_normals[surface.nodes[a]].push_back(normal);
      } else if (place < 0) {
        place = static_cast<int>(shapes_.size());
        shapes_.push_back(*shape);
      } else if (strength(*shape) > strength(shapes_[place])) {
        shapes_[place] = *shape;
      }
    }
  }
}

void SurfaceShapes::carry_inwards(const RecoveryCells& cells, const std::vector<std::vector<Point>>& flat_normals) {
  const auto planes_at = mirrors_at(cells);
  std::map<int, std::vector<int>> beside;
  const auto count = static_cast<std::size_t>(cells.nodes_per_cell);
  for (std::size_t c = 0; c < cells.nodes.size(); c += count)
    for (std::size_t i = 0; i < count; ++i) {
      const int node = cells.nodes[c + i];
      if (place_[node] >= 0) continue;
      for (std::size_t j = 0; j < count; ++j) beside[node].push_back(cells.nodes[c + j]);
    }
  const std::vector<int> of_boundary = place_;
  for (auto& [node, neighbours] : beside) {
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    Point normal{};
    Mat3<double> curvature{};
    int curved = 0, all = 0;
    bool one_layer = true;
    for (const int neighbour : neighbours) {
      if (of_boundary[neighbour] < 0) continue;
      const auto here = shapes_[of_boundary[neighbour]].moved(cells.points[node] - cells.points[neighbour]);
      if (!here) continue;
      const double along = dot(normal, here->normal), side = along < 0 ? -1 : 1;
      if (curved > 0 && std::abs(along) < same_layer * norm(normal)) one_layer = false;
      normal = normal + side * here->normal;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 2; ++k)
            curvature(i, j) += side * here->curvatures[k] * here->directions[k][i] * here->directions[k][j];
      ++curved;
    }
    all = curved;
    for (const int m : planes_at[node]) {
      const Point& n = cells.mirrors[m].normal;
      Mat3<double> mirror{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) mirror(i, j) -= 2 * n[i] * n[j];
      normal = normal - dot(normal, n) * n;
      curvature = 0.5 * (curvature + mirror * curvature * mirror);
    }
    const double length = norm(normal);
    if (curved == 0 || !one_layer || !(length > 0)) continue;
    normal = (1 / length) * normal;
    const auto along = [&](const Point& flat_normal) { return std::abs(dot(flat_normal, normal)) > same_layer; };
    const auto lies_flat = [&](int a) {
      return of_boundary[a] < 0 && std::any_of(flat_normals[a].begin(), flat_normals[a].end(), along);
    };
    if (lies_flat(node)) continue;
    all += static_cast<int>(std::count_if(neighbours.begin(), neighbours.end(), lies_flat));
    place_[node] = static_cast<int>(shapes_.size());
    shapes_.push_back(shape_of(normal, cells.axes, [&](const Point& a, const Point& b) {
      double sum = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += a[i] * curvature(i, j) * b[j] / all;
      return sum;
    }));
  }
}

const SurfaceShape* SurfaceShapes::at(int node) const {
  return place_[node] < 0 ? nullptr : &shapes_[place_[node]];
}

}  // namespace fsi
