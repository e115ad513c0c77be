#include "io/csv_file.hpp"

#include <fmt/format.h>

#include <cassert>
#include <iterator>

#include "base/error.hpp"

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

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, const std::string& header, bool append)
    : columns_(split(header).size()), file_(append ? CheckedFile::append(file) : CheckedFile::create(file)) {
  if (!append) file_.write(header + '\n');
}

void CsvFile::write(const std::vector<std::vector<double>>& rows) {
  write(rows, {});
}

void CsvFile::write(const std::vector<std::vector<double>>& rows, const std::vector<std::string>& names) {
  assert(names.empty() || names.size() == rows.size());
  fmt::memory_buffer text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto& row = rows[r];
    assert(row.size() + (names.empty() ? 0 : 1) == columns_);
    for (std::size_t i = 0; i < row.size(); ++i) {
      fmt::format_to(std::back_inserter(text), i > 0 ? ",{}" : "{}", row[i]);
      if (i == 0 && !names.empty()) fmt::format_to(std::back_inserter(text), ",{}", names[r]);
    }
    text.push_back('\n');
  }
  write_text({text.data(), text.size()});
}

void CsvFile::write_text(const std::string& rows) {
  file_.require_undisturbed();
  const auto whole_rows = file_.size();
  try {
    file_.write(rows);
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

}  // namespace fsi
