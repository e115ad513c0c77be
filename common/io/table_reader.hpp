#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fsi {

/// Reads a CSV table of numbers, its second column perhaps names, row by row, in bounded memory whatever the file holds.
class TableReader {
 public:
  /// \throws InputError when the file is missing, no regular file, or begins with another line than `header`
  /// \param named  whether the second column holds names
  TableReader(std::filesystem::path file, const std::string& header, bool named = false);

  /// What stands at a place of the table.
  enum class Found {
    row,
    no_row,  ///< a line that is no row of numbers as many as the header has columns
    end      ///< the end of the file, or a line without newline: torn off by a kill
  };
  /// Goes on by a line.
  Found next();

  /// Of the last row found.
  const std::vector<double>& row() const { return row_; }
  /// The name in the last row found, which row() leaves out; empty where the table has none.
  const std::string& name() const { return name_; }
  /// Number of the last line read; the header's is 1.
  std::int64_t line() const { return line_; }
  /// Bytes from the beginning of the file up to the end of the last line read.
  std::uint64_t bytes() const { return bytes_; }
  const std::filesystem::path& file() const { return file_; }

  /// Refuses the table for its last line. \throws InputError
  [[noreturn]] void refuse_line(const std::string& problem) const;
  /// Refuses the whole of it. \throws InputError
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  /// Reads a whole line into text_; false at the end.
  bool read_line();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::string text_;
  std::vector<double> row_;
  std::string name_;
  bool named_;
  std::size_t columns_ = 0;
  std::int64_t line_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace fsi
