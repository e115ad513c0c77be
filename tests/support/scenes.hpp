#pragma once

#include <string>

#include "scene/build_scene.hpp"
#include "support/meshes.hpp"

namespace fsi::test {

/// A case of the reference case's fluid and wall data, layers `media` and `adventitia` of one kind of material
/// (docs/theory.md, section 1.3).
inline Case coupled_case(const std::string& material, double step = 0.125) {
  Case setup;
  setup.fluid = FluidData{1.0, 3.5e-3, false};
  setup.structure = StructureData{};
  setup.structure->density = 1.2;
  setup.structure->bulk_modulus = 1e5;
  setup.structure->layers["media"] = {material, 3.0, 0.3, 2.3632, 0.8393, 29.0, 1.0};
  setup.structure->layers["adventitia"] = {material, 0.3, 0.2, 0.5620, 0.7112, 62.0, 1.0};
  setup.inlet = PressureTable{{{0.0, 1.332}}};
  setup.time = TimeData{step, 100 * step, 1, 1, 1};
  return setup;
}

}  // namespace fsi::test
