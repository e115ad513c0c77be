#pragma once

#include <string>

#include "case/case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "mesh/simplex_mesh.hpp"
#include "scene/scene.hpp"
#include "time/loads.hpp"

namespace fsi {

/// What the last finished levels tell about the step that failed after them: a wall that yields to more load than it
/// can bear at rest, or mesh elements of the fluid that have lost most of their volume. Empty: nothing of the kind.
std::string failure_hint(const Case& setup, const TetrahedralMesh& mesh, const Scene<P1Tetrahedron>& scene,
                         const Loads& loads, const State& state);

}  // namespace fsi
