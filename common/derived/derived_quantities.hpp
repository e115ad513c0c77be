#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "derived/error_indicator.hpp"
#include "derived/mean_errors.hpp"
#include "derived/nodal_wall_thickness.hpp"
#include "derived/period_statistics.hpp"
#include "derived/surface_forces.hpp"
#include "derived/wall_shear_stress.hpp"
#include "derived/wall_stress.hpp"

namespace fsi {

/// The error indicator of a medium's cells, if the case asks for it, and its mean over the run; no mean in statics.
template <int n>
struct MediumErrors {
  std::unique_ptr<ErrorIndicator<n>> indicator;
  std::optional<MeanErrors> mean{};
};

/// Quantities beyond the solution that a case asks for. Null, or empty, where it does not.
template <int n>
struct DerivedQuantities {
  std::unique_ptr<WallShearStress<n>> shear;
  std::unique_ptr<WallStress<n>> stress;
  std::unique_ptr<SurfaceForces<n>> forces;
  std::optional<PeriodStatistics> statistics{};
  MediumErrors<n> fluid_errors{}, wall_errors{};
  std::vector<double> thickness{};  ///< of the wall at rest, mm, per wall node here

  bool has_errors() const { return fluid_errors.indicator || wall_errors.indicator; }
  bool means_errors() const { return fluid_errors.mean || wall_errors.mean; }
};

namespace detail {

/// Names of fields that are prepared on the whole mesh.
inline constexpr std::array<const char*, 1> shear_fields{"wall_shear_stress"}, thickness_fields{"thickness"};
inline constexpr std::array<const char*, 4> stress_fields{"cauchy_stress", "principal_stress", "von_mises_stress",
                                                          "fibre_stress"};

/// Whether the case writes one of these fields.
template <class Names>
bool wants(const Case& setup, const Names& names) {
  const auto& fields = setup.output.fields;
  return setup.output.every > 0 &&
         std::find_first_of(fields.begin(), fields.end(), names.begin(), names.end()) != fields.end();
}

}  // namespace detail

/// Whether a derived quantity of the case needs the whole mesh of a scene that processes share.
inline bool derived_from_mesh(const Case& setup) {
  const auto& output = setup.output;
  return output.derived.statistics || output.derived.error_indicator || !output.derived.surfaces.empty() ||
         !output.derived.forces.empty() || detail::wants(setup, detail::shear_fields) ||
         detail::wants(setup, detail::stress_fields) || detail::wants(setup, detail::thickness_fields);
}

/// Makes what the case asks for. Collective over the processes that share the scene.
/// \param mesh   that the scene was built on; not read unless derived_from_mesh()
/// \param scene  must outlive what is made
/// \param whole  whole parts of a mesh that processes share; empty: the scene has them
/// \throws InputError for forces on surfaces that do not bound the fluid, or in a case without fluid
template <class Element>
DerivedQuantities<Element::components> make_derived_quantities(const Case& setup, const MeshOf<Element>& mesh,
                                                               const Scene<Element::components>& scene,
                                                               const WholeParts<Element>& whole = {}) {
  const auto& output = setup.output;
  const auto wants = [&](const auto& names) { return detail::wants(setup, names); };
  DerivedQuantities<Element::components> derived;
  if (scene.fluid && (output.derived.statistics || wants(detail::shear_fields))) {
    const auto phase = scene.profile.phase("wall shear stress: setup");
    derived.shear = make_wall_shear_stress<Element>(setup, mesh, scene, whole);
    const auto nodes = static_cast<std::int64_t>(derived.shear->nodes().size());
    scene.profile.count("nodes with wall shear stress", scene.processes().sum(nodes));
  }
  if (scene.wall && wants(detail::stress_fields)) {
    const auto phase = scene.profile.phase("wall stress: setup");
    derived.stress = make_wall_stress<Element>(setup, mesh, scene, whole);
  }
  if (scene.wall && wants(detail::thickness_fields))
    derived.thickness = nodal_wall_thickness<Element>(mesh, scene, whole);
  derived.forces = make_surface_forces<Element>(setup, mesh, scene, whole);
  if (derived.forces)
    scene.profile.count("surfaces with forces", static_cast<std::int64_t>(derived.forces->names().size()));
  if (output.derived.statistics && output.derived.period) derived.statistics.emplace(*output.derived.period);
  if (output.derived.error_indicator) {
    const auto phase = scene.profile.phase("error indicator: setup");
    derived.fluid_errors.indicator = make_fluid_indicator<Element>(mesh, scene, whole);
    derived.wall_errors.indicator = make_wall_indicator<Element>(setup, mesh, scene, whole);
    for (auto* medium : {&derived.fluid_errors, &derived.wall_errors})
      if (medium->indicator && !scene.is_static()) medium->mean.emplace();
  }
  return derived;
}

}  // namespace fsi
