#include "fluid/moving_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "fem/elements.hpp"
#include "fem/facet_load.hpp"
#include "fluid/backflow.hpp"
#include "fluid/facet_shapes.hpp"
#include "math/dual.hpp"

namespace fsi {

namespace {

template <class Element>
class MovingFacets : public MovingSurface<Element::components> {
 public:
  static constexpr int n = Element::components;
  using typename MovingSurface<n>::ShapeDerivatives;
  using Facet = typename SimplexMesh<Element::dim, Element::order>::Facet;
  using F = typename Element::Facet;
  using Shapes = FacetShapes<Element>;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  MovingFacets(std::vector<Point> nodes, std::vector<Facet> facets, const NodeShare* share)
      : nodes_(std::move(nodes)), facets_(std::move(facets)), counted_(facets_.size(), 1) {
    if (share == nullptr) return;
    for (int a = 0; a < static_cast<int>(nodes_.size()); ++a)
      if (share->owned[a] == 0) ghosts_.push_back(a);
    for (std::size_t f = 0; f < facets_.size(); ++f)  // PartRestriction::counts
      counted_[f] = share->owned[*std::min_element(facets_[f].begin(), facets_[f].end())];
  }

  std::vector<double> normals(const double* mesh) const override {
    std::vector<double> weights(Mixed::size(static_cast<int>(nodes_.size())), 0.0);
    add_pressure(1, mesh, weights.data(), nullptr);
    drop_ghosts(weights, Mixed::entries);
    return weights;
  }

  std::vector<double> areas(const double* mesh) const override {
    std::vector<double> areas(nodes_.size(), 0.0);
    for (const auto& facet : facets_) {
      Vec3<Pack> x[F::nodes];
      positions(facet, mesh, x);
      for (int q = 0; q < F::points; ++q) {
        const auto normal = F::weighted_normal(x, q);
        const double area = sqrt(dot(normal, normal))[0];
        for (int a = 0; a < F::scalar_nodes; ++a) areas[facet[a]] += F::scalar_shape(q, a) * area;
      }
    }
    drop_ghosts(areas, 1);
    return areas;
  }

  void add_pressure(double pressure, const double* mesh, double* residual,
                    ShapeDerivatives* derivatives) const override {
    add_surface_pressure<Element, Vector>(nodes_, facets_, pressure, mesh, residual, derivatives);
  }

  double outflow(const double* mesh, const double* flow) const override {
    return flow_through(mesh, [&](int node, int k) { return flow[Mixed::vector(node, k)]; });
  }
  double relative_outflow(const FluidInput& in) const override {
    return flow_through(in.mesh,
                        [&](int node, int k) { return in.fluid[Mixed::vector(node, k)] - mesh_velocity(in, node, k); });
  }

  std::vector<double> relative_outflow_slope(const FluidInput& in) const override {
    auto slope = flow_slope(
        in.mesh, [&](int node, int k) { return in.fluid[Mixed::vector(node, k)] - mesh_velocity(in, node, k); });
    const auto weights = normals(in.mesh);
    for (std::size_t a = 0; a < nodes_.size(); ++a)
      for (int k = 0; k < n; ++k)
        slope[Vector::vector(static_cast<int>(a), k)] -=
            in.mesh_factor * weights[Mixed::vector(static_cast<int>(a), k)];
    return slope;
  }
  double kinetic_outflow(const FluidInput& in) const override {
    double flux = 0;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (counted_[f] == 0) continue;
      const Facet& facet = facets_[f];
      Vec3<Pack> x[F::nodes];
      positions(facet, in.mesh, x);
      for (int q = 0; q < F::cubic_points; ++q) {
        const auto normal = F::cubic_weighted_normal(x, q);
        double square = 0, through = 0;
        for (int k = 0; k < n; ++k) {
          double u = 0, w = 0;
          for (int a = 0; a < F::nodes; ++a) {
            u += F::cubic_shape(q, a) * in.fluid[Mixed::vector(facet[a], k)];
            w += F::cubic_shape(q, a) * mesh_velocity(in, facet[a], k);
          }
          square += u * u;
          through += (u - w) * normal[Element::axis[k]][0];
        }
        flux += 0.5 * square * through;
      }
    }
    return flux;
  }

  void add_backflow(double density, double beta, const FluidInput& in, double* residual, FluidJacobian<n>* jacobian,
                    FluidDerivatives derivatives) const override {
    const bool by_mesh = derivatives == FluidDerivatives::fluid_and_domain;
    for (std::size_t first = 0; first < facets_.size(); first += pack_width) {
      if (derivatives == FluidDerivatives::none) {
        add_backflow_rows<Pack>(density, beta, in, first, 0, residual, nullptr, false);
        continue;
      }
      for (int b = 0; b < F::nodes; ++b)
        add_backflow_rows<Dual<2 * n>>(density, beta, in, first, b, b == 0 ? residual : nullptr, jacobian, by_mesh);
    }
  }

  double backflow_power(double density, double beta, const FluidInput& in) const override {
    double power = 0;
    for (std::size_t first = 0; first < facets_.size(); first += pack_width)
      for (int q = 0; q < Shapes::points; ++q) {
        const auto [u, traction] = traction_at<Pack>(density, beta, in, first, -1, q);
        const Pack taken = dot(u, traction);
        for (int lane = 0; lane < lanes_from(first); ++lane)
          if (counted_[first + static_cast<std::size_t>(lane)] != 0) power += taken[lane];
      }
    return power;
  }

 private:
  /// Integral of v . n over the facets that are counted here. \param velocity  velocity(node, k): v
  template <class Velocity>
  double flow_through(const double* mesh, Velocity velocity) const {
    double sum = 0;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (counted_[f] == 0) continue;
      const Facet& facet = facets_[f];
      Vec3<Pack> x[F::nodes];
      positions(facet, mesh, x);
      for (int q = 0; q < F::points; ++q) {
        const auto normal = F::weighted_normal(x, q);
        for (int a = 0; a < F::nodes; ++a)
          for (int k = 0; k < n; ++k) sum += F::shape(q, a) * normal[Element::axis[k]][0] * velocity(facet[a], k);
      }
    }
    return sum;
  }

  /// Derivative of flow_through() by the mesh's displacement at fixed v, mm^2 times the unit of v.
  template <class Velocity>
  std::vector<double> flow_slope(const double* mesh, Velocity velocity) const {
    std::vector<double> slope(Vector::size(static_cast<int>(nodes_.size())), 0.0);
    for (const auto& facet : facets_)
      for (int b = 0; b < F::nodes; ++b) {
        Vec3<Dual<n>> x[F::nodes];
        positions(facet, mesh, x);
        for (int k = 0; k < n; ++k) x[b][Element::axis[k]].slope[k] = Pack(1.0);
        for (int q = 0; q < F::points; ++q) {
          const auto normal = F::weighted_normal(x, q);
          for (int k = 0; k < n; ++k) {
            double u = 0;
            for (int a = 0; a < F::nodes; ++a) u += F::shape(q, a) * velocity(facet[a], k);
            for (int s = 0; s < n; ++s) slope[Vector::vector(facet[b], s)] += u * normal[Element::axis[k]].slope[s][0];
          }
        }
      }
    drop_ghosts(slope, Vector::entries);
    return slope;
  }

  /// Current positions of a facet's nodes.
  template <class T>
  void positions(const Facet& facet, const double* mesh, Vec3<T> (&x)[F::nodes]) const {
    for (int a = 0; a < F::nodes; ++a) {
      for (int i = 0; i < 3; ++i) x[a][i] = T(nodes_[facet[a]][i]);
      for (int k = 0; k < n; ++k) x[a][Element::axis[k]] += Pack(mesh[Vector::vector(facet[a], k)]);
    }
  }
  /// Values at ghosts lack the facets that touch no own node; their owners have the whole values.
  void drop_ghosts(std::vector<double>& field, int entries) const {
    for (const int node : ghosts_)
      std::fill_n(field.begin() + static_cast<std::ptrdiff_t>(node) * entries, entries, 0.0);
  }
  static double mesh_velocity(const FluidInput& in, int node, int k) {
    const std::size_t at = Vector::vector(node, k);
    return in.mesh_factor * (in.mesh[at] - in.mesh_reference[at]);
  }

  int lanes_from(std::size_t first) const {
    return static_cast<int>(std::min<std::size_t>(pack_width, facets_.size() - first));
  }
  /// value(facet), one facet per lane from `first` on; the last one again in lanes that are left over.
  template <class Value>
  Pack of_lanes(std::size_t first, Value value) const {
    Pack::Lanes lanes = {};
    for (int lane = 0; lane < pack_width; ++lane)
      lanes[lane] = value(facets_[std::min(first + static_cast<std::size_t>(lane), facets_.size() - 1)]);
    return Pack(lanes);
  }

  /// Velocity and traction against backflow times the weight of a point, of the facets from `first` on; of duals seeded
  /// with the velocity of their node b and, behind it, its displacement.
  template <class T>
  std::pair<Vec3<T>, Vec3<T>> traction_at(double density, double beta, const FluidInput& in, std::size_t first, int b,
                                          int q) const {
    Vec3<T> x[F::nodes];
    for (int a = 0; a < F::nodes; ++a) {
      for (int i = 0; i < 3; ++i) x[a][i] = T(of_lanes(first, [&](const Facet& facet) { return nodes_[facet[a]][i]; }));
      for (int k = 0; k < n; ++k)
        x[a][Element::axis[k]] +=
            of_lanes(first, [&](const Facet& facet) { return in.mesh[Vector::vector(facet[a], k)]; });
    }
    if constexpr (IsDual<T>::value)
      for (int k = 0; k < n; ++k) x[b][Element::axis[k]].slope[n + k] = Pack(1.0);
    Vec3<T> u{{T(0.0), T(0.0), T(0.0)}}, c = u;
    for (int k = 0; k < n; ++k) {
      const int axis = Element::axis[k];
      for (int a = 0; a < F::nodes; ++a) {
        const Pack shape(Shapes::shape(q, a));
        const Pack velocity = of_lanes(first, [&](const Facet& facet) { return in.fluid[Mixed::vector(facet[a], k)]; });
        u[axis] += shape * velocity;
        c[axis] +=
            shape * (velocity - of_lanes(first, [&](const Facet& facet) { return mesh_velocity(in, facet[a], k); }));
      }
      if constexpr (IsDual<T>::value) {
        u[axis].slope[k] = c[axis].slope[k] = Pack(Shapes::shape(q, b));
        c[axis].slope[n + k] = Pack(-in.mesh_factor * Shapes::shape(q, b));
      }
    }
    const Vec3<T> normal = Shapes::weighted_normal_of(x, q);
    const T inward = -dot(c, normal);
    return {u, (Pack(density * beta) * select(inward > 0.0, inward, T(0.0))) * u};
  }

  template <class T>
  void add_backflow_rows(double density, double beta, const FluidInput& in, std::size_t first, int b, double* residual,
                         FluidJacobian<n>* jacobian, bool by_mesh) const {
    for (int q = 0; q < Shapes::points; ++q) {
      const Vec3<T> traction = traction_at<T>(density, beta, in, first, b, q).second;
      for (int lane = 0; lane < lanes_from(first); ++lane) {
        const Facet& facet = facets_[first + static_cast<std::size_t>(lane)];
        for (int a = 0; a < F::nodes; ++a) {
          const double shape = Shapes::shape(q, a);
          if (residual)
            for (int k = 0; k < n; ++k)
              residual[Mixed::vector(facet[a], k)] += shape * value_of(traction[Element::axis[k]])[lane];
          if constexpr (IsDual<T>::value) {
            const int position = jacobian->fluid.graph->find(facet[a], facet[b]);
            assert(position >= 0);
            double* by_velocity = jacobian->fluid.block(position);
            double* by_displacement = by_mesh ? jacobian->shape_derivatives.block(position) : nullptr;
            for (int k = 0; k < n; ++k) {
              const T& component = traction[Element::axis[k]];
              for (int l = 0; l < n; ++l) by_velocity[Mixed::in_block(k, l)] += shape * component.slope[l][lane];
              for (int l = 0; l < n && by_mesh; ++l) by_displacement[k * n + l] += shape * component.slope[n + l][lane];
            }
          }
        }
      }
    }
  }

  std::vector<Point> nodes_;
  std::vector<Facet> facets_;
  std::vector<char> counted_;  ///< per facet: in sums, by this process
  std::vector<int> ghosts_;    ///< nodes of other processes
};

}  // namespace

template <class Element>
std::shared_ptr<const MovingSurface<Element::components>> moving_surface(
    const std::vector<Point>& nodes,
    const std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet>& facets, const NodeShare* share) {
  return std::make_shared<MovingFacets<Element>>(nodes, facets, share);
}

#define FSI_INSTANTIATE(Element)                                                                       \
  template std::shared_ptr<const MovingSurface<Element::components>> moving_surface<Element>(          \
      const std::vector<Point>&, const std::vector<SimplexMesh<Element::dim, Element::order>::Facet>&, \
      const NodeShare*);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
