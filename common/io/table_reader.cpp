#include "io/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace fsi {

namespace {

constexpr std::size_t longest_line = 4096;  // bytes; the longest row of numbers has 500
constexpr const char* remedy = "restart from a folder whose tables are whole, or run from the start";

}  // namespace

TableReader::TableReader(std::filesystem::path file, const std::string& header, bool named)
    : file_(std::move(file)), named_(named) {
  std::error_code error;
  if (!std::filesystem::exists(file_, error)) refuse("missing");
  if (!std::filesystem::is_regular_file(file_, error)) refuse("is no file");
  stream_.open(file_, std::ios::binary);
  if (!stream_) refuse("cannot be read");
  text_.resize(longest_line);
  columns_ = 1 + static_cast<std::size_t>(std::count(header.begin(), header.end(), ','));
  if (!read_line()) text_.clear();
  if (text_ != header)
    throw InputError(file_.string(), "", "its first line is not that of this run's table",
                     "restart from a run whose table begins with '" + header + "'");
}

bool TableReader::read_line() {
  text_.resize(longest_line);
  stream_.getline(text_.data(), static_cast<std::streamsize>(text_.size()));
  const auto read = static_cast<std::size_t>(stream_.gcount());
  if (stream_.bad()) refuse("cannot be read");
  if (stream_.eof()) return false;
  ++line_;
  if (stream_.fail()) refuse_line("has no end");
  bytes_ += read;
  text_.resize(read - 1);  // the newline counts
  return true;
}

TableReader::Found TableReader::next() {
  if (!read_line()) return Found::end;
  row_.clear();
  const char *at = text_.data(), *const end = at + text_.size();
  while (true) {
    if (named_ && row_.size() == 1) {
      const char* const behind = std::find(at, end, ',');
      if (behind == end) return Found::no_row;
      name_.assign(at, behind);
      at = behind + 1;
    }
    double number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc() && error != std::errc::result_out_of_range) return Found::no_row;
    row_.push_back(error == std::errc() ? number : HUGE_VAL);  // beyond all numbers: not finite
    if (stop == end) break;
    if (*stop != ',') return Found::no_row;
    at = stop + 1;
  }
  return row_.size() + (named_ ? 1 : 0) == columns_ ? Found::row : Found::no_row;
}

void TableReader::refuse_line(const std::string& problem) const {
  throw InputError(file_.string(), fmt::format("line {}", line_), problem, remedy);
}

void TableReader::refuse(const std::string& problem) const {
  throw InputError(file_.string(), "", problem, remedy);
}

}  // namespace fsi
