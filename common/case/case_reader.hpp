#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace fsi {

/// Reads a case file (TOML) and checks everything in it that can be checked without the mesh.
/// \param file       path of the case file; paths inside it are relative to its folder
/// \param overrides  `key=value`, applied over the file's entries in this order. A value that is not TOML counts as a
///                   bare string. `mesh.file` is relative to the working directory if it exists there, else to the case
///                   file; it replaces `mesh.level` and `mesh.error`, and the other way round.
/// \throws InputError with file and line (or `--set`), key path, offending value and remedy: syntax errors, unknown or
///         misspelt keys (with the nearest valid one), wrong types, missing or unphysical values, contradictory
///         sections
/// \return the case; its `warnings` hold what seems wrong, mostly units: each with file and line, key, value and the
///         value that was probably meant
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// As read_case, from the text of a case file; `file` only names it in messages and anchors relative paths.
Case parse_case(const std::string& text, const std::filesystem::path& file,
                const std::vector<std::string>& overrides = {});

/// All keys of a case file with their meaning, one per line, for `--help-keys`.
std::string case_keys_help();

}  // namespace fsi
