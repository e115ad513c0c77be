#pragma once

#include <algorithm>
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

/// The error indicator of a medium's cells, if it is wanted, and its mean over the run, of scenes in time.
template <int n>
struct MediumErrors {
  std::unique_ptr<ErrorIndicator<n>> indicator;
  std::optional<MeanErrors> mean{};
};

/// What a case asks for beyond the solution. Null, or empty, where it does not: then nothing of it is made or computed.
template <int n>
struct DerivedQuantities {
  std::unique_ptr<WallShearStress<n>> shear;
  std::unique_ptr<WallStress<n>> stress;
  std::unique_ptr<SurfaceForces<n>> forces;
  std::optional<PeriodStatistics> statistics{};
  MediumErrors<n> fluid_errors{}, wall_errors{};
  std::vector<double> thickness{};  ///< of the wall at rest, mm, per node of it here

  bool has_errors() const { return fluid_errors.indicator || wall_errors.indicator; }
  bool means_errors() const { return fluid_errors.mean || wall_errors.mean; }
};

/// \param mesh   that the scene was built on
/// \param scene  must outlive what is made
/// \param whole  parts of a mesh that is shared out; empty: the scene has them
/// \throws InputError for surfaces that the fluid does not have
template <class Element>
DerivedQuantities<Element::components> make_derived_quantities(const Case& setup, const MeshOf<Element>& mesh,
                                                               const Scene<Element::components>& scene,
                                                               const WholeParts<Element>& whole = {}) {
  const auto& output = setup.output;
  const auto wants = [&](std::initializer_list<const char*> names) {
    return output.every > 0 && std::find_first_of(output.fields.begin(), output.fields.end(), names.begin(),
                                                  names.end()) != output.fields.end();
  };
  DerivedQuantities<Element::components> derived;
  if (scene.fluid && (output.derived.statistics || wants({"wall_shear_stress"}))) {
    const auto phase = scene.profile.phase("wall shear stress: setup");
    derived.shear = make_wall_shear_stress<Element>(setup, mesh, scene, whole);
    const auto nodes = static_cast<std::int64_t>(derived.shear->nodes().size());
    scene.profile.count("nodes with wall shear stress", scene.processes().sum(nodes));
  }
  if (scene.wall && wants({"cauchy_stress", "principal_stress", "von_mises_stress", "fibre_stress"})) {
    const auto phase = scene.profile.phase("wall stress: setup");
    derived.stress = make_wall_stress<Element>(setup, mesh, scene, whole);
  }
  if (scene.wall && wants({"thickness"})) derived.thickness = nodal_wall_thickness<Element>(mesh, scene, whole);
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
