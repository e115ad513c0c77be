#include "io/table_digest.hpp"

#include <algorithm>
#include <fstream>

#include "base/error.hpp"

namespace fsi {

void TableDigest::take(std::uint64_t most) {
  std::ifstream stream(file_, std::ios::binary);
  stream.seekg(0, std::ios::end);
  const auto end = stream.tellg();
  if (!stream || end < 0 || static_cast<std::uint64_t>(end) < bytes_)
    throw InputError(file_.string(), "", "cannot be read again", "was it changed or removed during the run?");
  stream.seekg(static_cast<std::streamoff>(bytes_));
  std::vector<char> piece(1 << 16);
  while (bytes_ < most && stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(piece.size(), most - bytes_)));
    hash_.add(piece.data(), static_cast<std::size_t>(stream.gcount()));
    bytes_ += static_cast<std::uint64_t>(stream.gcount());
  }
}

std::vector<double> TableDigest::numbers() const {
  const std::uint64_t value = hash_.value();
  return {static_cast<double>(bytes_), static_cast<double>(value >> 32), static_cast<double>(value & 0xffffffffu)};
}

}  // namespace fsi
