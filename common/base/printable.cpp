#include "base/printable.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

namespace fsi {

namespace {

constexpr const char* gap = "...";
constexpr std::size_t gap_length = 3;

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: what stands there is no UTF-8
};

/// The character that begins at `at` (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF).
Character character_at(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || at + bytes > text.size()) return {};
  std::uint32_t code = first & (0x7fU >> bytes);
  for (std::size_t i = at + 1; i < at + bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (overlong || (code >= 0xd800 && code <= 0xdfff) || code > 0x10ffff) return {};
  return {code, bytes};
}

struct Range {
  std::uint32_t first, last;
};
/// Unicode's controls, formats, separators other than the space, private use, noncharacters, unassigned planes.
constexpr std::array<Range, 30> hidden = {
    {{0x0, 0x1f},        {0x7f, 0xa0},       {0xad, 0xad},       {0x600, 0x605},     {0x61c, 0x61c},
     {0x6dd, 0x6dd},     {0x70f, 0x70f},     {0x890, 0x891},     {0x8e2, 0x8e2},     {0x1680, 0x1680},
     {0x180e, 0x180e},   {0x2000, 0x200f},   {0x2028, 0x202f},   {0x205f, 0x206f},   {0x3000, 0x3000},
     {0xe000, 0xf8ff},   {0xfdd0, 0xfdef},   {0xfeff, 0xfeff},   {0xfff0, 0xfffb},   {0xfffe, 0xffff},
     {0x110bd, 0x110bd}, {0x110cd, 0x110cd}, {0x13430, 0x1343f}, {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a},
     {0x1fffe, 0x1ffff}, {0x2fffe, 0x2ffff}, {0x3fffe, 0xdffff}, {0xe0000, 0xeffff}, {0xf0000, 0x10ffff}}};

bool shows(std::uint32_t code) {
  for (const auto& range : hidden)
    if (code >= range.first && code <= range.last) return false;
  return true;
}

std::string escape_of(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  if (code < 0x80) return fmt::format("\\x{:02x}", code);
  return code < 0x10000 ? fmt::format("\\u{:04x}", code) : fmt::format("\\U{:08x}", code);
}

/// Byte offsets of the characters of printable text, and its end.
std::vector<std::size_t> starts_of(const std::string& text) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0U) != 0x80) starts.push_back(i);
  starts.push_back(text.size());
  return starts;
}

/// The first `head` and the last `tail` characters with the gap between them, if the text is longer than `limit`.
std::string cut(const std::string& text, std::size_t limit, std::size_t head, std::size_t tail) {
  std::string shown = printable(text);
  const auto starts = starts_of(shown);
  const std::size_t length = starts.size() - 1;
  if (length <= limit) return shown;
  return shown.substr(0, starts[head]) + gap + shown.substr(starts[length - tail]);
}

}  // namespace

std::string printable(const std::string& text) {
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    if (character.bytes == 0)
      fmt::format_to(std::back_inserter(shown), "\\x{:02x}", static_cast<unsigned char>(text[i]));
    else if (shows(character.code))
      shown.append(text, i, character.bytes);
    else
      shown += escape_of(character.code);
    i += character.bytes == 0 ? 1 : character.bytes;
  }
  return shown;
}

std::string shortened(const std::string& text, std::size_t limit) {
  const std::size_t left = limit > gap_length ? limit - gap_length : 0;
  return cut(text, limit, left - left / 2, left / 2);
}

std::string shortened_path(const std::string& path, std::size_t limit) {
  return cut(path, limit, 0, limit > gap_length ? limit - gap_length : 0);
}

}  // namespace fsi
