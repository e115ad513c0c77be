#pragma once

#include <memory>
#include <string>

#include "case/case.hpp"
#include "partitioned/coupling_scheme.hpp"
#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// \throws InputError for a name that is not in the table
const CouplingScheme& coupling_scheme(const std::string& name);

/// The stepper of the coupling scheme that a case names, or that is chosen for it (chosen_scheme()), for a scene with
/// fluid and wall. Adds to the scene's notices. Collective.
/// \throws InputError where the scheme cannot serve the case
template <int n>
std::unique_ptr<Stepper> make_coupling_stepper(Scene<n>& scene, const Loads& loads, const Case& setup);

}  // namespace fsi
