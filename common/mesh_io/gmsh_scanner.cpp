#include "mesh_io/gmsh_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <type_traits>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "host/available_memory.hpp"
#include "mesh_io/gmsh_header.hpp"

namespace fsi {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// Text for a message: short, and without bytes that upset a terminal.
std::string excerpt(std::string text) {
  constexpr std::size_t longest = 32;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

/// Whether what was read so far, the last piece from `begin` on, may be a .msh file: its header, and no zero bytes in
/// text. Reading need not go on to find that it is not.
bool may_be_gmsh(const std::string& data, std::size_t begin) {
  int binary = 0;
  if (std::sscanf(data.substr(0, 64).c_str(), "$MeshFormat %*s %d", &binary) != 1) return false;
  return binary != 0 || data.find('\0', begin) == std::string::npos;
}

std::string load(const std::filesystem::path& path) {
  require_regular_file(
      path, {"there is no such mesh file", "check the path, or make one: fsi-mesh artery --level coarse -o FILE.msh",
             "give the path of a gmsh .msh file"});
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const auto size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) throw InputError(path.string(), "", "cannot be read", "check its permissions");
  check_gmsh_header(path, static_cast<double>(available_memory().bytes));
  std::string data;
  data.reserve(static_cast<std::size_t>(size));
  stream.seekg(0);
  // In pieces, so that little is read of a large file that is not what it seems.
  for (bool goes_on = true; goes_on && data.size() < static_cast<std::size_t>(size);) {
    const std::size_t before = data.size();
    data.resize(std::min(static_cast<std::size_t>(size), before + large_gmsh_file));
    stream.read(data.data() + before, static_cast<std::streamsize>(data.size() - before));
    if (!stream) throw InputError(path.string(), "", "cannot be read to its end", "check the disk");
    goes_on = may_be_gmsh(data, before);
  }
  return data;
}

}  // namespace

GmshScanner::GmshScanner(const std::filesystem::path& path) : file_(path.string()), data_(load(path)) {}

std::string GmshScanner::begin_section() {
  skip_space();
  if (position_ == data_.size()) return {};
  const std::size_t begin = position_;
  const std::string name = word();
  if (name.size() < 2 || name[0] != '$' || name.compare(0, 4, "$End") == 0) {
    position_ = begin;
    fail(fmt::format("expected the begin of a section at {}, found '{}'", place(), excerpt(name)));
  }
  section_ = name;
  end_line();
  return name.substr(1);
}

void GmshScanner::end_section() {
  skip_space();
  const std::string expected = "$End" + section_.substr(1);
  if (data_.compare(position_, expected.size(), expected) == 0) {
    position_ += expected.size();
    if (position_ == data_.size() || is_space(data_[position_])) return;
    position_ -= expected.size();
  }
  const std::string at = place();
  fail(position_ == data_.size()
           ? fmt::format("the file ends before {}", expected)
           : fmt::format("expected {} at {}, found '{}'", expected, at, excerpt(data_.substr(position_, 24))));
}

void GmshScanner::skip_section() {
  const std::string expected = "\n$End" + section_.substr(1);
  const std::size_t from = position_ > 0 ? position_ - 1 : 0;
  const std::size_t found = data_.find(expected, from);
  if (found == std::string::npos) fail(fmt::format("the file ends before {}", expected.substr(1)));
  position_ = found + expected.size();
}

std::int32_t GmshScanner::integer(const char* what) {
  return binary_ ? raw<std::int32_t>(what) : text<std::int32_t>(what);
}

std::int64_t GmshScanner::tag(const char* what) {
  const auto value = binary_ ? raw<std::int64_t>(what) : text<std::int64_t>(what);
  if (value < 0) fail(fmt::format("{} out of range at {}", what, place()));
  return value;
}

std::int64_t GmshScanner::count(const char* what, std::size_t bytes_each) {
  return checked_count(tag(what), what, bytes_each);
}

std::int64_t GmshScanner::text_count(const char* what, std::size_t bytes_each) {
  const auto value = text<std::int64_t>(what);
  end_line();
  return checked_count(value, what, bytes_each);
}

double GmshScanner::real(const char* what) {
  const double value = binary_ ? raw<double>(what) : text<double>(what);
  // Volumes are cubes of lengths, and their squares have to be numbers, too.
  constexpr double largest = 1e30;
  if (!(std::abs(value) <= largest))
    fail(fmt::format("{} is {} at {}", what, value, place()), fmt::format("give coordinates up to {:g} mm", largest));
  return value;
}

std::string GmshScanner::word() {
  skip_space();
  const std::size_t begin = position_;
  while (position_ < data_.size() && !is_space(data_[position_])) ++position_;
  return data_.substr(begin, position_ - begin);
}

std::int32_t GmshScanner::text_integer(const char* what) {
  return text<std::int32_t>(what);
}

std::string GmshScanner::quoted(const char* what) {
  skip_space();
  const std::size_t end =
      position_ < data_.size() && data_[position_] == '"' ? data_.find('"', position_ + 1) : std::string::npos;
  if (end == std::string::npos) fail(fmt::format("expected a {} in quotes at {}", what, place()));
  std::string text = data_.substr(position_ + 1, end - position_ - 1);
  if (text.find('\n') != std::string::npos)
    fail(fmt::format("expected a closing quote behind the {} at {}", what, place()));
  position_ = end + 1;
  return text;
}

void GmshScanner::end_line() {
  const std::size_t end = data_.find('\n', position_);
  const std::size_t stop = end == std::string::npos ? data_.size() : end;
  if (!std::all_of(data_.begin() + static_cast<long>(position_), data_.begin() + static_cast<long>(stop), is_space))
    fail(fmt::format("expected the end of the line at {}, found '{}'", place(),
                     excerpt(data_.substr(position_, std::min<std::size_t>(stop - position_, 40)))));
  position_ = std::min(stop + 1, data_.size());
}

std::int32_t GmshScanner::binary_integer(const char* what) {
  return raw<std::int32_t>(what);
}

void GmshScanner::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, section_, problem, remedy);
}

template <class T>
T GmshScanner::raw(const char* what) {
  if (data_.size() - position_ < sizeof(T)) fail(fmt::format("the file ends where a {} should stand", what));
  T value;
  std::memcpy(&value, data_.data() + position_, sizeof(T));
  position_ += sizeof(T);
  return value;
}

template <class T>
T GmshScanner::text(const char* what) {
  skip_space();
  if (position_ == data_.size()) fail(fmt::format("the file ends where a {} should stand", what));
  T value{};
  const char* const begin = data_.data() + position_;
  const char* const end = data_.data() + data_.size();
  auto [stop, failure] = std::from_chars(begin, end, value);
  if constexpr (std::is_floating_point_v<T>)
    if (failure == std::errc::result_out_of_range) {
      value = std::strtod(std::string(begin, stop).c_str(), nullptr);  // tiny becomes zero, huge becomes infinite
      failure = std::errc();
    }
  if (failure != std::errc() || (stop != end && !is_space(*stop))) {
    const std::string at = place();
    fail(fmt::format("expected a {} at {}, found '{}'", what, at, excerpt(word())));
  }
  position_ += static_cast<std::size_t>(stop - begin);
  return value;
}

std::int64_t GmshScanner::checked_count(std::int64_t value, const char* what, std::size_t bytes_each) const {
  // In text every number takes at least a digit and a blank; the thinnest binary number takes four bytes.
  const std::size_t least = binary_ ? bytes_each : std::max<std::size_t>(1, bytes_each / 4);
  const std::size_t left = data_.size() - position_;
  if (value < 0 || static_cast<std::uint64_t>(value) > left / std::max<std::size_t>(1, least))
    fail(fmt::format("the {} is {} at {}, but only {} bytes are left", what, value, place(), left));
  return value;
}

void GmshScanner::skip_space() {
  while (position_ < data_.size() && is_space(data_[position_])) ++position_;
}

std::string GmshScanner::place() const {
  if (binary_) return fmt::format("byte {}", position_);
  const auto here = data_.begin() + static_cast<long>(position_);
  return fmt::format("line {}", 1 + std::count(data_.begin(), here, '\n'));
}

}  // namespace fsi
