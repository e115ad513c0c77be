#pragma once

#include <filesystem>
#include <string>

#include "io/checked_file.hpp"

namespace fsi {

/// A CSV file that grows row by row.
class CsvFile {
 public:
  /// Creates the file with its header, or, with `append`, continues one that has it.
  /// \throws WriteError when the file cannot be written
  CsvFile(const std::filesystem::path& file, const std::string& header, bool append = false);

  /// Writes whole rows with their newlines; they are in the system's hands when it returns.
  /// \throws WriteError when the disk is full, or when something else has deleted or changed the file; no part of the
  ///         rows stays if the file can be cut
  void write(const std::string& rows);

  /// Puts the file on disk and closes it. \throws WriteError
  void close();

 private:
  CheckedFile file_;
};

}  // namespace fsi
