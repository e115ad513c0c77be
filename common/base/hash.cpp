#include "base/hash.hpp"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "base/error.hpp"

namespace fsi {

void Fnv1a::add(const void* bytes, std::size_t size) {
  constexpr std::uint64_t prime = 1099511628211ull;
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * prime;
}

std::string Fnv1a::hex() const {
  return fmt::format("{:016x}", value_);
}

std::string hash_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "", "cannot be read", "give the path of an existing file");
  Fnv1a hash;
  std::vector<char> block(1 << 16);
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return hash.hex();
}

}  // namespace fsi
