#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fsi {

/// A CSV file that grows row by row. Numbers are printed with the fewest digits that read back to the same double.
class CsvFile {
 public:
  /// Creates the file with its header, or, with `append`, continues one that has it already.
  /// \throws InputError when the file cannot be written
  CsvFile(std::filesystem::path file, const std::string& header, bool append = false);

  /// One row per entry, as long as the header; handed to the operating system before it returns. \throws InputError
  /// when the disk is full
  void write(const std::vector<std::vector<double>>& rows);
  void write(const std::vector<double>& row) { write(std::vector<std::vector<double>>{row}); }

 private:
  std::filesystem::path file_;
  std::size_t columns_;
  std::ofstream stream_;
};

}  // namespace fsi
