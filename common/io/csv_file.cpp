#include "io/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "io/atomic_file.hpp"

namespace fsi {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// Whether a row is whole, and its time not later than `time`.
bool kept(const std::string& row, std::size_t columns, std::size_t time_column, double time) {
  const auto cells = split(row);
  if (cells.size() != columns) return false;
  const std::string& cell = cells[time_column];
  char* end = nullptr;
  const double row_time = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0') return false;
  return row_time <= time + 1e-9 * std::abs(time);  // times are step * dt, rounded differently here and there
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, const std::string& header, bool append)
    : columns_(split(header).size()), file_(append ? CheckedFile::append(file) : CheckedFile::create(file)) {
  if (!append) file_.write(header + '\n');
}

void CsvFile::write(const std::vector<std::vector<double>>& rows) {
  fmt::memory_buffer text;
  for (const auto& row : rows) {
    assert(row.size() == columns_);
    for (std::size_t i = 0; i < row.size(); ++i) fmt::format_to(std::back_inserter(text), i > 0 ? ",{}" : "{}", row[i]);
    text.push_back('\n');
  }
  file_.require_undisturbed();
  const auto whole_rows = file_.size();
  try {
    file_.write({text.data(), text.size()});
  } catch (...) {
    file_.cut_to(whole_rows);
    throw;
  }
}

void CsvFile::close() {
  file_.require_undisturbed();
  file_.synchronise();
  file_.close();
}

void copy_csv_until(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& header,
                    double time) {
  std::ifstream stream(from, std::ios::binary);
  if (!stream)
    throw InputError(from.string(), "", "cannot be read", "restart from a result folder that holds all its tables");
  std::string text, line;
  std::getline(stream, line);
  if (line != header)
    throw InputError(from.string(), "", "its first line is '" + line.substr(0, 80) + "'",
                     "restart from a run whose table begins with '" + header + "'");
  text = header + "\n";
  const auto columns = split(header);
  const auto time_column = std::find(columns.begin(), columns.end(), "time_ms") - columns.begin();
  assert(static_cast<std::size_t>(time_column) < columns.size());
  while (std::getline(stream, line)) {
    if (stream.eof()) break;  // no newline at its end: torn off by a kill
    if (kept(line, columns.size(), static_cast<std::size_t>(time_column), time)) text += line + "\n";
  }
  write_atomically(to, text);
}

}  // namespace fsi
