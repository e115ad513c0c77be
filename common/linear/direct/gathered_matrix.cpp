#include "linear/direct/gathered_matrix.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"

namespace fsi {

GatheredMatrix::Builder::Builder(std::int64_t size) : size_(size) {
  if (size > largest_size)
    throw InputError("", "linear_solver",
                     "a gathered matrix of " + std::to_string(size) + " unknowns, where the largest has " +
                         std::to_string(largest_size),
                     "give fast, or a coarser mesh");
}

GatheredMatrix::GatheredMatrix(Builder&& builder) {
  auto& terms = builder.terms_;
  // Bucket by column, then sort each short bucket by row; stable, so that the order of the terms of an entry is that of
  // their addition.
  std::vector<std::int64_t> start(builder.size_ + 1, 0);
  for (const auto& t : terms) ++start[t.column + 1];
  for (std::int64_t c = 0; c < builder.size_; ++c) start[c + 1] += start[c];
  std::vector<Builder::Term> sorted(terms.size());
  auto next = start;
  for (const auto& t : terms) sorted[next[t.column]++] = t;
  terms.clear();
  terms.shrink_to_fit();

  matrix_.offsets.assign(1, 0);
  numbers_.reserve(sorted.size());
  factors_.reserve(sorted.size());
  for (std::int64_t c = 0; c < builder.size_; ++c) {
    std::stable_sort(sorted.begin() + start[c], sorted.begin() + start[c + 1],
                     [](const auto& a, const auto& b) { return a.row < b.row; });
    for (std::int64_t k = start[c]; k < start[c + 1]; ++k) {
      if (k == start[c] || sorted[k].row != sorted[k - 1].row) {
        matrix_.rows.push_back(sorted[k].row);
        term_offsets_.push_back(static_cast<std::int64_t>(numbers_.size()));
      }
      numbers_.push_back(sorted[k].number);
      factors_.push_back(sorted[k].factor);
    }
    matrix_.offsets.push_back(static_cast<std::int64_t>(matrix_.rows.size()));
  }
  term_offsets_.push_back(static_cast<std::int64_t>(numbers_.size()));
  matrix_.values.assign(matrix_.rows.size(), 0.0);
}

void GatheredMatrix::update() {
  const auto entries = static_cast<std::int64_t>(matrix_.values.size());
#pragma omp parallel for schedule(static) if (entries > 100000)
  for (std::int64_t e = 0; e < entries; ++e) {
    double sum = 0;
    for (std::int64_t k = term_offsets_[e]; k < term_offsets_[e + 1]; ++k) sum += factors_[k] * *numbers_[k];
    matrix_.values[e] = sum;
  }
}

}  // namespace fsi
