#include "linear/amg/shared_rows.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace fsi {

namespace {

/// A row as numbers that can be sent: for each entry the column's number among all processes' ones, then its values.
void pack(const SparseRows& rows, int row, const ShareOfNumbers& columns, std::vector<double>& to) {
  for (int at = rows.offsets[row]; at < rows.offsets[row + 1]; ++at) {
    to.push_back(static_cast<double>(columns.number(rows.columns[at])));
    const auto from = rows.values.begin() + static_cast<std::ptrdiff_t>(at) * rows.width;
    to.insert(to.end(), from, from + rows.width);
  }
}

int place(std::int64_t number, const ShareOfNumbers& share) {
  if (number >= share.first && number < share.first + share.own) return static_cast<int>(number - share.first);
  const auto found = std::lower_bound(share.copies.begin(), share.copies.end(), number);
  assert(found != share.copies.end() && *found == number);
  return share.own + static_cast<int>(found - share.copies.begin());
}

/// Share with copies of what packed rows name, too.
void extend(ShareOfNumbers& share, const std::vector<const std::vector<double>*>& packed, int width) {
  std::vector<std::int64_t> copies = share.copies;
  for (const auto* row : packed)
    for (std::size_t at = 0; at < row->size(); at += static_cast<std::size_t>(width) + 1)
      if (const auto number = static_cast<std::int64_t>((*row)[at]);
          number < share.first || number >= share.first + share.own)
        copies.push_back(number);
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  share = ShareOfNumbers(*share.processes, share.own, std::move(copies));
}

/// Appends a row: entries of packed ones, those of one column added in their order.
void append(const std::vector<const std::vector<double>*>& packed, const ShareOfNumbers& columns, SparseRows& to) {
  const std::size_t width = to.width;
  std::vector<std::pair<int, const double*>> entries;
  for (const auto* row : packed)
    for (std::size_t at = 0; at < row->size(); at += width + 1)
      entries.emplace_back(place(static_cast<std::int64_t>((*row)[at]), columns), row->data() + at + 1);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  int last = -1;
  for (const auto& [column, values] : entries) {
    if (column == last) {
      double* sum = to.values.data() + to.values.size() - width;
      for (std::size_t i = 0; i < width; ++i) sum[i] += values[i];
    } else {
      to.columns.push_back(column);
      to.values.insert(to.values.end(), values, values + width);
    }
    last = column;
  }
  to.offsets.push_back(static_cast<int>(to.columns.size()));
}

}  // namespace

void renumber(std::vector<int>& columns, const ShareOfNumbers& from, const ShareOfNumbers& to) {
  for (int& column : columns)
    if (column >= from.own) column = place(from.number(column), to);
}

SparseRows with_rows_of_copies(SparseRows rows, const ShareOfNumbers& fine, ShareOfNumbers& columns) {
  if (fine.processes->is_alone()) return rows;
  std::vector<std::vector<double>> packed(fine.items());
  for (const auto& neighbour : fine.exchange.neighbours())
    for (const int row : neighbour.sent)
      if (packed[row].empty()) pack(rows, row, columns, packed[row]);
  fine.exchange.update_rows(packed);
  std::vector<const std::vector<double>*> of_copies;
  for (int row = fine.own; row < fine.items(); ++row) of_copies.push_back(&packed[row]);
  const ShareOfNumbers before = columns;
  extend(columns, of_copies, rows.width);
  renumber(rows.columns, before, columns);
  for (const auto* row : of_copies) append({row}, columns, rows);
  return rows;
}

SparseRows sum_of_rows(const SparseRows& rows, ShareOfNumbers& share) {
  if (share.processes->is_alone()) return rows;
  std::vector<std::vector<double>> packed(share.items());
  for (int row = 0; row < share.items(); ++row) pack(rows, row, share, packed[row]);
  const auto received = share.exchange.rows_from_copies(packed);
  std::vector<const std::vector<double>*> all;
  std::vector<std::vector<const std::vector<double>*>> of_row(share.own);
  for (int row = 0; row < share.own; ++row) of_row[row].push_back(&packed[row]);
  for (std::size_t i = 0; i < received.size(); ++i)
    for (std::size_t item = 0; item < received[i].size(); ++item) {
      of_row[share.exchange.neighbours()[i].sent[item]].push_back(&received[i][item]);
      all.push_back(&received[i][item]);
    }
  extend(share, all, rows.width);
  SparseRows sum;
  sum.width = rows.width;
  for (const auto& parts : of_row) append(parts, share, sum);
  return sum;
}

SparseRows gather_rows(const SparseRows& rows, const ShareOfNumbers& share) {
  if (share.processes->is_alone()) return rows;
  std::vector<double> mine, packed;
  for (int row = 0; row < rows.rows(); ++row) {
    packed.clear();
    pack(rows, row, share, packed);
    mine.push_back(static_cast<double>(packed.size()));
    mine.insert(mine.end(), packed.begin(), packed.end());
  }
  const auto whole = static_cast<int>(share.processes->sum(std::int64_t{share.own}));
  ShareOfNumbers all;  // as one process would have it
  all.own = whole;
  SparseRows result;
  result.width = rows.width;
  const std::vector<double> gathered = share.processes->gather(mine);
  for (auto from = gathered.begin(); from != gathered.end();) {
    const auto length = static_cast<std::ptrdiff_t>(*from++);
    const std::vector<double> row(from, from + length);
    append({&row}, all, result);
    from += length;
  }
  return result;
}

}  // namespace fsi
