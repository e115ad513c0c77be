#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"

namespace fsi {

/// A result file could not be written, because the disk is full, say. What was on disk before is still there; a run
/// that ends with this error can be continued from its last checkpoint.
/// The message reads `FILE: KEY: cannot be written (REASON); REMEDY`.
class WriteError : public InputError {
 public:
  /// \param number  errno of the call that failed; gives reason and remedy
  /// \param key     part of the file at fault, e.g. a dataset
  WriteError(std::filesystem::path file, int number, const std::string& key = "");
  WriteError(std::filesystem::path file, const std::string& key, const std::string& reason, const std::string& remedy);

  /// The same, its remedy followed by ", then WHAT".
  WriteError then(const std::string& what) const;

  const std::filesystem::path& file() const { return file_; }
  const std::string& key() const { return key_; }
  const std::string& reason() const { return reason_; }
  const std::string& remedy() const { return remedy_; }

 private:
  std::filesystem::path file_;
  std::string key_, reason_, remedy_;
};

}  // namespace fsi
