#include "case/pressure_doubts.hpp"

#include <algorithm>
#include <cmath>

#include "materials/material.hpp"

namespace fsi {

namespace {

constexpr double radius_over_thickness = 5, strain_of_vessel = 0.5, strain_of_block = 2;

/// Hoop modulus of the stiffest layer, kPa; 0: there is no wall.
double hoop_modulus_of(const Case& scene) {
  double largest = 0;
  if (scene.structure)
    for (const auto& [name, layer] : scene.structure->layers)
      largest =
          std::max(largest, hoop_modulus(make_material(layer.material, layer.values), scene.structure->bulk_modulus));
  return largest;
}

bool is_from_outside(const std::string& key) {
  return key.rfind("support.", 0) == 0;
}

}  // namespace

std::vector<std::string> warnings_of_doubts(const std::vector<UnitDoubt>& doubts, const Case& scene) {
  std::vector<std::string> warnings;
  const double modulus = doubts.empty() ? 0 : hoop_modulus_of(scene);
  for (const UnitDoubt& doubt : doubts) {
    const double borne =
        is_from_outside(doubt.key) ? strain_of_block * modulus : strain_of_vessel * modulus / radius_over_thickness;
    if (std::abs(doubt.value) > borne) warnings.push_back(doubt.warning);
  }
  return warnings;
}

}  // namespace fsi
