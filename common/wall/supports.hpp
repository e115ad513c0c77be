#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fem/facet_load.hpp"
#include "mesh/simplex_mesh.hpp"
#include "parallel/node_share.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

/// Constants of springs (kPa/mm) or dampers (kPa ms/mm) per area of a surface at rest: the same in all directions, and
/// along the normal at rest alone.
struct Bedding {
  double full = 0, normal = 0;
  bool is_none() const { return full == 0 && normal == 0; }
};

/// What the supports do in one balance of a step, tested with its velocity for its duration; uJ (docs/energy.md). Of a
/// wall that is shared out among processes, what they do to this one's nodes.
struct SupportWork {
  double loads = 0;    ///< of pressures and tractions
  double damping = 0;  ///< (C v, v) of the dampers
  double springs = 0;  ///< (K d, v) of the springs beyond the change of what they store
};

/// What holds and loads surfaces of the wall from outside, vectors with n components (docs/theory.md, section 4.5). With
/// the displacement d, its velocity v, normals N and n at rest and now (out of the wall) the wall's residual gets
///   (k d + k_n (d . N) N + c v + c_n (v . N) N - t, w) on the surface at rest + (p n, w) on the current one.
///
/// Where the wall is shared out among processes, facets are those that touch an own node, and energies and works those
/// of own nodes: their sums over the processes are the wall's.
template <int n>
class WallSupports {
 public:
  using Mixed = MixedLayout<n>;
  using Matrix = WallMatrix<n>;
  /// A load: adds to the residual and, if there is one, to the Jacobian.
  /// \param p         its strength, kPa; of forces per volume kPa/mm
  /// \param solution  (d, .), mixed layout, mm
  using Load = std::function<void(double p, const double* solution, std::vector<double>& residual, Matrix* jacobian)>;

  /// \param graph  that of the wall's matrices; must outlive this
  /// \param share  of the wall's nodes among processes; null: they are all here
  explicit WallSupports(const NodeGraph& graph, std::shared_ptr<const NodeShare> share = nullptr)
      : graph_(graph), share_(std::move(share)) {}

  /// Springs, and dampers, on facets in the wall's node numbers, normals out of it. To be called by all processes.
  /// \param x  the nodes at rest, mm
  template <class Element, class Facet>
  void add_springs(const std::vector<Point>& x, const std::vector<Facet>& facets, const Bedding& stiffness) {
    springs_.template add<Element>(graph_, x, facets, stiffness, share_.get());
    has_springs_ = has_springs_ || anywhere(!facets.empty());
  }
  template <class Element, class Facet>
  void add_dampers(const std::vector<Point>& x, const std::vector<Facet>& facets, const Bedding& damping) {
    dampers_.template add<Element>(graph_, x, facets, damping, share_.get());
    has_dampers_ = has_dampers_ || anywhere(!facets.empty());
  }
  /// A load whose strength is the next of WallInput::support_loads: a pressure that follows the surface.
  template <class Element, class Facet>
  void add_pressure(const std::vector<Point>& x, const std::vector<Facet>& facets) {
    loads_.push_back([x, facets](double p, const double* solution, std::vector<double>& residual, Matrix* jacobian) {
      add_follower_pressure<Element>(x, facets, p, solution, residual, jacobian);
    });
  }
  /// Likewise, a component of a traction per area at rest.
  template <class Element, class Facet>
  void add_traction(const std::vector<Point>& x, const std::vector<Facet>& facets, int component) {
    std::vector<Share> shares;
    const std::vector<double> areas = vector_shape_integrals<Element>(x, facets);
    for (std::size_t a = 0; a < areas.size(); ++a)
      if (areas[a] != 0) shares.push_back({Mixed::vector(static_cast<int>(a), component), areas[a]});
    add_dead_load(std::move(shares));
  }
  /// Likewise, a component of a force per volume at rest, in kPa/mm.
  /// \param integrals  of the vectors' shape functions over the wall, in the mixed layout, mm^3
  void add_force(const std::vector<double>& integrals, int component) {
    std::vector<Share> shares;
    for (int a = 0; a < graph_.rows(); ++a) {
      const std::size_t entry = Mixed::vector(a, component);
      if (integrals[entry] != 0) shares.push_back({entry, integrals[entry]});
    }
    add_dead_load(std::move(shares));
  }

  std::size_t load_count() const { return loads_.size(); }
  bool has_springs() const { return has_springs_; }  ///< at any of the processes
  bool has_dampers() const { return has_dampers_; }

  /// Adds to the wall's residual and, if there is one, to its Jacobian.
  void add(const WallInput& in, std::vector<double>& residual, Matrix* jacobian) const;
  /// Energy in the springs of own nodes, uJ. \param wall  (d, .)
  double stored(const std::vector<double>& wall) const;
  /// a . K b of the rows of own nodes of the springs' matrix, arrays as (d, .)
  double spring_product(const std::vector<double>& a, const std::vector<double>& b) const {
    return springs_.product(a.data(), b.data());
  }
  SupportWork work(const WallStep& step) const;

 private:
  /// A matrix of the nodes of some surfaces, one block for each pair that shares a facet.
  struct SurfaceMatrix {
    struct Entry {
      int row, column;
      int position;  ///< of the block in the wall's matrices
      double block[n][n];
    };
    std::vector<Entry> entries;  ///< ascending in row and column; rows of own nodes alone

    template <class Element, class Facet>
    void add(const NodeGraph& graph, const std::vector<Point>& x, const std::vector<Facet>& facets,
             const Bedding& bedding, const NodeShare* share);
    /// Sum of y . A d, arrays in the mixed layout.
    double product(const double* y, const double* d) const;
    /// Makes one entry of those that share a place.
    void merge();
  };

  /// What of a load that does not follow the wall belongs to an entry.
  struct Share {
    std::size_t entry;
    double measure;  ///< mm^2, or mm^3
  };
  void add_dead_load(std::vector<Share> shares) {
    loads_.push_back([shares = std::move(shares)](double p, const double*, std::vector<double>& residual, Matrix*) {
      for (const Share& share : shares) residual[share.entry] -= p * share.measure;
    });
  }

  static std::vector<double> difference(const double* a, const double* b, double factor, std::size_t size);
  bool anywhere(bool here) const { return share_ ? share_->processes->any(here) : here; }

  const NodeGraph& graph_;
  std::shared_ptr<const NodeShare> share_;
  bool has_springs_ = false, has_dampers_ = false;
  SurfaceMatrix springs_, dampers_;
  std::vector<Load> loads_;
};

template <int n>
template <class Element, class Facet>
void WallSupports<n>::SurfaceMatrix::add(const NodeGraph& graph, const std::vector<Point>& x,
                                         const std::vector<Facet>& facets, const Bedding& bedding,
                                         const NodeShare* share) {
  using F = typename Element::Facet;
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    facet_corners<F>(x, facet, corner);
    for (int a = 0; a < F::nodes; ++a) {
      if (share && share->owned[facet[a]] == 0) continue;  // a row of another process
      for (int b = 0; b < F::nodes; ++b) {
        double block[n][n] = {};
        for (int q = 0; q < F::points; ++q) {
          const auto normal = F::weighted_normal(corner, q);
          const double area = sqrt(dot(normal, normal))[0], scale = area * F::shape(q, a) * F::shape(q, b);
          for (int i = 0; i < n; ++i) {
            block[i][i] += bedding.full * scale;
            for (int j = 0; j < n; ++j)
              block[i][j] +=
                  bedding.normal * scale * (normal[Element::axis[i]][0] / area) * (normal[Element::axis[j]][0] / area);
          }
        }
        Entry entry{facet[a], facet[b], graph.find(facet[a], facet[b]), {}};
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) entry.block[i][j] = block[i][j];
        entries.push_back(entry);
      }
    }
  }
  merge();
}

extern template class WallSupports<2>;
extern template class WallSupports<3>;

}  // namespace fsi
