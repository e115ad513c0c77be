#pragma once

#include <toml++/toml.h>

#include "case/case_entry.hpp"

namespace fsi {

/// Turns the lists of a case, [[opening]], [[support]], [[network.element]] and [[structure.region]], into sections by the name
/// of the surface that each entry is for, or by its own: what follows reads, checks, overrides and names
/// `opening.outlet.pressure` as any other key. The key `surface`, or `name`, is taken out; the place in the list of
/// [[structure.region]] is kept as `order`. A case that already says [opening.outlet] is left as it is.
/// \throws InputError for an entry without a name, and for two of one name
void name_lists(toml::table& document, const CaseSource& source);

}  // namespace fsi
