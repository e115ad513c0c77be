#pragma once

#include <toml++/toml.h>

#include "case/case_entry.hpp"

namespace fsi {

/// Turns the lists [[opening]], [[support]], [[network.element]] and [[structure.region]] into sections, so that
/// `opening.outlet.pressure` is a key like any other. A section is named by the entry's key `surface`, or `name`, which
/// is taken out. An entry of [[structure.region]] without `order` gets its place in the list, from 1. Sections such as
/// [opening.outlet] stay as they are.
/// \throws InputError for an entry without a name, and for two of one name
void name_lists(toml::table& document, const CaseSource& source);

}  // namespace fsi
