#include "io/csv_file.hpp"

namespace fsi {

CsvFile::CsvFile(const std::filesystem::path& file, const std::string& header, bool append)
    : file_(append ? CheckedFile::append(file) : CheckedFile::create(file)) {
  if (!append) file_.write(header + '\n');
}

void CsvFile::write(const std::string& rows) {
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
