#pragma once

#include <cmath>

#include "mesh/mesh_checks.hpp"
#include "mesher/artery_generator.hpp"

namespace fsi::test {

inline TetrahedralMesh coarse_artery() {
  return generate_artery(artery_level("coarse"));
}

/// A short artery, for tests that look at every cell.
inline TetrahedralMesh short_artery() {
  ArteryOptions options;
  options.length = 3;
  return generate_artery(options);
}

/// What a scene asks of the meshes of an artery.
inline SceneMeshNeeds artery_needs() {
  SceneMeshNeeds needs;
  needs.fluid = needs.inlet = needs.outlet = true;
  needs.layers = {"media", "adventitia"};
  return needs;
}

/// Any linear function.
inline double linear(const Point& x) {
  return 0.3 - 1.7 * x[0] + 0.9 * x[1] + 2.3 * x[2];
}

}  // namespace fsi::test
