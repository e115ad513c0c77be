#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace fsi {

/// Parts of a dotted key, at most: a case needs five (structure.layers.NAME.CONSTANT.file).
inline constexpr std::size_t deepest_key = 16;

/// The line of TOML text, counted from 1, where a key has more parts than deepest_key; empty if no key has. The parser
/// bounds the nesting of arrays and inline tables, not the parts of a key. Each part is a table in a table, and
/// destroying a hundred thousand of them overflows the stack.
std::optional<std::size_t> line_of_deep_key(const std::string& text);

}  // namespace fsi
