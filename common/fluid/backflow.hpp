#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "algebra/node_graph.hpp"
#include "fluid/facet_shapes.hpp"
#include "fluid/fluid_input.hpp"
#include "math/dual.hpp"
#include "math/tensor.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// Fluid that enters through an opening whose velocity is not given brings kinetic energy that nothing limits. The
/// stabilisation ([Bazilevs2009], [EsmailyMoghadam2011]; docs/theory.md, section 3.7) adds to the momentum equation
///   beta rho <(u . n)_- u, v>,   (x)_- = (|x| - x)/2,
/// a traction against the fluid that enters. It takes 2 beta of the energy that comes in: with beta = 1/2 all of it.
/// Where fluid leaves there is nothing. The opening does not move, so that u is the velocity relative to it.
///
/// The term is continuous. Its derivative jumps where u . n = 0 by beta rho |u_t|, u_t being the velocity along the
/// surface; the one taken there is that of outflow, zero. Newton's method converges as it does for other functions that
/// are piecewise smooth [Qi1993], and with u_t = 0 the derivative is continuous.
struct BackflowTraction {
  double density;      ///< mg/mm^3
  double coefficient;  ///< beta

  static constexpr double standard = 0.5;  ///< the least beta with which no energy comes in

  /// beta rho (u . n)_- u times the weight of `normal`, kPa mm^2. \param normal  times an integration weight, mm^2
  template <class T>
  Vec3<T> operator()(const Vec3<T>& u, const Vec3<Pack>& normal) const {
    const T inward = -dot(u, normal);
    return (Pack(density * coefficient) * select(inward > 0.0, inward, T(0.0))) * u;
  }
};

/// The facets of an opening ready for the assembly of this term: a lane per facet, with normals and the places of their
/// blocks in the fluid's matrix.
template <class Element>
class BackflowFacets {
 public:
  static constexpr int n = Element::components;
  static constexpr int facet_nodes = Element::Facet::nodes;

  /// \param coefficient  beta
  /// \param part         the fluid's nodes
  /// \param facets       node numbers of the part, facet_nodes for each facet, normals outward
  /// \param graph        of the fluid's matrix
  BackflowFacets(double coefficient, const PartNodes& part, const std::vector<int>& facets, const NodeGraph& graph)
      : coefficient_(coefficient), packs_((facets.size() / facet_nodes + pack_width - 1) / pack_width) {
    for (std::size_t p = 0; p < packs_.size(); ++p)
      for (int lane = 0; lane < pack_width; ++lane) {
        const std::size_t first = (p * pack_width + static_cast<std::size_t>(lane)) * facet_nodes;
        fill(packs_[p], lane, first < facets.size() ? &facets[first] : nullptr, facets.data(), part, graph);
      }
  }

  double coefficient() const { return coefficient_; }

  /// Adds the term to the residual and, unless null, its derivatives by the velocity to jacobian->fluid.
  /// \param density  mg/mm^3
  /// \param flow     (u, p), mixed layout; the residual likewise
  void add(double density, const double* flow, double* residual, FluidJacobian<n>* jacobian) const {
    if (jacobian)
      add_terms<Dual<n>>(density, flow, residual, jacobian);
    else
      add_terms<Pack>(density, flow, residual, nullptr);
  }

  /// Power that the term takes from the flow, uJ/ms: beta rho <(u . n)_-, |u|^2>. Over the facets that this process
  /// counts; the sum over the processes is the opening's.
  double power(double density, const double* flow) const {
    double sum = 0;
    for (const auto& pack : packs_) {
      Pack taken(0.0);
      for (int q = 0; q < Shapes::points; ++q) {
        const Vec3<Pack> u = velocity<Pack>(pack, flow, q);
        taken += dot(u, BackflowTraction{density, coefficient_}(u, pack.normal[q]));
      }
      for (int lane = 0; lane < pack_width; ++lane)
        if (pack.counted[lane]) sum += taken[lane];
    }
    return sum;
  }

 private:
  using Shapes = FacetShapes<Element>;
  using Mixed = MixedLayout<n>;
  using Lanes = std::array<int, pack_width>;

  struct FacetPack {
    Lanes node[facet_nodes];
    Lanes position[facet_nodes * facet_nodes];  ///< of block (a, b); -1 in an empty lane
    Vec3<Pack> normal[Shapes::points];          ///< times weights, mm^2; zero in an empty lane
    std::array<bool, pack_width> counted;       ///< by this process, in sums over facets
  };

  static void fill(FacetPack& pack, int lane, const int* facet, const int* any, const PartNodes& part,
                   const NodeGraph& graph) {
    typename Shapes::Positions x{};
    for (int a = 0; a < facet_nodes; ++a) {
      pack.node[a][lane] = facet ? facet[a] : any[a];
      x[a] = part.nodes[static_cast<std::size_t>(pack.node[a][lane])];
      for (int b = 0; b < facet_nodes; ++b)
        pack.position[a * facet_nodes + b][lane] = facet ? graph.find(facet[a], facet[b]) : -1;
    }
    pack.counted[lane] = facet && part.owns(*std::min_element(facet, facet + facet_nodes));  // PartRestriction::counts
    for (int q = 0; q < Shapes::points; ++q) {
      const Point normal = facet ? Shapes::weighted_normal(x, q) : Point{0, 0, 0};
      for (int i = 0; i < 3; ++i) pack.normal[q][i].set(lane, normal[i]);
    }
  }

  /// At a point; of a Dual seeded with its own components.
  template <class T>
  static Vec3<T> velocity(const FacetPack& pack, const double* flow, int q) {
    Vec3<T> u{{T(0.0), T(0.0), T(0.0)}};
    for (int a = 0; a < facet_nodes; ++a)
      for (int k = 0; k < n; ++k) {
        Pack::Lanes at_node = {};
        for (int lane = 0; lane < pack_width; ++lane) at_node[lane] = flow[Mixed::vector(pack.node[a][lane], k)];
        u[Element::axis[k]] += Pack(Shapes::shape(q, a)) * Pack(at_node);
      }
    if constexpr (IsDual<T>::value)
      for (int k = 0; k < n; ++k) u[Element::axis[k]].slope[k] = Pack(1.0);
    return u;
  }

  template <class T>
  void add_terms(double density, const double* flow, double* residual, FluidJacobian<n>* jacobian) const {
    const BackflowTraction form{density, coefficient_};
    for (const auto& pack : packs_)
      for (int q = 0; q < Shapes::points; ++q) {
        const Vec3<T> traction = form(velocity<T>(pack, flow, q), pack.normal[q]);
        for (int lane = 0; lane < pack_width; ++lane) {
          if (pack.position[0][lane] < 0) continue;
          for (int a = 0; a < facet_nodes; ++a) {
            double* rows = residual + Mixed::vector(pack.node[a][lane]);
            for (int k = 0; k < n; ++k) rows[k] += Shapes::shape(q, a) * value_of(traction[Element::axis[k]])[lane];
            if constexpr (IsDual<T>::value)
              for (int b = 0; b < facet_nodes; ++b) {
                double* block = jacobian->fluid.block(pack.position[a * facet_nodes + b][lane]);
                const double shapes = Shapes::shape(q, a) * Shapes::shape(q, b);
                for (int k = 0; k < n; ++k)
                  for (int l = 0; l < n; ++l)
                    block[Mixed::in_block(k, l)] += shapes * traction[Element::axis[k]].slope[l][lane];
              }
          }
        }
      }
  }

  double coefficient_;
  std::vector<FacetPack> packs_;
};

}  // namespace fsi
