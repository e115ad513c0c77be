#pragma once

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "fem/facet_load.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A surface of the fluid, by name, through which fluid may pass. It does not move.
template <class Element>
class OpenBoundary {
 public:
  static constexpr int n = Element::components;
  using Layout = MixedLayout<n>;
  using Facets = std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet>;

  /// \param nodes   reference positions of the fluid's nodes, mm
  /// \param facets  in their numbers, normals outward
  OpenBoundary(std::string name, const std::vector<Point>& nodes, Facets facets)
      : name_(std::move(name)),
        facets_(std::move(facets)),
        normals_(normal_weights<Element, Layout>(nodes, facets_)),
        areas_(scalar_weights<Element>(nodes, facets_)) {}

  const std::string& name() const { return name_; }

  /// Adds to the fluid's residual what the traction J sigma F^-T N = -pressure N leaves there.
  void add_pressure(double pressure, std::vector<double>& residual) const {
    if (pressure == 0) return;
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] += pressure * normals_[i];
  }

  /// Of a flow array (u, p): volume flow outward, mm^3/ms.
  double outflow(const std::vector<double>& flow) const {
    return std::inner_product(normals_.begin(), normals_.end(), flow.begin(), 0.0);
  }
  /// Mean pressure, kPa; 0 on an empty surface.
  double mean_pressure(const std::vector<double>& flow) const {
    double integral = 0, area = 0;
    for (std::size_t a = 0; a < areas_.size(); ++a) {
      integral += areas_[a] * flow[Layout::scalar(static_cast<int>(a))];
      area += areas_[a];
    }
    return area > 0 ? integral / area : 0;
  }
  /// Integral of |u|^2/2 u . n, mm^5/ms^3: times the density the kinetic energy that flows out, uJ/ms.
  double kinetic_outflow(const std::vector<Point>& nodes, const std::vector<double>& flow) const {
    return kinetic_flux<Element>(nodes, facets_, flow);
  }

 private:
  std::string name_;
  Facets facets_;
  std::vector<double> normals_;  ///< as flow arrays
  std::vector<double> areas_;    ///< per node
};

}  // namespace fsi
