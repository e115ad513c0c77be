#include "derived/surface_forces.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "derived/fluid_surface.hpp"
#include "fem/elements.hpp"
#include "parallel/partial_sums.hpp"

namespace fsi {

namespace {

constexpr const char* interface_name = "interface";
constexpr const char* walls_name = "walls";

/// The places on the fluid's boundary of a surface that the case names.
template <class Element>
std::vector<int> places_of(const Case& setup, const MeshOf<Element>& mesh, const Scene<Element::components>& scene,
                           const FluidSurface<Element>& surface, const std::string& key, const std::string& name) {
  std::vector<int> places;
  if (name == interface_name && scene.coupled()) {
    std::vector<int> wall_regions;
    for (const auto& [layer, data] : setup.structure->layers) wall_regions.push_back(mesh.region_index(layer));
    places = surface.places(interface_facets(mesh, mesh.region_index(group::fluid), wall_regions));
  } else if (name == walls_name) {
    places = surface.places(FluidFacetKind::solid);
  } else {
    places = surface.places(group_facets(mesh, name));
  }
  if (!places.empty()) return places;
  std::vector<std::string> known{walls_name};
  if (scene.coupled()) known.emplace_back(interface_name);
  for (const auto& group : mesh.facet_groups)
    if (!surface.places(group.facets).empty()) known.push_back(group.name);
  const bool in_mesh = mesh.facets(name) != nullptr;
  throw InputError(setup.path.string(), key,
                   "\"" + name + "\" " + (in_mesh ? "does not bound the fluid" : "is no surface of the mesh"),
                   "give " + one_of(known));
}

template <class Element>
class SurfaceForcesOf : public SurfaceForces<Element::components> {
 public:
  static constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  using Facet = typename MeshOf<Element>::Facet;

  SurfaceForcesOf(const Case& setup, const MeshOf<Element>& mesh, const Scene<n>& scene,
                  const WholeParts<Element>& whole)
      : scene_(scene), part_(fluid_part<Element>(scene)) {
    // Surfaces and gradients are set up on the whole fluid.
    const PartOf<Element>& fluid = whole_fluid(scene, whole);
    const PartRestriction* here = whole.fluid_here.get();
    const auto surface = fluid_surface<Element>(setup, mesh, fluid);
    facets_ = surface.facets;
    // Openings some of whose velocities are not prescribed; those at their rims are held by the walls.
    std::vector<char> is_free(facets_.size(), 0);
    for (const auto& opening : openings_of(setup)) {
      const auto places = surface.places(group_facets(mesh, opening.surface));
      const auto nodes = surface.nodes(places);
      const auto held = [&](int node) {
        return here ? here->local(node) < 0 || is_held(here->local(node)) : is_held(node);
      };
      if (scene.processes().any(!std::all_of(nodes.begin(), nodes.end(), held)))
        for (const int f : places) is_free[f] = 1;
    }
    std::set<int> stressed;  // nodes where gradients are needed
    const auto add = [&](const std::string& name, const std::string& key, const std::vector<std::string>& members) {
      Set set;
      for (const auto& member : members) {
        const auto places = places_of<Element>(setup, mesh, scene, surface, key, member);
        set.facets.insert(set.facets.end(), places.begin(), places.end());
      }
      std::sort(set.facets.begin(), set.facets.end());
      set.facets.erase(std::unique(set.facets.begin(), set.facets.end()), set.facets.end());
      const auto count = std::count_if(set.facets.begin(), set.facets.end(), [&](int f) { return is_free[f] != 0; });
      if (count > 0 && count < static_cast<std::ptrdiff_t>(set.facets.size()))
        throw InputError(setup.path.string(), key, "joins openings to surfaces that the fluid sticks to",
                         "name them apart: forces are found in different ways");
      set.by_equations = count == 0;
      if (set.by_equations) {
        set.nodes = surface.nodes(set.facets);
        // The rows of nodes on the rim contain a share of the traction beside the surface. Where that is not given, it
        // is subtracted again, on a strip one element wide.
        std::vector<char> inside(facets_.size(), 0), on(fluid.nodes.size(), 0);
        for (const int f : set.facets) inside[f] = 1;
        for (const int node : set.nodes) on[node] = 1;
        for (std::size_t f = 0; f < facets_.size(); ++f) {
          const bool touches = std::any_of(facets_[f].begin(), facets_[f].end(), [&](int node) { return on[node]; });
          if (inside[f] || !touches || is_free[f] != 0 || surface.kinds[f] == FluidFacetKind::axis) continue;
          set.beside.push_back(static_cast<int>(f));
        }
      }
      if (here) restrict_to(*here, set);
      for (const int f : set.by_equations ? set.beside : set.facets)
        stressed.insert(facets_[f].begin(), facets_[f].end());
      names_.push_back(name);
      sets_.push_back(std::move(set));
    };
    for (const auto& name : setup.output.derived.surfaces) add(name, "output.surfaces", {name});
    for (const auto& [name, members] : setup.output.derived.forces)
      add(name, "output.forces." + name + ".surfaces", members);
    gradients_.emplace(fluid_gradients<Element>(mesh, fluid, {stressed.begin(), stressed.end()}, here));
    if (here)
      for (Facet& facet : facets_)
        for (int& node : facet) node = here->local(node);
    entry_.assign(part_.nodes.size(), -1);
    for (std::size_t i = 0; i < gradients_->size(); ++i) entry_[gradients_->nodes()[i]] = static_cast<int>(i);
  }

  const std::vector<std::string>& names() const override { return names_; }

  std::vector<SurfaceForce> at(const Balance& balance) const override {
    assert(scene_.fluid);
    std::vector<double> mesh_buffer, flow_buffer, residual;
    const auto& mesh = gradients_->template reach<Vector>(balance.at.mesh, mesh_buffer);
    const auto& flow = gradients_->template reach<Mixed>(balance.at.fluid, flow_buffer);
    scene_.assemble_fluid(balance.at, balance.data, residual);
    std::vector<Mat3<double>> stress;
    for (std::size_t i = 0; i < gradients_->size(); ++i)
      stress.push_back(viscous_stress<n>(*gradients_, i, scene_.fluid->form(), mesh, flow));
    std::vector<SurfaceForce> forces;
    for (const Set& set : sets_) {
      SurfaceForce force;
      std::vector<char> on(set.by_equations ? part_.nodes.size() : 0, 0);
      if (set.by_equations) {
        for (const int node : set.nodes) {
          on[node] = 1;
          for (int k = 0; k < n && part_.owns(node); ++k)
            force.force[Element::axis[k]] -= residual[Mixed::vector(node, k)];
        }
        for (const int f : set.beside) force.force = force.force - traction(f, mesh, flow, stress, &on);
      } else {
        for (const int f : set.facets) force.force = force.force + traction(f, mesh, flow, stress, nullptr);
      }
      for (const int f : set.facets) add_pressure(f, mesh, flow, force);
      forces.push_back(force);
    }
    PartialSums sums;
    for (SurfaceForce& force : forces) {
      sums.include(force.area);
      for (int i = 0; i < 3; ++i) {
        sums.include(force.force[i]);
        sums.include(force.pressure[i]);
      }
    }
    sums.add_up(scene_.processes());
    if constexpr (Element::axisymmetric)
      for (SurfaceForce& force : forces) force.force[0] = force.pressure[0] = 0;  // all round they cancel
    return forces;
  }

 private:
  struct Set {
    bool by_equations = true;
    std::vector<int> facets;  ///< places
    std::vector<int> nodes;   ///< of the surface; ghosts too
    std::vector<int> beside;  ///< facets that touch these nodes, with a traction that is not given
  };

  /// Keeps the facets that this process counts in sums, and the nodes that are here.
  void restrict_to(const PartRestriction& here, Set& set) const {
    for (auto* places : {&set.facets, &set.beside})
      places->erase(std::remove_if(places->begin(), places->end(), [&](int f) { return !here.counts(facets_[f]); }),
                    places->end());
    set.nodes = here.nodes(set.nodes);
  }

  bool is_held(int node) const {
    for (int k = 0; k < n; ++k)
      if (!scene_.velocity_conditions.fixes(node, k)) return false;
    return true;
  }

  static double pressure_at(const Facet& facet, int q, const std::vector<double>& flow) {
    using F = typename Element::Facet;
    double p = 0;
    for (int a = 0; a < F::scalar_nodes; ++a) p += F::scalar_shape(q, a) * flow[Mixed::scalar(facet[a])];
    return p;
  }

  /// Integral of phi (p n - S n) over a current facet: the fluid's force on the other side.
  /// \param on  phi is the sum of the shape functions of these nodes; null: one
  Vec3<double> traction(int place, const std::vector<double>& mesh, const std::vector<double>& flow,
                        const std::vector<Mat3<double>>& stress, const std::vector<char>* on) const {
    using F = typename Element::Facet;
    const Facet& facet = facets_[place];
    Vec3<Pack> corner[F::nodes];
    current_corners<Element>(part_.nodes, facet, mesh, corner);
    Vec3<double> sum{};
    for (int q = 0; q < F::points; ++q) {
      const auto packed = F::weighted_normal(corner, q);
      const Vec3<double> normal{{packed[0][0], packed[1][0], packed[2][0]}};
      Mat3<double> s{};
      double phi = 0;
      for (int a = 0; a < F::nodes; ++a) {
        s = s + F::shape(q, a) * stress[entry_[facet[a]]];
        if (on == nullptr || (*on)[facet[a]] != 0) phi += F::shape(q, a);
      }
      sum = sum + phi * (pressure_at(facet, q, flow) * normal - s * normal);
    }
    return sum;
  }

  void add_pressure(int place, const std::vector<double>& mesh, const std::vector<double>& flow,
                    SurfaceForce& force) const {
    using F = typename Element::Facet;
    const Facet& facet = facets_[place];
    Vec3<Pack> corner[F::nodes];
    current_corners<Element>(part_.nodes, facet, mesh, corner);
    for (int q = 0; q < F::points; ++q) {
      const auto packed = F::weighted_normal(corner, q);
      const Vec3<double> normal{{packed[0][0], packed[1][0], packed[2][0]}};
      force.area += std::sqrt(dot(normal, normal));
      force.pressure = force.pressure + pressure_at(facet, q, flow) * normal;
    }
  }

  const Scene<n>& scene_;
  const PartOf<Element>& part_;
  std::vector<Facet> facets_;  ///< of the fluid's boundary, normals outward; numbers here, -1 at nodes elsewhere
  std::vector<std::string> names_;
  std::vector<Set> sets_;
  std::optional<GradientRecovery> gradients_;
  std::vector<int> entry_;  ///< per node, in gradients_; -1: not there
};

}  // namespace

template <class Element>
std::unique_ptr<SurfaceForces<Element::components>> make_surface_forces(const Case& setup, const MeshOf<Element>& mesh,
                                                                        const Scene<Element::components>& scene,
                                                                        const WholeParts<Element>& whole) {
  if (setup.output.derived.surfaces.empty() && setup.output.derived.forces.empty()) return nullptr;
  if (!scene.fluid)
    throw InputError(setup.path.string(), setup.output.derived.surfaces.empty() ? "output.forces" : "output.surfaces",
                     "asks for forces of the fluid, and the scene has none", "remove it");
  return std::make_unique<SurfaceForcesOf<Element>>(setup, mesh, scene, whole);
}

#define FSI_INSTANTIATE(Element)                                                             \
  template std::unique_ptr<SurfaceForces<Element::components>> make_surface_forces<Element>( \
      const Case&, const MeshOf<Element>&, const Scene<Element::components>&, const WholeParts<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
