#pragma once

#include <memory>

#include "case/case.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// The stepper of the coupling scheme that a case names, or has without a name, for a scene with fluid and wall.
/// \throws InputError where the scheme cannot serve the case
template <int n>
std::unique_ptr<Stepper> make_coupling_stepper(Scene<n>& scene, const Loads& loads, const Case& setup);

}  // namespace fsi
