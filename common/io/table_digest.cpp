#include "io/table_digest.hpp"

#include <algorithm>
#include <fstream>

#include "base/error.hpp"

namespace fsi {

void TableDigest::take(std::uint64_t most) {
  std::ifstream stream(file_, std::ios::binary);
  stream.seekg(0, std::ios::end);
  const auto end = stream.tellg();
  if (!stream || end < 0 || static_cast<std::uint64_t>(end) < read_)
    throw InputError(file_.string(), "", "cannot be read again", "was it changed or removed during the run?");
  stream.seekg(static_cast<std::streamoff>(read_));
  std::vector<char> piece(1 << 16);
  while (read_ < most && stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(piece.size(), most - read_)));
    add(piece.data(), static_cast<std::size_t>(stream.gcount()));
    read_ += static_cast<std::uint64_t>(stream.gcount());
  }
}

void TableDigest::add(const char* bytes, std::size_t size) {
  if (!in_header_ && std::find(left_out_.begin(), left_out_.end(), true) == left_out_.end()) {
    hash_.add(bytes, size);
    counted_ += size;
    return;
  }
  for (const char* byte = bytes; byte != bytes + size; ++byte) {
    const bool ends_cell = *byte == ',' || *byte == '\n';
    if (in_header_) {
      if (ends_cell) {
        left_out_.push_back(name_.size() > 2 && name_.compare(name_.size() - 2, 2, "_s") == 0);
        name_.clear();
      } else {
        name_ += *byte;
      }
    }
    if (ends_cell || column_ >= left_out_.size() || !left_out_[column_] || in_header_) {
      hash_.add(byte, 1);
      ++counted_;
    }
    if (*byte == '\n') {
      in_header_ = false;
      column_ = 0;
    } else if (ends_cell) {
      ++column_;
    }
  }
}

std::vector<double> TableDigest::numbers() const {
  const std::uint64_t value = hash_.value();
  return {static_cast<double>(counted_), static_cast<double>(value >> 32), static_cast<double>(value & 0xffffffffu)};
}

}  // namespace fsi
