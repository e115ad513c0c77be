#include "linear/direct/central_factorisation.hpp"

#include <cassert>
#include <cstddef>
#include <utility>

#include "base/error.hpp"

namespace fsi {

namespace {

/// At the first process, one process's after the other's. Messages carry doubles, which hold numbers up to 2^53.
std::vector<std::int64_t> gather_at_first(const Communicator& processes, const std::vector<std::int64_t>& mine) {
  const auto all = processes.gather_at_first(std::vector<double>(mine.begin(), mine.end()));
  return {all.begin(), all.end()};
}

}  // namespace

CentralFactorisation::CentralFactorisation(const Communicator& processes, GatheredMatrix::Builder&& terms)
    : processes_(&processes), mine_(std::move(terms)) {
  merge_patterns();
}

/// Column by column one process's entries after the other's, so that row numbers ascend.
void CentralFactorisation::merge_patterns() {
  const SparseMatrix& mine = mine_.matrix();
  const auto offsets = gather_at_first(*processes_, mine.offsets), rows = gather_at_first(*processes_, mine.rows);
  if (!processes_->is_first()) return;
  const std::size_t columns = mine.offsets.size() - 1;
  whole_.offsets.assign(columns + 1, 0);
  whole_.rows.resize(rows.size());
  whole_.values.resize(rows.size());
  place_.resize(rows.size());
  std::vector<std::size_t> first_entry;  // of each process
  std::size_t entries = 0;
  for (std::size_t end = columns; end < offsets.size(); end += columns + 1) {
    first_entry.push_back(entries);
    entries += static_cast<std::size_t>(offsets[end]);
  }
  std::size_t next = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = 0; r < first_entry.size(); ++r) {
      const auto* offset = offsets.data() + r * (columns + 1) + c;
      for (auto at = first_entry[r] + offset[0]; at < first_entry[r] + offset[1]; ++at) {
        place_[at] = static_cast<std::int64_t>(next);
        whole_.rows[next++] = rows[at];
      }
    }
    whole_.offsets[c + 1] = static_cast<std::int64_t>(next);
  }
}

void CentralFactorisation::update() {
  mine_.update();
  const auto values = processes_->gather_at_first(mine_.matrix().values);
  std::int64_t singular = 0;
  if (processes_->is_first()) {
    for (std::size_t i = 0; i < values.size(); ++i) whole_.values[place_[i]] = values[i];
    try {
      solver_.factorise(whole_);
    } catch (const ConvergenceError&) {
      singular = 1;
    }
  }
  processes_->broadcast(singular);
  factorised_ = singular == 0;
  if (!factorised_)
    throw ConvergenceError("sparse factorisation at the first process: the matrix is singular or holds NaN",
                           "a smaller time step, and check the materials");
}

void CentralFactorisation::solve(const std::vector<double>& b, std::vector<double>& x) const {
  assert(factorised_);
  const auto right = processes_->gather_at_first(b);
  if (processes_->is_first()) {
    try {
      solver_.solve(whole_, right, x);
    } catch (const ConvergenceError&) {
      x.clear();  // tells all
    }
  }
  processes_->broadcast(x);
  if (x.empty()) throw ConvergenceError("sparse solve failed at the first process", "a smaller time step");
}

double CentralFactorisation::memory_mib() const {
  const auto entries = static_cast<double>(mine_.matrix().nonzeros() + whole_.nonzeros());
  return (16.0 * static_cast<double>(solver_.factor_nonzeros()) + 24.0 * entries) / (1 << 20);
}

}  // namespace fsi
