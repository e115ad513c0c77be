#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/nodal_arrays.hpp"

namespace fsi::test {

/// Central differences of a residual along a direction against the derivative that the code under test gives, for a
/// sequence of halved steps: an exact derivative leaves the differences' own error, which falls with the square of the
/// step until rounding takes over. One tolerance at one step could not tell a small missing term from truncation.
struct DifferenceTable {
  struct Row {
    double step, error;  ///< error relative to the norm of the derivative
    double order = 0;    ///< observed from the row before
  };
  std::string name;
  std::vector<Row> rows;

  double smallest() const {
    double error = INFINITY;
    for (const auto& row : rows) error = std::min(error, row.error);
    return error;
  }
  std::string text() const {
    std::string lines = name + "\n        step   relative error   order\n";
    for (const auto& row : rows)
      lines += fmt::format("  {:10.3e}       {:10.3e}   {:5.2f}\n", row.step, row.error, row.order);
    return lines;
  }
};

/// \param residual    t -> R(x + t direction), a vector
/// \param derivative  the derivative of R along the direction
template <class Residual>
DifferenceTable central_differences(std::string name, Residual residual, const std::vector<double>& derivative,
                                    double first_step = 0.1, int halvings = 15) {
  DifferenceTable table{std::move(name), {}};
  const double scale = norm(derivative);
  double step = first_step;
  for (int k = 0; k <= halvings; ++k, step /= 2) {
    const auto plus = residual(step), minus = residual(-step);
    std::vector<double> error(derivative.size());
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = (plus[i] - minus[i]) / (2 * step) - derivative[i];
    DifferenceTable::Row row{step, norm(error) / scale};
    if (k > 0) row.order = std::log2(table.rows.back().error / row.error);
    table.rows.push_back(row);
  }
  return table;
}

/// Observed orders of all rows whose error stands clear of rounding, i.e. above `clear`.
inline std::vector<double> observed_orders(const DifferenceTable& table, double clear = 1e-7) {
  std::vector<double> orders;
  for (std::size_t k = 1; k < table.rows.size() && table.rows[k].error > clear; ++k)
    orders.push_back(table.rows[k].order);
  return orders;
}

/// The derivative is exact: second-order differences over at least `pairs` halvings of the step, down to 1e-7 or below.
inline void expect_second_order(const DifferenceTable& table, int pairs = 3) {
  const auto orders = observed_orders(table);
  EXPECT_GE(static_cast<int>(orders.size()), pairs) << table.text();
  bool second = true;
  for (double order : orders) second = second && order > 1.8 && order < 2.2;
  EXPECT_TRUE(second) << table.text();
  EXPECT_LT(table.smallest(), 1e-7) << table.text();
  double low = INFINITY, high = -INFINITY;
  for (double order : orders) low = std::min(low, order), high = std::max(high, order);
  fmt::print("{:<58} order {:.2f} to {:.2f}, smallest error {:.1e}\n", table.name, low, high, table.smallest());
}

/// The derivative of something at most quadratic is exact: central differences of any step are then free of truncation.
inline void expect_exact(const DifferenceTable& table) {
  EXPECT_LT(table.rows.front().error, 1e-10) << table.text();
  EXPECT_LT(table.smallest(), 1e-10) << table.text();
  fmt::print("{:<58} at most quadratic, error {:.1e}\n", table.name, table.smallest());
}

/// The derivative is wrong: no step brings the difference below `floor`. For controls of the check itself.
inline void expect_detected(const DifferenceTable& table, double floor) {
  EXPECT_GT(table.smallest(), floor) << table.text();
  fmt::print("{:<58} detected, smallest error {:.1e}\n", table.name, table.smallest());
}

}  // namespace fsi::test
