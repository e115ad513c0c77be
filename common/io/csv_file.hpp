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

/// Copies the header of `from` and its rows with `time_ms` <= time to `to`, by a temporary file and rename; both may be
/// the same file. A torn last row (killed run) is dropped. `header` names a column `time_ms`.
/// \throws InputError when `from` cannot be read or has another header than `header`
void copy_csv_until(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& header,
                    double time);

}  // namespace fsi
