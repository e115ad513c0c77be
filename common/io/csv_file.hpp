#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/checked_file.hpp"

namespace fsi {

/// A CSV file that grows row by row. Numbers are printed with the fewest digits that read back to the same double.
class CsvFile {
 public:
  /// Creates the file with its header, or, with `append`, continues one that has it already.
  /// \throws WriteError when the file cannot be written
  CsvFile(const std::filesystem::path& file, const std::string& header, bool append = false);

  /// One row per entry, as long as the header; handed to the operating system before it returns. \throws WriteError
  /// when the disk is full, or when the file has been deleted or changed by somebody else; no part of a row stays then,
  /// if the file can be cut
  void write(const std::vector<std::vector<double>>& rows);
  /// The same for rows that are text already, newlines and all.
  void write_text(const std::string& rows);
  void write(const std::vector<double>& row) { write(std::vector<std::vector<double>>{row}); }
  /// The same with a name behind the first number of each row.
  /// \param names  one per row, without commas, quotes and line ends
  void write(const std::vector<std::vector<double>>& rows, const std::vector<std::string>& names);

  /// Onto the disk, and closes. \throws WriteError
  void close();

 private:
  std::size_t columns_;
  CheckedFile file_;
};

}  // namespace fsi
