#pragma once

#include <toml++/toml.h>

#include "case/case_entry.hpp"

namespace fsi {

/// Gives keys with names of earlier versions their present names, with a remark for the log. Messages about such an
/// entry name it as the case does. --set takes precedence over what the file gives under the other name.
/// \throws InputError where the file, or --set, gives a key under both names
void rename_keys(toml::table& document, CaseSource& source);

/// The names that keys of a section had in earlier versions, for messages about misspelt ones.
std::vector<std::string> former_names(const std::string& section);

}  // namespace fsi
