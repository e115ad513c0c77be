#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "fem/facet_load.hpp"
#include "fem/mid_edge_nodes.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The wall as a membrane on the interface: what the Robin condition knows of it.
struct Membrane {
  double area = 0;                 ///< of the interface, mm^2
  double thickness = 0;            ///< h, wall volume over interface area, mm
  double radius = 0;               ///< R, twice the fluid's volume over the interface's area: a tube's radius, mm
  double density = 0;              ///< rho_s, mg/mm^3
  double shear_modulus = 0;        ///< mean over the thickness, kPa
  double tension = 0;              ///< E h / (1 - nu^2) along the circumference, kPa mm
  std::vector<double> node_areas;  ///< per interface node, mm^2

  /// Hoop stiffness E h / ((1 - nu^2) R^2): pressure per normal displacement, kPa/mm.
  double stiffness() const { return tension / (radius * radius); }

  /// Traction per interface velocity, kPa/(mm/ms), with which the wall answers within a step whose acceleration is
  /// `acceleration_factor` (1/ms^2) times the displacement. Pushed outward, its whole thickness moves, and the hoop
  /// stretches; pushed along, it shears, and inertia is felt to a depth of l only:
  ///   z_n = dt (a rho_s h + E h / ((1 - nu^2) R^2)),   z_t = dt a rho_s l tanh(h / l),   l = sqrt(mu / (a rho_s)).
  /// A Robin-Neumann pass with coefficient alpha multiplies the error of a mode, z being the wall's impedance for it
  /// and f the fluid's, by (1 - alpha / z) f / (f + alpha). Where the added mass is large the last factor is one, and
  /// best for all z from z_t to z_n is their harmonic mean, alpha = 2 / (1/z_n + 1/z_t): within a tenth the best by
  /// trial for time steps from a tenth to four times the artery's, and for a wall ten times softer.
  double impedance(double acceleration_factor, double step) const {
    const double inertia = acceleration_factor * density;
    const double depth = std::sqrt(shear_modulus / inertia);
    const double across = step * (inertia * thickness + stiffness());
    const double along = step * inertia * depth * std::tanh(thickness / depth);
    return 2 / (1 / across + 1 / along);
  }
};

namespace detail {

template <class Element>
double volume_of_lane(const typename ElementPacks<Element>::ElementPack& pack, int lane) {
  double volume = 0;
  for (int q = 0; q < Element::points; ++q) volume += Element::at(pack.geometry, q).weight[lane];
  return volume;
}

/// Volume of the elements of some packs, mm^3. Threads share packs; each element counts once.
template <class Element>
double volume_of(const ElementPacks<Element>& packs, std::size_t cells) {
  std::vector<char> seen(cells, 0);
  double volume = 0;
  for (int t = 0; t < packs.thread_count(); ++t)
    for (const auto& pack : packs.of_thread(t))
      for (int lane = 0; lane < pack_width; ++lane) {
        if (seen[pack.cell[lane]]) continue;
        seen[pack.cell[lane]] = 1;
        volume += volume_of_lane<Element>(pack, lane);
      }
  return volume;
}

/// Facets of the fluid's boundary with all nodes on the interface.
template <class Element>
auto wet_facets(const Scene<Element>& scene) {
  using Facet = typename SimplexMesh<Element::dim, Element::order>::Facet;
  std::vector<char> wet(scene.fluid->node_count(), 0);
  for (const auto& node : scene.interface) wet[node.fluid] = 1;
  std::map<Facet, int> count;
  for (const auto& cell : scene.fluid->part().cells)
    for (int vertex = 0; vertex <= Element::dim; ++vertex) {
      const Facet facet = facet_opposite<Element::dim, Element::order>(cell, vertex);
      if (std::all_of(facet.begin(), facet.end(), [&](int node) { return wet[node]; })) ++count[facet];
    }
  std::vector<Facet> facets;
  for (const auto& [facet, cells] : count)
    if (cells == 1) facets.push_back(facet);
  return facets;
}

}  // namespace detail

template <class Element>
Membrane membrane_of(const Scene<Element>& scene) {
  Membrane m;
  const auto areas = nodal_areas<Element>(scene.fluid->part().nodes, detail::wet_facets(scene));
  for (const auto& node : scene.interface) {
    m.node_areas.push_back(areas[node.fluid]);
    m.area += areas[node.fluid];
  }
  m.density = scene.wall->constants().density;
  m.radius = 2 * detail::volume_of(scene.fluid->packs(), scene.fluid->part().cells.size()) / m.area;
  for (const auto& layer : scene.wall->layers()) {
    const double h = detail::volume_of(layer.packs, scene.wall->part().cells.size()) / m.area;
    const double mu = shear_modulus(layer.material), kappa = scene.wall->constants().bulk_modulus;
    const double nu = (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
    const double young = 2 * mu * (1 + nu) + fibre_stiffness(layer.material);
    m.thickness += h;
    m.shear_modulus += mu * h;
    m.tension += young * h / (1 - nu * nu);
  }
  m.shear_modulus /= m.thickness;
  return m;
}

}  // namespace fsi
