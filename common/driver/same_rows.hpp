#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/column.hpp"
#include "io/earlier_tables.hpp"

namespace fsi {

/// How far numbers of two origins lie apart, and the largest of them.
class Agreement {
 public:
  void include(double a, double b);
  /// An empty place in one of two tables only.
  void differ() { apart_ = HUGE_VAL; }
  double apart() const { return apart_; }
  double size() const { return size_; }

 private:
  double apart_ = 0, size_ = 0;
};

/// Refuses rows that the checkpoint's state does not give again.
/// \param time  of the level, ms
/// \throws InputError naming the table
void require_agreement(const EarlierTables& earlier, const std::string& file, double time, const Agreement& found);

/// Compares what is seen of a level with its rows in a table of an earlier run: columns of one measure by the largest
/// number in any of them. \throws InputError
template <class Record>
void require_same_rows(const EarlierTables& earlier, const std::string& file, double time,
                       const Columns<Record>& columns, const std::vector<Record>& seen) {
  const auto& rows = earlier.last_level(file);
  if (rows.empty()) return;
  const std::size_t width = 1 + columns.size();  // the time comes first
  std::map<Measure, Agreement> by_measure;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].measure != Measure::none)
        by_measure[columns[c].measure].include(rows.at(i * width + 1 + c), columns[c].value(seen[i]));
  for (const auto& [measure, found] : by_measure) require_agreement(earlier, file, time, found);
}

}  // namespace fsi
