#pragma once

#include <string>

#include "materials/material.hpp"
#include "scene/build_scene.hpp"
#include "support/meshes.hpp"

namespace fsi::test {

/// A layer of this material: of the values, those that it has a parameter for.
inline MaterialData layer_of(const std::string& material, const ParameterValues& values) {
  MaterialData layer{material, {}};
  for (const auto& parameter : materials().at(material).parameters)
    if (const auto value = values.find(parameter.name); value != values.end()) layer.values.insert(*value);
  return layer;
}

/// A case of the reference case's fluid and wall data and of the paper's discretisation, layers `media` and
/// `adventitia` of one kind of material (docs/theory.md, section 1.3).
inline Case coupled_case(const std::string& material, double step = 0.125) {
  Case setup;
  setup.stabilisation = Stabilisation::paper;
  setup.fluid = FluidData{1.0, 3.5e-3};
  setup.structure = StructureData{};
  setup.structure->density = 1.2;
  setup.structure->bulk_modulus = 1e5;
  setup.structure->layer_pressure = LayerPressure::continuous;
  setup.structure->fibre_frame = FibreFrame::cylinder;  // also of walls that are no vessels
  setup.structure->layers["media"] =
      layer_of(material, {{"c10", 3.0}, {"c01", 0.3}, {"k1", 2.3632}, {"k2", 0.8393}, {"alpha", 29.0}});
  setup.structure->layers["adventitia"] =
      layer_of(material, {{"c10", 0.3}, {"c01", 0.2}, {"k1", 0.5620}, {"k2", 0.7112}, {"alpha", 62.0}});
  setup.inlet = PressureTable{{{0.0, 1.332}}};
  setup.time = TimeData{step, 100 * step, 1};
  setup.time->scheme = "euler";
  return setup;
}

}  // namespace fsi::test
