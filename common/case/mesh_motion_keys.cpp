#include <fmt/ranges.h>

#include "case/case_keys.hpp"
#include "case/choices.hpp"
#include "case/key_values.hpp"

namespace fsi {

namespace {

/// Refuses keys of another method than the chosen one, which would have no effect.
void check_mesh_motion(const CaseEntry& entry, MeshMotionOptions& options) {
  using Method = MeshMotionMethod;
  const auto require = [&](const char* key, const std::vector<Method>& methods) {
    if (!entry.has(key)) return;
    std::vector<std::string> names;
    for (const Method method : methods) {
      if (method == options.method) return;
      names.push_back("\"" + mesh_motion_methods().name_of(method) + "\"");
    }
    entry.child(key).refuse(fmt::format("belongs to the method {}, and this case has \"{}\"", fmt::join(names, " or "),
                                        mesh_motion_methods().name_of(options.method)),
                            "remove it, or set mesh_motion.method = " + names.front());
  };
  require("size_exponent", {Method::stiffened, Method::nonlinear_elastic});
  require("distance_exponent", {Method::stiffened, Method::nonlinear_elastic});
  require("poisson", {Method::nonlinear_elastic});
}

}  // namespace

CaseKey<Case> mesh_motion_section() {
  using M = MeshMotionOptions;
  using presence::optional;
  constexpr Bounds exponent{0, 4, true, true}, poisson{0, 0.49, true, true};
  const std::vector<CaseKey<M>> keys = {
      leaf("method", optional,
           "{}; stiffened: harmonic, small elements and those at the interface deform least; nonlinear-elastic: a "
           "hyperelastic solid that no motion folds, some times the cost",
           name_from(at(&M::method), mesh_motion_methods())),
      leaf("size_exponent", optional, "stiffness grows with an element's volume to minus this power, default {}",
           number(at(&M::size_exponent), exponent)),
      leaf("distance_exponent", optional,
           "stiffness grows with the distance from the interface to minus this power, default {}",
           number(at(&M::distance_exponent), exponent)),
      leaf("poisson", optional, "Poisson's ratio of nonlinear-elastic at rest, default {}",
           number(at(&M::poisson), poisson)),
  };
  return section<M, Case>(
      "mesh_motion", optional, "how the fluid's mesh follows the wall", keys,
      [](Case& scene) -> M& { return scene.mesh_motion; },
      [](const Case& scene) { return scene.fluid && scene.structure ? &scene.mesh_motion : nullptr; }, KeyRole::physics,
      check_mesh_motion);
}

}  // namespace fsi
