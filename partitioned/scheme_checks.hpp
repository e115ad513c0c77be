#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "partitioned/schemes.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Options of [partitioned] that a case gives and its scheme has no use for: a notice for each.
void note_foreign_options(const std::string& scheme, const Case& setup, std::vector<std::string>& notices);

/// Whether a coupling scheme serves a case; what it will be slow or fail at goes to the scene's notices.
/// \param order  of the extrapolated start of a step
/// \throws InputError where it cannot serve
template <int n>
void check_scheme(const CouplingScheme& scheme, const Case& setup, int order, Scene<n>& scene);

}  // namespace fsi
