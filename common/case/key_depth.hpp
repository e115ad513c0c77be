#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace fsi {

/// Parts of a dotted key, at most: a case needs four.
inline constexpr std::size_t deepest_key = 16;

/// The line of TOML text, counted from 1, where a key has more parts than deepest_key; none if no key has. The parser
/// bounds how deep arrays and inline tables lie in each other, not how many parts a key has. Each part is a table in a
/// table, and taking down a hundred thousand of them overflows the stack.
std::optional<std::size_t> line_of_deep_key(const std::string& text);

}  // namespace fsi
