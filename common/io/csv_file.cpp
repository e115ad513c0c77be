#include "io/csv_file.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cstring>
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

CsvFile::CsvFile(std::filesystem::path file, const std::string& header, bool append)
    : file_(std::move(file)), columns_(split(header).size()), stream_(file_, append ? std::ios::app : std::ios::trunc) {
  if (!append) stream_ << header << '\n';
  stream_.flush();
  if (!stream_)
    throw InputError(file_.string(), "", std::string("cannot be written (") + std::strerror(errno) + ")",
                     "check the permissions and the free space of the folder");
}

void CsvFile::write(const std::vector<std::vector<double>>& rows) {
  fmt::memory_buffer text;
  for (const auto& row : rows) {
    assert(row.size() == columns_);
    for (std::size_t i = 0; i < row.size(); ++i) fmt::format_to(std::back_inserter(text), i > 0 ? ",{}" : "{}", row[i]);
    text.push_back('\n');
  }
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream_.flush();
  if (!stream_)
    throw InputError(file_.string(), "", std::string("cannot be written (") + std::strerror(errno) + ")",
                     "free some disk space, then continue with --restart");
}

}  // namespace fsi
