#include "linear/amg/shared_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace fsi {

namespace {

/// A row as numbers that can be sent: for each entry the column's number among all processes' ones, then its values.
template <class Number>
void pack(const SparseRows& rows, int row, Number number_of, std::vector<double>& to) {
  for (int at = rows.offsets[row]; at < rows.offsets[row + 1]; ++at) {
    to.push_back(static_cast<double>(number_of(rows.columns[at])));
    const auto from = rows.values.begin() + static_cast<std::ptrdiff_t>(at) * rows.width;
    to.insert(to.end(), from, from + rows.width);
  }
}

}  // namespace

SparseRows with_rows_of_copies(SparseRows rows, const ShareOfNumbers& fine, int coarse, ShareOfNumbers& share) {
  const Communicator& processes = *fine.processes;
  if (processes.is_alone()) {
    share = ShareOfNumbers(processes, coarse, {});
    return rows;
  }
  const std::int64_t first = processes.sum_before(std::int64_t{coarse});
  std::vector<std::vector<double>> packed(fine.items());
  for (const auto& neighbour : fine.exchange.neighbours())
    for (const int row : neighbour.sent)
      if (packed[row].empty()) pack(rows, row, [&](int column) { return first + column; }, packed[row]);
  fine.exchange.update_rows(packed);
  const std::size_t entry = static_cast<std::size_t>(rows.width) + 1;
  std::vector<std::int64_t> copies;
  for (int row = fine.own; row < fine.items(); ++row)
    for (std::size_t at = 0; at < packed[row].size(); at += entry)
      copies.push_back(static_cast<std::int64_t>(packed[row][at]));
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  for (int row = fine.own; row < fine.items(); ++row) {
    const auto& from = packed[row];
    for (std::size_t at = 0; at < from.size(); at += entry) {
      const auto place = std::lower_bound(copies.begin(), copies.end(), static_cast<std::int64_t>(from[at]));
      rows.columns.push_back(coarse + static_cast<int>(place - copies.begin()));
      const auto values = from.begin() + static_cast<std::ptrdiff_t>(at) + 1;
      rows.values.insert(rows.values.end(), values, values + rows.width);
    }
    rows.offsets.push_back(static_cast<int>(rows.columns.size()));
  }
  share = ShareOfNumbers(processes, coarse, std::move(copies));
  return rows;
}

SparseRows gather_rows(const SparseRows& rows, const ShareOfNumbers& share) {
  if (share.processes->is_alone()) return rows;
  std::vector<double> mine;
  for (int row = 0; row < rows.rows(); ++row) {
    mine.push_back(rows.offsets[row + 1] - rows.offsets[row]);
    pack(rows, row, [&](int column) { return share.number(column); }, mine);
  }
  const std::vector<double> all = share.processes->gather(mine);
  SparseRows whole;
  whole.width = rows.width;
  for (auto from = all.begin(); from != all.end();) {
    const int count = static_cast<int>(*from++);
    std::vector<std::pair<int, std::ptrdiff_t>> order;  // copies have higher places here than own ones, not numbers
    for (int i = 0; i < count; ++i) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) * (rows.width + 1);
      order.emplace_back(static_cast<int>(from[at]), at + 1);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [column, at] : order) {
      whole.columns.push_back(column);
      whole.values.insert(whole.values.end(), from + at, from + at + rows.width);
    }
    from += static_cast<std::ptrdiff_t>(count) * (rows.width + 1);
    whole.offsets.push_back(static_cast<int>(whole.columns.size()));
  }
  return whole;
}

}  // namespace fsi
