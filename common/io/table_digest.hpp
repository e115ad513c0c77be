#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/hash.hpp"

namespace fsi {

/// The bytes of a growing table and their hash (FNV-1a 64): a checkpoint keeps them, so that a restart knows the rows
/// that were written up to it from all others.
class TableDigest {
 public:
  explicit TableDigest(std::filesystem::path file) : file_(std::move(file)) {}

  /// Takes in what the file has got since the last time, or up to `most` bytes of the whole. \throws InputError when it
  /// cannot be read, or is shorter than it was
  void take(std::uint64_t most = UINT64_MAX);

  std::uint64_t bytes() const { return bytes_; }
  /// Bytes, and upper and lower half of the hash, for the arrays of a checkpoint.
  std::vector<double> numbers() const;

 private:
  std::filesystem::path file_;
  std::uint64_t bytes_ = 0;
  Fnv1a hash_;
};

/// numbers() of tables by file name.
using TableDigests = std::map<std::string, std::vector<double>>;

}  // namespace fsi
