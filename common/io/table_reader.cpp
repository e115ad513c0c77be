#include "io/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace fsi {

namespace {

constexpr std::size_t longest_line = 4096;  // bytes; rows of numbers have 500 at most
constexpr const char* remedy = "restart from a folder whose tables are whole, or run from the start";

}  // namespace

TableReader::TableReader(std::filesystem::path file, const std::string& header, std::size_t places)
    : file_(std::move(file)), places_(places) {
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
  place_.clear();
  const char *at = text_.data(), *const end = at + text_.size();
  while (true) {
    if (places_ > 0 && row_.size() == 1) {
      const char* last = std::find(at, end, ',');
      for (std::size_t i = 1; i < places_ && last != end; ++i) last = std::find(last + 1, end, ',');
      if (last == end) return Found::no_row;
      place_.assign(at, last);
      at = last + 1;
    }
    const bool empty = places_ > 0 && !row_.empty() && (at == end || *at == ',');
    double number = std::numeric_limits<double>::quiet_NaN();
    const char* stop = at;
    if (!empty) {
      const auto read = std::from_chars(at, end, number);
      if (read.ec != std::errc() && read.ec != std::errc::result_out_of_range) return Found::no_row;
      stop = read.ptr;
      // Out of range: infinite. "nan" is infinite, too, since NaN stands for an empty cell.
      if (read.ec != std::errc() || (places_ > 0 && std::isnan(number))) number = HUGE_VAL;
    }
    row_.push_back(number);
    if (stop == end) break;
    if (*stop != ',') return Found::no_row;
    at = stop + 1;
  }
  return row_.size() + places_ == columns_ ? Found::row : Found::no_row;
}

void TableReader::refuse_line(const std::string& problem) const {
  throw InputError(file_.string(), fmt::format("line {}", line_), problem, remedy);
}

void TableReader::refuse(const std::string& problem) const {
  throw InputError(file_.string(), "", problem, remedy);
}

}  // namespace fsi
