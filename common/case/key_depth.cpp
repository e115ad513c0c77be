#include "case/key_depth.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace fsi {

namespace {

/// The place of the last byte of the string that begins at `begin`; the text's size if it has no end, which the parser
/// will refuse.
std::size_t end_of_string(const std::string& text, std::size_t begin) {
  const char mark = text[begin];
  const bool of_lines = text.compare(begin, 3, std::string(3, mark)) == 0;
  const std::string end(of_lines ? 3 : 1, mark);
  for (std::size_t i = begin + end.size(); i < text.size(); ++i) {
    if (text.compare(i, end.size(), end) == 0) return i + end.size() - 1;
    if (text[i] == '\n' && !of_lines) return i;
    if (text[i] == '\\' && mark == '"') ++i;
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_of_deep_key(const std::string& text) {
  std::size_t dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);  // part of a key, perhaps; dots in it count for nothing
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      dots = 0;
    } else if (c == '.') {
      if (++dots >= deepest_key)
        return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
    } else if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::strchr("_- \t", c) == nullptr) {
      dots = 0;
    }
  }
  return {};
}

}  // namespace fsi
