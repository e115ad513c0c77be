#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "partitioned/coupling_scheme.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Options of [partitioned] that a case gives and its scheme has no use for: a notice for each.
void note_foreign_options(const CouplingScheme& scheme, const Case& setup, std::vector<std::string>& notices);

// Checks of a case by the schemes' classes. What a scheme cannot do is an InputError with a remedy; what it does slowly
// or may fail at is added to the scene's notices. Functions that look at the wall's faces are collective: all processes
// call them together.

/// One pass a step needs an extrapolated start.
/// \param order  of the extrapolation
/// \throws InputError for order 0
void require_moving_start(const CouplingScheme& scheme, const Case& setup, int order);
/// One pass a step leaves a gap, which must not return in later steps.
/// \throws InputError where the time scheme does not damp it (TimeIntegrator::bears_one_pass())
template <int n>
void require_scheme_for_one_pass(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene);
/// \throws InputError about time.scheme
[[noreturn]] void refuse_time_scheme(const CouplingScheme& scheme, const Case& setup, const std::string& time_scheme,
                                     const char* why, const std::string& remedy);
/// Loosely coupled Robin-Robin schemes need time steps. Adds a notice where the wall is no tube, from which they take
/// their coefficient, and the case names none.
/// \throws InputError for static cases
template <int n>
void require_for_loose(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene);
/// Whether the fluid's pressure is determined where the fluid's velocity on the wall is prescribed.
template <int n>
bool determines_pressure(const Scene<n>& scene);
/// For schemes that prescribe the fluid's velocity on the wall.
/// \throws InputError where nothing else determines the fluid's pressure
template <int n>
void require_determined_pressure(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene);
/// Adds a notice where the wall is no tube around the fluid, from which Robin-Neumann takes its coefficient, or where
/// steps are long against the wall's response time.
template <int n>
void note_where_robin_neumann_is_slow(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene);
/// For schemes that serve walls around the fluid only. \throws InputError where the wall stands in the fluid
template <int n>
void require_tube(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene);

}  // namespace fsi
