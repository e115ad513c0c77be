#pragma once

#include "case/case.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Refuses a wall with supports that could move as a rigid body, in statics and where a prestress is asked for: held
/// components and, without a prestress, springs must resist every translation and rotation that the geometry allows. To
/// be called by all processes.
/// \throws InputError that names a motion that nothing resists
template <int n>
void require_no_rigid_motion(const Case& setup, const Scene<n>& scene);

}  // namespace fsi
