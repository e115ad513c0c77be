#include "case/start_pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case/openings.hpp"
#include "case/support_loads.hpp"
#include "materials/material.hpp"

namespace fsi {

namespace {

constexpr double small = 0.02;    // difference over the shear modulus: widens the tube by 6 % of its radius
constexpr double at_once = 1e12;  // 1/ms: so short a step that what is stored does not change

/// Shear modulus of the stiffest layer, kPa.
double stiffest(const StructureData& structure) {
  double modulus = 0;
  for (const auto& [name, layer] : structure.layers)
    modulus = std::max(modulus, shear_modulus(make_material(layer.material, layer.values)));
  return modulus;
}

}  // namespace

void warn_of_start_pressure(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.fluid || !scene.structure || !scene.time) return;
  const double wall = scene.prestress ? scene.prestress->pressure : 0;
  const bool lumped = scene.time->start == StartOfOpenings::lumped;
  const double large = small * stiffest(*scene.structure);
  const auto warn = [&](const CaseEntry& entry, double pressure, bool keeps,
                        const std::string& where = "this opening") {
    if (std::abs(pressure - wall) <= large) return;
    const std::string carries =
        scene.prestress ? fmt::format("a wall that carries {:g} kPa", wall) : std::string("a wall without load");
    std::string remedy = fmt::format("{} prestress.pressure = {:.4g} where the mesh is the vessel under that pressure",
                                     scene.prestress ? "set" : "add", pressure);
    if (keeps && !lumped)
      remedy += fmt::format(
          ", or begin with {:g} kPa here; time.start = \"lumped\" finds the pressure of the periodic state", wall);
    entry.warn(fmt::format("begins with {:.4g} kPa against {}: the vessel is {} through {} in the first steps",
                           pressure, carries, pressure > wall ? "filled" : "emptied", where),
               remedy);
  };
  for (const auto& opening : openings_of(scene)) {
    const OpeningConditions& conditions = opening;
    const bool listed = scene.openings.count(opening.surface) > 0;
    const CaseEntry entry = listed ? whole_case.child("opening").child(opening.surface)
                                   : whole_case.child(opening.surface == group::inlet ? "inlet" : "fluid");
    if (conditions.law) {
      const auto law = conditions.law->make();
      const auto kept = law->start();
      warn(entry.child(conditions.law->name), law->pressure(at_once, kept.data(), 0), !kept.empty());
    }
    // On a wall without load a pulse is intended; a periodic table is a beat that may begin anywhere, which no vessel
    // without load does.
    if (conditions.pressure && (scene.prestress || (listed && conditions.pressure->period > 0)))
      warn(entry.child("pressure"), first_value(*conditions.pressure), false);
    // Of those that the mesh may lack, nothing is known here.
    if (scene.prestress && opening.is_free() && opening.demanded)
      warn(entry, 0, false, opening.surface + ", which is free of traction,");
  }
}

}  // namespace fsi
