#include "io/earlier_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "io/atomic_file.hpp"
#include "io/checked_file.hpp"
#include "io/table_reader.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

using Found = TableReader::Found;

bool same(double a, double b, double scale) {
  return std::abs(a - b) <= time_rounding * scale;
}

/// Reads the table's next row, which must exist. \param step  the row's \param last  the checkpoint's
/// \param blanks  whether cells may be empty, which are read as NaN
void read_row(TableReader& table, std::int64_t step, std::int64_t last, bool blanks = false) {
  switch (table.next()) {
    case Found::end:
      table.refuse(fmt::format("ends before the rows of step {}, and the checkpoint is of step {}", step, last));
    case Found::no_row:
      table.refuse_line("is no row of this table");
    case Found::row:
      break;
  }
  for (const double number : table.row())
    if (!std::isfinite(number) && !(blanks && std::isnan(number)))
      table.refuse_line("holds a number that is not finite");
}

/// Requires that the rows behind those that are taken over are of later steps.
void check_rest(TableReader& table, std::size_t time_column, double time) {
  for (Found found = table.next(); found != Found::end; found = table.next())
    if (found == Found::row && !(table.row()[time_column] > time + time_rounding * std::abs(time)))
      table.refuse_line(fmt::format("is of the time {:g}, behind the rows up to {:g}: rows are doubled or out of order",
                                    table.row()[time_column], time));
}

/// Copies the beginning of a file by a temporary file and rename.
void copy_beginning(const fs::path& from, const fs::path& to, std::uint64_t bytes) {
  std::ifstream reader(from, std::ios::binary);
  std::string piece(1 << 16, '\0');
  try {
    auto writer = CheckedFile::create_new(temporary_name(to), to);
    while (bytes > 0) {
      reader.read(piece.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(piece.size(), bytes)));
      const auto read = static_cast<std::size_t>(reader.gcount());
      if (read == 0)
        throw InputError(from.string(), "", "cannot be read to its end", "check that no other run changes the folder");
      writer.write(std::string_view(piece).substr(0, read));
      bytes -= read;
    }
    writer.close();
    replace_by_temporary(to);
  } catch (...) {
    remove_temporary(to);
    throw;
  }
}

/// Number of columns that the names of rows and the places behind them fill.
std::size_t columns_of_names(const ResultTable& table) {
  if (table.names.empty()) return 0;
  return 1 + static_cast<std::size_t>(std::count(table.names[0].begin(), table.names[0].end(), ','));
}

}  // namespace

EarlierTables::EarlierTables(const fs::path& folder, const std::vector<ResultTable>& wanted, const EarlierSteps& steps)
    : folder_(folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string(), "", "is no folder", "give --restart the result folder of an earlier run");
  for (const ResultTable& table : wanted) {
    if (table.missing && !fs::exists(folder / table.file, error))
      throw InputError((folder / table.file).string(), table.missing->key, table.missing->problem,
                       table.missing->remedy);
    parts_.push_back(checked(table, steps));
  }
}

const std::vector<double>& EarlierTables::last_level(const std::string& file) const {
  static const std::vector<double> none;
  const auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.file == file; });
  return part == parts_.end() ? none : part->last_level;
}

void EarlierTables::copy_to(const fs::path& folder) const {
  for (const Part& part : parts_) copy_beginning(folder_ / part.file, folder / part.file, part.bytes);
}

EarlierTables::Part EarlierTables::checked(const ResultTable& table, const EarlierSteps& steps) {
  return with_digest(table.per == RowsPer::step          ? checked_steps(table, steps)
                     : table.per == RowsPer::within_step ? checked_within_steps(table, steps)
                                                         : checked_levels(table, steps),
                     steps);
}

EarlierTables::Part EarlierTables::with_digest(Part part, const EarlierSteps& steps) const {
  const auto known = steps.digests.find(part.file);
  if (known == steps.digests.end()) return part;
  TableDigest digest(folder_ / part.file);
  digest.take(part.bytes);
  if (digest.numbers() != known->second)
    throw InputError((folder_ / part.file).string(), "",
                     "its rows are not those that the run wrote up to its checkpoint",
                     "restart from a folder as its run has left it, or run from the start");
  return part;
}

EarlierTables::Part EarlierTables::checked_steps(const ResultTable& table, const EarlierSteps& steps) {
  TableReader reader(folder_ / table.file, table.header);
  const bool first = times_.empty();  // iterations.csv comes first; the others must say the same
  double before = 0;
  for (std::int64_t step = 1; step <= steps.step; ++step) {
    read_row(reader, step, steps.step);
    const double number = reader.row()[0], time = reader.row()[1];
    if (number != static_cast<double>(step))
      reader.refuse_line(
          fmt::format("is of step {:g}, not {}: rows are missing, doubled or out of order", number, step));
    if (!(time > before)) reader.refuse_line(fmt::format("ends at {:g}, the step before it at {:g}", time, before));
    before = time;
    if (first)
      times_.push_back(time);
    else if (!same(time, times_[static_cast<std::size_t>(step - 1)], time))
      reader.refuse_line(fmt::format("ends step {} at {:g}, iterations.csv at {:g}", step, time,
                                     times_[static_cast<std::size_t>(step - 1)]));
  }
  if (!same(before, steps.time, steps.time))
    reader.refuse(
        fmt::format("step {} ends at {:.12g} here and at {:.12g} in the checkpoint", steps.step, before, steps.time));
  Part part{table.file, reader.bytes()};
  check_rest(reader, 1, steps.time);
  return part;
}

EarlierTables::Part EarlierTables::checked_levels(const ResultTable& table, const EarlierSteps& steps) const {
  TableReader reader(folder_ / table.file, table.header, columns_of_names(table));
  const auto& z = table.places;
  const double length = z.empty() ? 0 : std::max(std::abs(z.front()), std::abs(z.back()));
  Part part{table.file};
  double time = 0;
  for (std::int64_t step = 1; step <= steps.levels; ++step) {
    time = times_[static_cast<std::size_t>(step - 1)];
    for (std::size_t i = 0; i < table.rows(); ++i) {
      read_row(reader, step, steps.step, table.blanks);
      const auto& row = reader.row();
      if (!same(row[0], time, time))
        reader.refuse_line(
            fmt::format("is of the time {:g}, not {:g}: rows are missing, doubled or out of order", row[0], time));
      if (!z.empty() && !same(row[1], z[i], length))
        reader.refuse_line(
            fmt::format("is of z = {:g} mm, not {:g}: rows are missing, doubled or out of order", row[1], z[i]));
      if (!table.names.empty() && reader.place() != table.names[i])
        reader.refuse_line(fmt::format(
            "is of '{}', not of '{}': the earlier run looked elsewhere, or rows are missing, doubled or out "
            "of order",
            printable(reader.place()), table.names[i]));
      if (step == steps.levels) part.last_level.insert(part.last_level.end(), row.begin() + 1, row.end());
    }
  }
  part.bytes = reader.bytes();
  check_rest(reader, 0, time);
  return part;
}

/// A row for each name and step, those of a step at one time within it.
EarlierTables::Part EarlierTables::checked_within_steps(const ResultTable& table, const EarlierSteps& steps) const {
  TableReader reader(folder_ / table.file, table.header, 1);
  double before = 0;
  for (std::int64_t step = 1; step <= steps.step; ++step) {
    const double end = times_[static_cast<std::size_t>(step - 1)];
    double time = 0;
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      read_row(reader, step, steps.step);
      const auto& row = reader.row();
      if (i == 0) time = row[0];
      if (row[0] != time || reader.place() != table.names[i] || !(time > before + time_rounding * before) ||
          !(time <= end + time_rounding * end))
        reader.refuse_line(
            fmt::format("is no row of \"{}\" in step {}, from {:g} to {:g}: rows are missing, doubled or out of order",
                        table.names[i], step, before, end));
    }
    before = end;
  }
  Part part{table.file, reader.bytes()};
  check_rest(reader, 0, before);
  return part;
}

}  // namespace fsi
