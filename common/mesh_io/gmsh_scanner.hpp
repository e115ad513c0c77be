#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Reads numbers from the bytes of a .msh file, as text or binary, never past their end. Everything unexpected throws
/// InputError with the section as key and the line (text) or byte offset (binary).
class GmshScanner {
 public:
  /// Loads the whole file. Throws when it is missing, a folder or unreadable.
  explicit GmshScanner(const std::filesystem::path& path);

  /// Whether the file begins with this text.
  bool begins_with(const std::string& text) const { return data_.compare(0, text.size(), text) == 0; }

  /// Advances to the next `$Name` line and returns "Name", or "" at the end of the file.
  std::string begin_section();
  /// Expects the `$EndName` line of the section begun last.
  void end_section();
  /// Passes over the rest of the section begun last, to behind its `$EndName` line.
  void skip_section();

  /// From now on integers and reals are read as binary data of this machine's byte order.
  void set_binary(bool binary) { binary_ = binary; }
  bool is_binary() const { return binary_; }

  /// A 4-byte integer (an `int` of the format).
  std::int32_t integer(const char* what);
  /// An 8-byte unsigned number (a `size_t` of the format); must fit 63 bits.
  std::int64_t tag(const char* what);
  /// A number of things that each need at least `bytes_each` more bytes of binary data; held against what is left.
  std::int64_t count(const char* what, std::size_t bytes_each);
  /// The same, written as a line of text whether the file is binary or not.
  std::int64_t text_count(const char* what, std::size_t bytes_each);
  /// An 8-byte real, finite.
  double real(const char* what);

  /// Text tokens, whether the file is binary or not.
  std::string word();
  std::int32_t text_integer(const char* what);
  std::string quoted(const char* what);
  /// The bytes behind the current line, for the binary marker of byte order.
  void end_line();
  std::int32_t binary_integer(const char* what);

  /// Throws InputError about the section read now.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = default_remedy) const;

  static constexpr const char* default_remedy = "the file is truncated or damaged; write it again with gmsh";

 private:
  template <class T>
  T raw(const char* what);
  template <class T>
  T text(const char* what);
  std::int64_t checked_count(std::int64_t value, const char* what, std::size_t bytes_each) const;
  void skip_space();
  std::string place() const;

  std::string file_, data_, section_;
  std::size_t position_ = 0;
  bool binary_ = false;
};

}  // namespace fsi
