#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "fem/function_space.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "mesh_motion/mesh_follower.hpp"
#include "mesh_motion/motion_of_vertices.hpp"
#include "mesh_motion/stiffening.hpp"
#include "support/meshes.hpp"

namespace fsi::test {

/// A fluid domain some of whose nodes are moved and others held, as by an interface and the rest of a boundary.
template <class Element>
struct PrescribedMotion {
  using Mesh = SimplexMesh<Element::dim, Element::order>;
  Submesh<Element::dim, Element::order> part;
  std::vector<int> interface;  ///< nodes that move
  std::vector<char> given;     ///< per node and component
  /// Displacement of an interface node for an amount of motion.
  std::function<Point(const Point& at, double amount)> displacement;

  /// The displacement of all given entries; zero inside.
  std::vector<double> target(double amount) const {
    constexpr int n = Element::components;
    std::vector<double> d(given.size(), 0.0);
    for (const int node : interface) {
      const Point moved = displacement(part.nodes[node], amount);
      for (int k = 0; k < n; ++k) d[VectorLayout<n>::vector(node, k)] = moved[Element::axis[k]];
    }
    return d;
  }
};

namespace detail {

/// \param on_interface, held  of a point; held tells by component
template <class Element, class Linear, class OnInterface, class Held>
PrescribedMotion<Element> prescribed_motion(const Linear& linear, OnInterface on_interface, Held held) {
  constexpr int n = Element::components;
  PrescribedMotion<Element> problem;
  const auto mesh = [&] {
    if constexpr (Element::order == 1) {
      return linear;
    } else {
      return with_mid_edge_nodes(linear);
    }
  }();
  problem.part = submesh(mesh, {0});
  const auto& x = problem.part.nodes;
  problem.given.assign(x.size() * n, 0);
  for (std::size_t a = 0; a < x.size(); ++a) {
    const bool wet = on_interface(x[a]);
    if (wet) problem.interface.push_back(static_cast<int>(a));
    for (int k = 0; k < n; ++k) problem.given[n * a + k] = wet || held(x[a], Element::axis[k]);
  }
  return problem;
}

}  // namespace detail

/// The unit square or cube around a body that is 0.2 mm a side, in the middle. Its surface moves, the outer one is
/// held.
/// \param boxes  a side, a multiple of five
template <class Element>
PrescribedMotion<Element> body_in_a_box(int boxes) {
  const double h = 1.0 / boxes;
  const auto inside = [&](auto... index) { return ((index >= 2 * boxes / 5 && index < 3 * boxes / 5) && ...); };
  const auto mesh = [&] {
    if constexpr (Element::dim == 3) {
      return grid_mesh(
          {boxes, boxes, boxes}, {"fluid", "body"},
          [&](int i, int j, int k) -> Point {
            return {i * h, j * h, k * h};
          },
          [&](int i, int j, int k) { return inside(i, j, k) ? 1 : 0; });
    } else {
      auto grid = triangle_grid(
          {boxes, boxes}, {"fluid", "body"},
          [&](int i, int j) -> Point {
            return {i * h, 0, j * h};
          },
          [&](int i, int j) { return inside(i, j) ? 1 : 0; });
      for (auto& x : grid.nodes) x = {x[0], x[2], 0};
      return grid;
    }
  }();
  constexpr double half = 0.1 + 1e-9;
  const auto distance = [](const Point& x) {  // from the middle, largest along an axis
    double largest = 0;
    for (int k = 0; k < Element::dim; ++k) largest = std::max(largest, std::abs(x[k] - 0.5));
    return largest;
  };
  return detail::prescribed_motion<Element>(
      mesh, [=](const Point& x) { return distance(x) < half; },
      [=](const Point& x, int) { return distance(x) > 0.5 - 1e-9; });
}

/// The body turned by `amount` degrees about its axis along z.
inline Point turned(const Point& x, double amount) {
  const double angle = amount * std::acos(-1.0) / 180, c = std::cos(angle), s = std::sin(angle);
  const double u = x[0] - 0.5, v = x[1] - 0.5;
  return {c * u - s * v - u, s * u + c * v - v, 0};
}

/// The body shifted along x by `amount`, mm.
inline Point shifted(const Point&, double amount) {
  return {amount, 0, 0};
}

/// A tube of radius 1 and length 4 mm, in its (r, z) plane, whose wall bulges by `amount` over a short stretch.
template <class Element>
PrescribedMotion<Element> bulging_tube(int boxes) {
  const double h = 1.0 / boxes;
  const auto mesh = triangle_grid(
      {boxes, 4 * boxes}, {"fluid"},
      [&](int i, int j) -> Point {
        return {i * h, 0, j * h};
      },
      [](int, int) { return 0; });
  auto problem = detail::prescribed_motion<Element>(
      mesh, [](const Point& x) { return x[0] > 1 - 1e-9; },
      [](const Point& x, int axis) { return axis == 0 ? x[0] < 1e-9 : x[2] < 1e-9 || x[2] > 4 - 1e-9; });
  problem.displacement = [](const Point& x, double amount) -> Point {
    return {amount * std::exp(-std::pow((x[2] - 2) / 0.3, 2)), 0, 0};
  };
  return problem;
}

/// Gives the nodes in the middles of all edges the mean of their ends.
/// \param field  n numbers a node
template <int Dim>
void follow_edges(const Submesh<Dim, 2>& part, int n, std::vector<double>& field) {
  const auto& edges = SimplexEdges<Dim>::vertices;
  for (const auto& cell : part.cells)
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (int k = 0; k < n; ++k)
        field[n * cell[Dim + 1 + e] + k] = 0.5 * (field[n * cell[edges[e][0]] + k] + field[n * cell[edges[e][1]] + k]);
}

/// A mesh motion by name, on its own.
template <class Element>
class MovedMesh {
 public:
  static constexpr int n = Element::components;

  MovedMesh(const PrescribedMotion<Element>& problem, const MeshMotionOptions& options)
      : problem_(problem),
        space_(function_space<Element>(problem.part)),
        packs_(problem.part.nodes, problem.part.cells, all_cells(problem.part), *space_.graph()),
        stiffness_(mesh_stiffness(problem.part, problem.interface, options)),
        elastic_(packs_, space_.graph(), PseudoSolid::of_poisson(options.poisson), stiffness_),
        mesh(problem.given.size(), 0.0) {
    std::vector<char> inner(problem.given.size());
    for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = !problem.given[i];
    if (options.method == MeshMotionMethod::nonlinear_elastic) {
      follower = std::make_unique<MeshFollower<n>>(elastic_, inner);
    } else {
      const auto motion = harmonic_mesh_motion<Element>(problem.part, packs_, space_.graph(), stiffness_);
      operator_ = MeshMotionMatrix<n>(motion->graph());
      motion->assemble(operator_);
      extension_ = std::make_unique<HarmonicExtension<n>>(operator_, inner);
    }
  }

  /// Moves the mesh; \returns the smallest J at a quadrature point.
  double move(double amount) {
    const auto target = problem_.target(amount);
    if (follower) {
      follower->follow(target, mesh);
    } else {
      for (std::size_t i = 0; i < mesh.size(); ++i)
        if (problem_.given[i]) mesh[i] = target[i];
      extension_->solve(std::vector<double>(mesh.size(), 0.0), mesh);
    }
    std::vector<double> rows;
    return elastic_.assemble(mesh, rows).smallest_volume_ratio;
  }

  /// The last of `amounts`, ascending, before an element folds or none is found.
  double last_unfolded(const std::vector<double>& amounts) {
    double last = 0;
    for (const double amount : amounts) {
      try {
        if (!(move(amount) > 0)) break;
      } catch (const ConvergenceError&) {
        break;
      }
      last = amount;
    }
    return last;
  }

 private:
  const PrescribedMotion<Element>& problem_;
  FunctionSpace<n> space_;
  ElementPacks<Element> packs_;
  std::vector<double> stiffness_;
  ElasticMeshMotion<Element> elastic_;
  MeshMotionMatrix<n> operator_;
  std::unique_ptr<HarmonicExtension<n>> extension_;

 public:
  std::vector<double> mesh;                   ///< d_m
  std::unique_ptr<MeshFollower<n>> follower;  ///< of the nonlinear motion
};

}  // namespace fsi::test
