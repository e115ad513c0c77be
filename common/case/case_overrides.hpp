#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "case/case_entry.hpp"

namespace fsi {

/// Puts `key=value` entries in place of those in the document and notes them in the source. An entry that excludes
/// another one (mesh.file, mesh.level and mesh.error; a pressure table of [inlet] or [load] and `until`) replaces it.
/// \throws InputError for text that is no `key=value` or a key below something that is no section
void apply_overrides(const std::vector<std::string>& overrides, toml::table& document, CaseSource& source);

}  // namespace fsi
