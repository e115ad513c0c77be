#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "partitioned/coupling_scheme.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Options of [partitioned] that a case gives and its scheme has no use for: a notice for each.
void note_foreign_options(const CouplingScheme& scheme, const Case& setup, std::vector<std::string>& notices);

// What the schemes' classes ask of a case; the remedy stands in the message. What a scheme will be slow or fail at goes to the
// scene's notices.

/// One pass a step needs an extrapolated start. \param order  of it \throws InputError for 0
void require_moving_start(const CouplingScheme& scheme, const Case& setup, int order);
/// One pass a step needs a time scheme that forgives what it leaves. \throws InputError
template <int n>
void require_scheme_for_one_pass(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene);
/// \throws InputError about time.scheme
[[noreturn]] void refuse_time_scheme(const CouplingScheme& scheme, const Case& setup, const std::string& time_scheme,
                                     const char* why, const std::string& remedy);
/// Loosely coupled Robin-Robin schemes march in time, and take the wall for a tube. \throws InputError of static cases
template <int n>
void require_for_loose(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene);
/// Whether something sets the fluid's pressure where its velocity on the wall is given.
template <int n>
bool determines_pressure(const Scene<n>& scene);
/// Where the fluid is given its velocity on the wall, something else must set its pressure. \throws InputError
template <int n>
void require_determined_pressure(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene);
/// Robin-Neumann takes the wall for a tube, and is made for short steps.
template <int n>
void note_where_robin_neumann_is_slow(const CouplingScheme& scheme, const Case& setup, Scene<n>& scene);
/// Of a scheme that serves tubes around the fluid alone. \throws InputError where the wall stands in the fluid
template <int n>
void require_tube(const CouplingScheme& scheme, const Case& setup, const Scene<n>& scene);

}  // namespace fsi
