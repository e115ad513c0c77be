#pragma once

#include <toml++/toml.h>

#include "case/case_entry.hpp"

namespace fsi {

/// Turns the lists of a case, [[opening]] and [[support]], into sections by the name of the surface that each entry is
/// for: what follows reads, checks, overrides and names `opening.outlet.pressure` as any other key. The key `surface` is
/// taken out. [[structure.region]] likewise, by its `name`, its place in the list being kept as `order`. A case that already says [opening.outlet] is left as it is.
/// \throws InputError for an entry without a surface, and for two of one surface
void name_lists_by_surface(toml::table& document, const CaseSource& source);

}  // namespace fsi
