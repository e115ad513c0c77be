#include "derived/wall_shear_stress.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "derived/fluid_surface.hpp"
#include "fem/elements.hpp"
#include "scene/restricted_conditions.hpp"

namespace fsi {

namespace {

template <class Element>
class WallShearStressOf : public WallShearStress<Element::components> {
 public:
  static constexpr int n = Element::components;
  using Facet = typename MeshOf<Element>::Facet;

  WallShearStressOf(const Case& setup, const MeshOf<Element>& mesh, const Scene<n>& scene,
                    const WholeParts<Element>& whole)
      : part_(fluid_part<Element>(scene)),
        fluid_(scene.fluid->form()),
        mirrored_(mirrored_components<Element>(mesh, whole_fluid(scene, whole))),
        facets_(solid_facets(fluid_surface<Element>(setup, mesh, whole_fluid(scene, whole)))),
        gradients_(fluid_gradients<Element>(mesh, whole_fluid(scene, whole), own_nodes(facets_, whole.fluid_here.get()),
                                            whole.fluid_here.get())) {
    if (!whole.fluid_here) return;
    mirrored_ = restricted(mirrored_, *whole.fluid_here);
    facets_ = whole.fluid_here->facets(facets_);
  }

  const std::vector<int>& nodes() const override { return gradients_.nodes(); }

  std::vector<double> at_nodes(const Solution& level) const override {
    const std::vector<double> normals = nodal_normals(level.mesh);
    std::vector<double> mesh_buffer, flow_buffer;
    const auto& mesh = gradients_.template reach<VectorLayout<n>>(level.mesh, mesh_buffer);
    const auto& flow = gradients_.template reach<MixedLayout<n>>(level.fluid, flow_buffer);
    std::vector<double> shear(VectorLayout<n>::size(part_.node_count()), 0.0);
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      const int node = nodes()[i];
      Vec3<double> normal{};
      for (int k = 0; k < n; ++k) normal[Element::axis[k]] = normals[VectorLayout<n>::vector(node, k)];
      const double length = std::sqrt(dot(normal, normal));
      if (length == 0) continue;
      normal = (1 / length) * normal;
      const Vec3<double> traction = viscous_stress<n>(gradients_, i, fluid_, mesh, flow) * normal;
      const double along = dot(traction, normal);
      for (int k = 0; k < n; ++k)
        shear[VectorLayout<n>::vector(node, k)] = along * normal[Element::axis[k]] - traction[Element::axis[k]];
    }
    mirrored_.clear(shear);
    std::vector<double> in_space(VectorLayout<3>::size(static_cast<int>(nodes().size())), 0.0);
    for (std::size_t i = 0; i < nodes().size(); ++i)
      for (int k = 0; k < n; ++k)
        in_space[VectorLayout<3>::vector(static_cast<int>(i), Element::axis[k])] =
            shear[VectorLayout<n>::vector(nodes()[i], k)];
    return in_space;
  }

 private:
  /// Nodes of facets that this process owns, in the numbers of the whole fluid.
  static std::vector<int> own_nodes(const std::vector<Facet>& facets, const PartRestriction* here) {
    auto nodes = facet_nodes(facets);
    if (here)
      nodes.erase(std::remove_if(nodes.begin(), nodes.end(), [&](int node) { return !here->owns_whole(node); }),
                  nodes.end());
    return nodes;
  }
  static std::vector<Facet> solid_facets(const FluidSurface<Element>& surface) {
    std::vector<Facet> facets;
    for (const int f : surface.places(FluidFacetKind::solid)) facets.push_back(surface.facets[f]);
    return facets;
  }

  /// Outward normals of no particular length: sums of those of the facets around a node, weighted by N_a^2, since
  /// integrals of quadratic shape functions vanish at the vertices of triangles.
  std::vector<double> nodal_normals(const std::vector<double>& mesh) const {
    using F = typename Element::Facet;
    std::vector<double> normals(VectorLayout<n>::size(part_.node_count()), 0.0);
    for (const auto& facet : facets_) {
      Vec3<Pack> corner[F::nodes];
      current_corners<Element>(part_.nodes, facet, mesh, corner);
      for (int q = 0; q < F::points; ++q) {
        const auto normal = F::weighted_normal(corner, q);
        for (int a = 0; a < F::nodes; ++a)
          for (int k = 0; k < n; ++k)
            normals[VectorLayout<n>::vector(facet[a], k)] +=
                F::shape(q, a) * F::shape(q, a) * normal[Element::axis[k]][0];
      }
    }
    mirrored_.clear(normals);
    return normals;
  }

  const PartOf<Element>& part_;
  AleFluid fluid_;
  VanishingComponents<n> mirrored_;
  std::vector<Facet> facets_;  ///< that the fluid sticks to, normals outward
  GradientRecovery gradients_;
};

}  // namespace

template <class Element>
std::unique_ptr<WallShearStress<Element::components>> make_wall_shear_stress(const Case& setup,
                                                                             const MeshOf<Element>& mesh,
                                                                             const Scene<Element::components>& scene,
                                                                             const WholeParts<Element>& whole) {
  return std::make_unique<WallShearStressOf<Element>>(setup, mesh, scene, whole);
}

#define FSI_INSTANTIATE(Element)                                                                  \
  template std::unique_ptr<WallShearStress<Element::components>> make_wall_shear_stress<Element>( \
      const Case&, const MeshOf<Element>&, const Scene<Element::components>&, const WholeParts<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
