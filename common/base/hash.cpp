#include "base/hash.hpp"

#include <fmt/format.h>

namespace fsi {

void Fnv1a::add(const void* bytes, std::size_t size) {
  constexpr std::uint64_t prime = 1099511628211ull;
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * prime;
}

std::string Fnv1a::hex() const {
  return fmt::format("{:016x}", value_);
}

}  // namespace fsi
