#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/hash.hpp"

namespace fsi {

/// The contents of a growing table as a count of bytes and their hash (FNV-1a 64). A checkpoint keeps it, so that a
/// restart recognises the rows written up to it. Cells of columns that end with `_s`, measured seconds, do not count,
/// since they differ from run to run.
class TableDigest {
 public:
  explicit TableDigest(std::filesystem::path file) : file_(std::move(file)) {}

  /// Adds what the file has gained since the last call, up to the first `most` bytes of the file.
  /// \throws InputError when it cannot be read, or is shorter than it was
  void take(std::uint64_t most = UINT64_MAX);

  /// Counted bytes, and upper and lower half of the hash, for the arrays of a checkpoint.
  std::vector<double> numbers() const;

 private:
  void add(const char* bytes, std::size_t size);

  std::filesystem::path file_;
  std::uint64_t read_ = 0, counted_ = 0;  ///< bytes
  Fnv1a hash_;
  std::string name_;            ///< of the header's current column
  std::vector<bool> left_out_;  ///< by column, once the header is read
  bool in_header_ = true;
  std::size_t column_ = 0;
};

/// numbers() of tables by file name.
using TableDigests = std::map<std::string, std::vector<double>>;

}  // namespace fsi
