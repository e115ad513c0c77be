#pragma once

#include <cmath>
#include <vector>

namespace fsi {

/// Ends of `cells` intervals that divide [0, length], cells + 1 numbers. The first interval is `grading` times as long
/// as the last; lengths change by one ratio from each to the next. The last number is `length` exactly.
inline std::vector<double> graded_line(double length, int cells, double grading) {
  std::vector<double> ends(cells + 1, 0.0);
  const double ratio = cells > 1 ? std::pow(grading, -1.0 / (cells - 1)) : 1.0;
  double sum = 0, cell = 1;
  for (int i = 1; i <= cells; ++i, cell *= ratio) ends[i] = sum += cell;
  for (int i = 1; i < cells; ++i) ends[i] *= length / sum;
  ends[cells] = length;
  return ends;
}

}  // namespace fsi
