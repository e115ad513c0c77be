#pragma once

#include "case/case.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Refuses a wall with supports that is static, or whose unloaded shape is asked for, and could move as a rigid body: held
/// components, and in statics springs, must resist every translation and rotation that its geometry allows. \throws InputError that names one that nothing resists
template <int n>
void require_no_rigid_motion(const Case& setup, const Scene<n>& scene);

}  // namespace fsi
