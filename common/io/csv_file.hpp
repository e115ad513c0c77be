#pragma once

#include <filesystem>
#include <string>

#include "io/checked_file.hpp"

namespace fsi {

/// A CSV file that grows row by row.
class CsvFile {
 public:
  /// Creates the file with its header, or, with `append`, continues one that has it already.
  /// \throws WriteError when the file cannot be written
  CsvFile(const std::filesystem::path& file, const std::string& header, bool append = false);

  /// Whole rows, newlines and all; handed to the operating system before it returns. \throws WriteError when the disk is
  /// full, or when the file has been deleted or changed by somebody else; no part of a row stays then, if the file can be
  /// cut
  void write(const std::string& rows);

  /// Onto the disk, and closes. \throws WriteError
  void close();

 private:
  CheckedFile file_;
};

}  // namespace fsi
