#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "fem/facet_load.hpp"
#include "fluid/fluid_input.hpp"
#include "fluid/moving_surface.hpp"
#include "mesh/simplex_mesh.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// A surface of the fluid, by name, through which fluid may pass. It stays where it is, unless move_by() says otherwise.
/// Vectors have n components. Integrals over it are those of all processes, which ask for them together.
template <int n>
class OpenBoundary {
 public:
  using Layout = MixedLayout<n>;
  /// Integral of |u|^2/2 u . n for nodes (reference positions, mm) and a flow array, mm^5/ms^3.
  using KineticFlux = std::function<double(const std::vector<Point>& nodes, const std::vector<double>& flow)>;

  /// To be called by all of `processes`.
  /// \param normals    integrals of N_a n, as flow arrays, mm^2; zero at ghosts
  /// \param areas      integrals of the scalar fields' shape functions per node, mm^2; zero at ghosts
  /// \param facets     nodes of its facets, one after the other
  /// \param processes  that share the fluid; the other parameters are this process's share. Must outlive this
  OpenBoundary(std::string name, std::vector<double> normals, std::vector<double> areas, KineticFlux kinetic_flux,
               std::vector<int> facets, const Communicator& processes = Communicator::alone())
      : name_(std::move(name)),
        normals_(std::move(normals)),
        areas_(std::move(areas)),
        kinetic_flux_(std::move(kinetic_flux)),
        facets_(std::move(facets)),
        processes_(&processes),
        empty_(!processes.any(std::any_of(areas_.begin(), areas_.end(), [](double area) { return area != 0; }))) {}

  const std::string& name() const { return name_; }
  /// Integrals of N_a n at rest, as a flow array, mm^2; zero at ghosts (nodes of other processes).
  const std::vector<double>& normals() const { return normals_; }
  /// Lets it move with the mesh.
  void move_by(std::shared_ptr<const MovingSurface<n>> surface) { moving_ = std::move(surface); }
  /// Null where it stays.
  const MovingSurface<n>* moving() const { return moving_.get(); }
  /// Whether there is a surface at all.
  bool empty() const { return empty_; }

  /// The nodes of its facets, one after the other, normals outward.
  const std::vector<int>& facets() const { return facets_; }

  /// Adds to the fluid's residual what the traction J sigma F^-T N = -pressure J F^-T N leaves there and, unless null,
  /// its derivative by the mesh's displacement.
  void add_pressure(double pressure, const double* mesh, std::vector<double>& residual,
                    typename MovingSurface<n>::ShapeDerivatives* derivatives) const {
    if (!moving_)
      add_pressure(pressure, residual);
    else if (pressure != 0)
      moving_->add_pressure(pressure, mesh, residual.data(), derivatives);
  }
  /// Of an opening that stays.
  void add_pressure(double pressure, std::vector<double>& residual) const {
    if (pressure == 0) return;
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] += pressure * normals_[i];
  }

  /// Of a mesh displacement and a flow array (u, p): volume flow outward through the surface where it is, mm^3/ms.
  double outflow(const double* mesh, const double* flow) const {
    return moving_ ? processes_->sum(moving_->outflow(mesh, flow)) : outflow(flow);
  }
  double outflow(const std::vector<double>& mesh, const std::vector<double>& flow) const {
    return outflow(mesh.data(), flow.data());
  }
  /// Of an opening that stays.
  double outflow(const std::vector<double>& flow) const { return outflow(flow.data()); }
  double outflow(const double* flow) const {
    return processes_->sum(std::inner_product(normals_.begin(), normals_.end(), flow, 0.0));
  }
  /// What passes it as it moves, integral of (u - w) . n, w the mesh's velocity where the opening moves, mm^3/ms.
  double relative_outflow(const FluidInput& in) const {
    return moving_ ? processes_->sum(moving_->relative_outflow(in)) : outflow(in.fluid);
  }
  /// Area at rest, mm^2, as far as scalar shape functions have it.
  double area() const { return processes_->sum(std::accumulate(areas_.begin(), areas_.end(), 0.0)); }
  /// Mean pressure, kPa; 0 on an empty surface.
  double mean_pressure(const std::vector<double>& mesh, const std::vector<double>& flow) const {
    return moving_ ? mean_of(moving_->areas(mesh.data()), flow) : mean_of(areas_, flow);
  }
  /// Of an opening that stays.
  double mean_pressure(const std::vector<double>& flow) const { return mean_of(areas_, flow); }
  /// Integral of |u|^2/2 (u - w) . n, w the mesh's velocity where the opening moves, mm^5/ms^3: times the density the
  /// kinetic energy that flows out, uJ/ms. \param flow  that of `in`
  double kinetic_outflow(const std::vector<Point>& nodes, const FluidInput& in, const std::vector<double>& flow) const {
    return moving_ ? processes_->sum(moving_->kinetic_outflow(in)) : kinetic_outflow(nodes, flow);
  }
  /// Of an opening that stays.
  double kinetic_outflow(const std::vector<Point>& nodes, const std::vector<double>& flow) const {
    return processes_->sum(kinetic_flux_(nodes, flow));
  }

 private:
  double mean_of(const std::vector<double>& areas, const std::vector<double>& flow) const {
    std::array<double, 2> sums{};  // of the pressure, and of one
    for (std::size_t a = 0; a < areas.size(); ++a) {
      sums[0] += areas[a] * flow[Layout::scalar(static_cast<int>(a))];
      sums[1] += areas[a];
    }
    processes_->sum(sums.data(), sums.size());
    return sums[1] > 0 ? sums[0] / sums[1] : 0;
  }

  std::string name_;
  std::vector<double> normals_;  ///< as flow arrays
  std::vector<double> areas_;    ///< per node
  KineticFlux kinetic_flux_;
  std::vector<int> facets_;
  const Communicator* processes_;
  bool empty_;
  std::shared_ptr<const MovingSurface<n>> moving_;
};

/// \param nodes   reference positions of the fluid's nodes, mm
/// \param facets  in their numbers, normals outward
/// \param share   of the nodes, if they are shared out: the facets are those that touch an own node; null: they are whole
/// \param counted  of the facets then, those that sums count here
template <class Element>
OpenBoundary<Element::components> open_boundary(
    std::string name, const std::vector<Point>& nodes,
    const std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet>& facets,
    const NodeShare* share = nullptr,
    const std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet>& counted = {}) {
  using Layout = MixedLayout<Element::components>;
  std::vector<int> facet_nodes;
  for (const auto& facet : facets) facet_nodes.insert(facet_nodes.end(), facet.begin(), facet.end());
  auto normals = normal_weights<Element, Layout>(nodes, facets);
  auto areas = scalar_weights<Element>(nodes, facets);
  for (std::size_t a = 0; share != nullptr && a < areas.size(); ++a) {
    if (share->owned[a] != 0) continue;
    std::fill_n(normals.begin() + static_cast<std::ptrdiff_t>(Layout::vector(static_cast<int>(a))), Layout::entries,
                0.0);
    areas[a] = 0;
  }
  return {std::move(name),
          std::move(normals),
          std::move(areas),
          [mine = share ? counted : facets](const std::vector<Point>& at, const std::vector<double>& flow) {
            return kinetic_flux<Element>(at, mine, flow);
          },
          std::move(facet_nodes),
          share ? *share->processes : Communicator::alone()};
}

}  // namespace fsi
