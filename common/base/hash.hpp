#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace fsi {

/// FNV-1a with 64 bits (Fowler, Noll, Vo): detects accidents, not forgery. Bytes may be added in pieces.
class Fnv1a {
 public:
  void add(const void* bytes, std::size_t size);
  void add(const std::string& text) { add(text.data(), text.size()); }
  std::uint64_t value() const { return value_; }
  std::string hex() const;  ///< 16 hexadecimal digits

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

/// Hash of a file's bytes, 16 hexadecimal digits. \throws InputError when the file cannot be read
std::string hash_of_file(const std::filesystem::path& file);

}  // namespace fsi
