#include "algebra/panel_matrix.hpp"

#include <algorithm>
#include <iterator>

#include "algebra/panel_products.hpp"

namespace fsi {

namespace {

constexpr int widest_panel = 64;
constexpr double stored_zeros = 0.2;  // share of a panel's entries, at most: zeros cost less than another panel

/// Rows of column j behind `last`.
void rows_behind(const CompactColumns<float>& columns, int j, int last, std::vector<int>& rows) {
  rows.clear();
  for (std::int64_t k = columns.offsets[j]; k < columns.offsets[j + 1]; ++k)
    if (columns.rows[k] > last) rows.push_back(columns.rows[k]);
}

}  // namespace

PanelMatrix::PanelMatrix(const CompactColumns<float>& columns) : size_(columns.size()) {
  const int size = size_;
  std::vector<int> rows, next, both;  // below the panel so far, of the next column, of both
  for (int first = 0; first < size;) {
    rows_behind(columns, first, first, rows);
    std::size_t entries = rows.size();
    int end = first + 1;
    for (; end < size && end - first < widest_panel; ++end) {
      rows_behind(columns, end, end, next);
      both.clear();
      std::set_union(std::upper_bound(rows.begin(), rows.end(), end), rows.end(), next.begin(), next.end(),
                     std::back_inserter(both));
      const auto width = static_cast<std::size_t>(end - first) + 1;
      const std::size_t stored = both.size() * width + width * (width - 1) / 2;
      if (static_cast<double>(stored) > (1 + stored_zeros) * static_cast<double>(entries + next.size()) + 2.0 * width)
        break;
      rows.swap(both);
      entries += next.size();
    }
    add_panel(columns, first, end, {std::lower_bound(rows.begin(), rows.end(), end), rows.end()});
    first = end;
  }
}

PanelMatrix::PanelMatrix(const Supernodes& supernodes)
    : size_(supernodes.groups > 0 ? static_cast<int>(supernodes.first_column[supernodes.groups]) : 0) {
  for (int s = 0; s < supernodes.groups; ++s) {
    const auto begin = static_cast<int>(supernodes.first_column[s]),
               end = static_cast<int>(supernodes.first_column[s + 1]);
    const std::int64_t* rows = supernodes.rows + supernodes.first_row[s];
    const std::int64_t row_count = supernodes.first_row[s + 1] - supernodes.first_row[s];
    const double* values = supernodes.values + supernodes.first_value[s];
    for (int first = begin; first < end; first += widest_panel) {
      const int width = std::min(widest_panel, end - first), below = first - begin + width;
      const auto rows_below = static_cast<std::size_t>(row_count - below);
      const Panel& panel = append(first, width, static_cast<int>(rows_below));
      std::transform(rows + below, rows + row_count, rows_.begin() + static_cast<std::ptrdiff_t>(panel.row_list),
                     [](std::int64_t row) { return static_cast<int>(row); });
      for (int j = 0; j < width; ++j) {
        const double* column = values + (first - begin + j) * row_count;
        const double pivot = column[first - begin + j];
        float* triangle = triangles_.data() + panel.triangle + static_cast<std::size_t>(j) * width;
        float* block = blocks_.data() + panel.block + static_cast<std::size_t>(j) * rows_below;
        for (int i = j + 1; i < width; ++i) triangle[i] = static_cast<float>(column[first - begin + i] / pivot);
        for (std::size_t i = 0; i < rows_below; ++i) block[i] = static_cast<float>(column[below + i] / pivot);
      }
    }
  }
}

PanelMatrix::Panel& PanelMatrix::append(int first, int width, int rows_below) {
  panels_.push_back({first, width, rows_below, rows_.size(), triangles_.size(), blocks_.size()});
  const auto w = static_cast<std::size_t>(width), below = static_cast<std::size_t>(rows_below);
  rows_.resize(rows_.size() + below);
  triangles_.resize(triangles_.size() + w * w);
  blocks_.resize(blocks_.size() + w * below);
  gathered_.resize(std::max(gathered_.size(), below));
  return panels_.back();
}

void PanelMatrix::add_panel(const CompactColumns<float>& columns, int first, int end,
                            const std::vector<int>& rows_below) {
  const Panel& panel = append(first, end - first, static_cast<int>(rows_below.size()));
  const auto width = static_cast<std::size_t>(panel.width);
  std::copy(rows_below.begin(), rows_below.end(), rows_.begin() + static_cast<std::ptrdiff_t>(panel.row_list));
  for (int j = first; j < end; ++j) {
    float* triangle = triangles_.data() + panel.triangle + (j - first) * width;
    float* block = blocks_.data() + panel.block + (j - first) * rows_below.size();
    auto at = rows_below.begin();
    for (std::int64_t k = columns.offsets[j]; k < columns.offsets[j + 1]; ++k) {
      const int row = columns.rows[k];
      if (row <= j) continue;
      if (row < end) {
        triangle[row - first] = columns.values[k];
      } else {
        at = std::lower_bound(at, rows_below.end(), row);
        block[at - rows_below.begin()] = columns.values[k];
      }
    }
  }
}

void PanelMatrix::solve(float* y, int count) const {
  float* below = gathered_.data();
  for (const Panel& panel : panels_) {
    const int* rows = rows_.data() + panel.row_list;
    for (float* x = y; x != y + static_cast<std::size_t>(count) * size_; x += size_) {
      float* own = x + panel.first;
      solve_unit_lower(triangles_.data() + panel.triangle, panel.width, own);
      for (int i = 0; i < panel.rows; ++i) below[i] = x[rows[i]];
      subtract_combination(blocks_.data() + panel.block, panel.rows, panel.rows, panel.width, own, below);
      for (int i = 0; i < panel.rows; ++i) x[rows[i]] = below[i];
    }
  }
}

void PanelMatrix::solve_transposed(float* y, int count) const {
  float* below = gathered_.data();
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    const int* rows = rows_.data() + panel->row_list;
    for (float* x = y; x != y + static_cast<std::size_t>(count) * size_; x += size_) {
      float* own = x + panel->first;
      for (int i = 0; i < panel->rows; ++i) below[i] = x[rows[i]];
      subtract_products(blocks_.data() + panel->block, panel->rows, panel->rows, panel->width, below, own);
      solve_unit_lower_transposed(triangles_.data() + panel->triangle, panel->width, own);
    }
  }
}

std::size_t PanelMatrix::bytes() const {
  return panels_.size() * sizeof(Panel) + rows_.size() * sizeof(int) +
         (triangles_.size() + blocks_.size() + gathered_.size()) * sizeof(float);
}

}  // namespace fsi
