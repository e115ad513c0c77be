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
  /// Loads the whole file. Throws when it is missing, a folder, unreadable or too large for the memory.
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
  /// A number of things that each need `bytes_each` more bytes of binary data or more; compared with what is left.
  std::int64_t count(const char* what, std::size_t bytes_each);
  /// The same, written as a line of text whether the file is binary or not.
  std::int64_t text_count(const char* what, std::size_t bytes_each);
  /// An 8-byte real, of 1e30 at most.
  double real(const char* what);

  // Whether the file is binary or not:
  std::string word();                             ///< text up to the next blank
  std::int32_t text_integer(const char* what);    ///< as text
  std::string quoted(const char* what);           ///< text in double quotes, on one line
  void end_line();                                ///< expects nothing but blanks up to the next line
  std::int32_t binary_integer(const char* what);  ///< 4 bytes

  /// Throws InputError about the current section.
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
