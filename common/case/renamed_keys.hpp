#pragma once

#include <toml++/toml.h>

#include "case/case_entry.hpp"

namespace fsi {

/// Gives keys with names of earlier versions their present ones, with a remark for the log: what follows knows only those.
/// Messages about such an entry name it as the case does. What --set gives stands above what the file gives under the other
/// name.
/// \throws InputError where the file, or --set, gives a key under both names
void rename_keys(toml::table& document, CaseSource& source);

/// The names of earlier versions that a section has, so that a misspelt one is told which is meant.
std::vector<std::string> former_names(const std::string& section);

}  // namespace fsi
