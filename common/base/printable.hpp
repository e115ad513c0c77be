#pragma once

#include <cstddef>
#include <string>

namespace fsi {

/// Text that can be shown on a terminal in one line: control characters, bytes that are no UTF-8, and characters that
/// show nothing or change the direction of writing are replaced by escapes (\n, \x1b, \u202e). Idempotent: what is
/// printable stays as it is, backslashes too.
std::string printable(const std::string& text);

/// Printable text of at most `limit` characters: the middle of a longer one is replaced by "...".
std::string shortened(const std::string& text, std::size_t limit);

/// The same for a path, whose end tells more than its beginning: the beginning is replaced.
std::string shortened_path(const std::string& path, std::size_t limit);

}  // namespace fsi
