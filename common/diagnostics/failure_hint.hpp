#pragma once

#include <string>

#include "case/case.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What the last finished levels tell about the step that failed after them: a wall that yields to more load than it
/// can bear at rest, or mesh elements of the fluid that have lost most of their volume. Empty: nothing of the kind.
/// Processes that share the scene call it together and get the same text.
template <int n>
std::string failure_hint(const Case& setup, const Scene<n>& scene, const Loads& loads, const State& state);

}  // namespace fsi
