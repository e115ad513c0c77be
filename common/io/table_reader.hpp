#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fsi {

/// Reads a CSV table of numbers, perhaps with names from the second column on, row by row in bounded memory.
class TableReader {
 public:
  /// \param places  number of columns behind the first that are kept as text: names and places. With any, cells behind
  ///                 them may be empty
  /// \throws InputError when the file is missing, no regular file, or begins with another line than `header`
  TableReader(std::filesystem::path file, const std::string& header, std::size_t places = 0);

  /// What next() has read.
  enum class Found {
    row,
    no_row,  ///< a line that is no row of numbers as many as the header has columns
    end      ///< the end of the file, or a line without newline: torn off by a kill
  };
  /// Reads the next line.
  Found next();

  /// Numbers of the last row found, without the columns kept as text; empty cells are NaN.
  const std::vector<double>& row() const { return row_; }
  /// The columns kept as text, with the commas between them.
  const std::string& place() const { return place_; }
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
  std::string place_;
  std::size_t columns_ = 0, places_ = 0;
  std::int64_t line_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace fsi
