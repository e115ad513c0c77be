#pragma once

#include <cmath>
#include <string>

#include "materials/material.hpp"
#include "mesher/artery_generator.hpp"
#include "scene/build_scene.hpp"

namespace fsi {

inline MaterialData layer(const std::string& material, double c10) {
  const ParameterValues values{{"c10", c10}, {"c01", 0.3}, {"k1", 2.3632}, {"k2", 0.8393}, {"alpha", 29}};
  MaterialData data{material, {}};
  for (const auto& parameter : materials().at(material).parameters)
    if (const auto value = values.find(parameter.name); value != values.end()) data.values.insert(*value);
  return data;
}

inline Case artery(const std::string& material) {
  Case setup;
  setup.fluid = FluidData{1.0, 3.5e-3};
  setup.stabilisation = Stabilisation::paper;
  StructureData wall;
  wall.density = 1.2;
  wall.bulk_modulus = 1e5;
  wall.layer_pressure = LayerPressure::continuous;
  wall.layers = {{"media", layer(material, 3.0)}, {"adventitia", layer(material, 0.3)}};
  setup.structure = wall;
  setup.inlet = PressureTable{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
  TimeData time;
  time.step = 0.125;
  time.end = 12;
  setup.time = time;
  return setup;
}

/// A deformed, flowing state, smooth in space, so that no term vanishes.
inline State moved(const Scene<3>& scene) {
  State state = scene.at_rest();
  const auto wave = [](const Point& x, int k) { return std::sin(0.7 * x[0] + 0.4 * x[1] + 0.3 * x[2] + k); };
  for (int a = 0; a < scene.fluid->node_count(); ++a)
    for (int k = 0; k < 3; ++k) {
      state.now.mesh[a * 3 + k] = 0.01 * wave(scene.fluid->nodes().nodes[a], k);
      state.now.fluid[a * 4 + k] = 0.5 * wave(scene.fluid->nodes().nodes[a], k + 3);
    }
  for (int a = 0; a < scene.wall->node_count(); ++a)
    for (int k = 0; k < 3; ++k) state.now.wall[a * 4 + k] = 0.02 * wave(scene.wall->nodes().nodes[a], k);
  return state;
}

}  // namespace fsi
