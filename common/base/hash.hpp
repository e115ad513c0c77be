#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace fsi
