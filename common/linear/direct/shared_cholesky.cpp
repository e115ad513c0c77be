#include "linear/direct/shared_cholesky.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "algebra/registers.hpp"
#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "linear/direct/dense_inverse.hpp"

namespace fsi {

namespace {

/// In an order that does not depend on the machine.
template <class Real>
Real scalar_product(const Real* x, const Real* y, std::size_t size) {
  Register<4, Real> sums{};
  std::size_t i = 0;
  for (; i + 4 <= size; i += 4) sums += load<4>(x + i) * load<4>(y + i);
  Real rest = 0;
  for (; i < size; ++i) rest += x[i] * y[i];
  return rest + sum_of_lanes(sums);
}

/// W^T b, with `columns` columns of W and `count` of b one behind the other.
template <class Real>
void multiply_transposed(const std::vector<Real>& w, std::size_t columns, const std::vector<Real>& b, int count,
                         std::vector<double>& product) {
  product.assign(columns * count, 0.0);
  if (columns == 0) return;
  const std::size_t rows = w.size() / columns;
  parallel_for(columns, w.size() > 200000, [&](std::size_t j) {
    for (int c = 0; c < count; ++c)
      product[columns * c + j] = scalar_product(w.data() + rows * j, b.data() + rows * c, rows);
  });
}

/// x -= W y
template <class Real>
void subtract_product(const std::vector<Real>& w, std::size_t columns, const std::vector<double>& y, int count,
                      std::vector<double>& x) {
  if (columns == 0 || w.empty()) return;
  const std::size_t rows = w.size() / columns;
  constexpr std::size_t chunk = 512;  // of rows, whose sums stay in the cache
  parallel_for((rows + chunk - 1) / chunk, w.size() > 200000, [&](std::size_t k) {
    const std::size_t begin = k * chunk, end = std::min(rows, begin + chunk);
    Real sums[chunk];
    for (int c = 0; c < count; ++c) {
      std::fill_n(sums, end - begin, Real(0));
      for (std::size_t j = 0; j < columns; ++j) {
        const Real factor = static_cast<Real>(y[columns * c + j]);
        const Real* column = w.data() + rows * j;
        for (std::size_t i = begin; i < end; ++i) sums[i - begin] += factor * column[i];
      }
      for (std::size_t i = begin; i < end; ++i) x[rows * c + i] -= sums[i - begin];
    }
  });
}

[[noreturn]] void refuse() {
  throw ConvergenceError("sparse factorisation: the matrix is not positive definite or holds NaN",
                         "a smaller time step, and check the mesh");
}

}  // namespace

/// Of two unknowns of different processes that couple, that of the process before is of the separator. Couplings are looked
/// at from both sides, since one of them may be zero where the other is rounding.
std::vector<char> SharedCholesky::find_separator(const CsrMatrix<double>& a, const ShareOfNumbers& share) {
  const std::int64_t end = share.first + share.own;
  std::vector<double> separated(static_cast<std::size_t>(share.items()), 0.0);
  const auto separate = [&](auto left_to_others) {
    for (int row = 0; row < share.own; ++row)
      for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
        if (const int column = a.indices[at]; column >= share.own && a.values[at] != 0 && !left_to_others(column))
          separated[row] = 1;
    share.exchange.update(separated);
  };
  separate([&](int column) { return share.number(column) < end; });
  separate([&](int column) { return separated[column] != 0; });
  return {separated.begin(), separated.end()};
}

SharedCholesky::Size SharedCholesky::size_of(const CsrMatrix<double>& a, const ShareOfNumbers& share) {
  const auto separated = find_separator(a, share);
  const auto count = [&](int items) { return std::count(separated.begin(), separated.begin() + items, char{1}); };
  const auto own = count(share.own), here = count(share.items());
  return {share.processes->sum(std::int64_t{own}),
          share.processes->largest(static_cast<double>((share.own - own) * here))};
}

void SharedCholesky::factorise(const CsrMatrix<double>& a, const ShareOfNumbers& share, bool single_precision) {
  factorised_ = false;
  processes_ = share.processes;
  is_separated_ = find_separator(a, share);
  inner_.clear();
  separated_.clear();
  own_separated_ = 0;
  of_item_.assign(is_separated_.size(), -1);
  for (int item = 0; item < share.items(); ++item) {
    if (!is_separated_[item] && item >= share.own) continue;
    auto& of = is_separated_[item] ? separated_ : inner_;
    of_item_[item] = static_cast<int>(of.size());
    of.push_back(item);
    if (item < share.own) own_separated_ = static_cast<int>(separated_.size());
  }
  const std::int64_t first = processes_->sum_before(std::int64_t{own_separated_});
  size_ = processes_->sum(std::int64_t{own_separated_});
  std::vector<double> numbers(is_separated_.size(), 0.0);
  for (int i = 0; i < own_separated_; ++i) numbers[separated_[i]] = static_cast<double>(first + i);
  share.exchange.update(numbers);
  number_.clear();
  for (const int item : separated_) number_.push_back(static_cast<std::int64_t>(numbers[item]));
  const SparseMatrix own = inner_rows(a);
  factorise_inner(own);
  find_couplings(a);
  invert_schur_complement(a);
  if (single_precision && !inner_.empty()) solver_.reduce_precision(own);
  residual_ = processes_->largest(inner_.empty() ? 0 : solver_.residual());
  single_couplings_ = {};
  if (residual_ > 0) {
    single_couplings_.assign(couplings_.begin(), couplings_.end());
    couplings_ = {};
  }
  factorised_ = true;
}

SparseMatrix SharedCholesky::inner_rows(const CsrMatrix<double>& a) const {
  SparseMatrix rows;  // by columns: the matrix is symmetric
  rows.offsets = {0};
  for (const int row : inner_) {
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) {
      const int column = a.indices[at];
      if (column >= a.rows() || is_separated_[column]) continue;
      rows.rows.push_back(of_item_[column]);
      rows.values.push_back(a.values[at]);
    }
    rows.offsets.push_back(static_cast<std::int64_t>(rows.rows.size()));
  }
  return rows;
}

void SharedCholesky::factorise_inner(const SparseMatrix& rows) {
  enum Failure { none, singular, memory };
  Failure failure = none;
  std::string message;
  if (!inner_.empty()) {
    try {
      solver_.factorise(rows);
    } catch (const ConvergenceError&) {
      failure = singular;
    } catch (const OutOfMemory& error) {
      failure = memory;
      message = error.what();
    }
  }
  const double worst = processes_->largest(failure);
  if (worst == memory) throw OutOfMemory(failure == memory ? message : "the factor of another process does not fit");
  if (worst == singular) refuse();
}

void SharedCholesky::find_couplings(const CsrMatrix<double>& a) {
  constexpr std::size_t batch = 32;  // of columns: solves keep a few copies of them
  const std::size_t rows = inner_.size();
  couplings_.assign(rows * separated_.size(), 0.0);
  for (std::size_t i = 0; i < rows; ++i)
    for (int at = a.offsets[inner_[i]]; at < a.offsets[inner_[i] + 1]; ++at)
      if (const int column = a.indices[at]; is_separated_[column])
        couplings_[rows * of_item_[column] + i] = a.values[at];
  std::vector<double> right, solution;
  for (std::size_t first = 0; rows > 0 && first < separated_.size(); first += batch) {
    const std::size_t count = std::min(batch, separated_.size() - first);
    const auto begin = couplings_.begin() + static_cast<std::ptrdiff_t>(rows * first);
    right.assign(begin, begin + static_cast<std::ptrdiff_t>(rows * count));
    solver_.solve(right, static_cast<int>(count), solution);
    std::copy(solution.begin(), solution.end(), begin);
  }
}

void SharedCholesky::invert_schur_complement(const CsrMatrix<double>& a) {
  const auto size = static_cast<std::size_t>(size_);
  std::vector<double> schur(size * size, 0.0);
  for (int i = 0; i < own_separated_; ++i)
    for (int at = a.offsets[separated_[i]]; at < a.offsets[separated_[i] + 1]; ++at)
      if (const int column = a.indices[at]; is_separated_[column])
        schur[number_[i] * size + number_[of_item_[column]]] += a.values[at];
  for (std::size_t i = 0; i < inner_.size(); ++i)
    for (int at = a.offsets[inner_[i]]; at < a.offsets[inner_[i] + 1]; ++at) {
      const int column = a.indices[at];
      if (!is_separated_[column]) continue;
      double* row = schur.data() + number_[of_item_[column]] * size;
      for (std::size_t j = 0; j < separated_.size(); ++j)
        row[number_[j]] -= a.values[at] * couplings_[inner_.size() * j + i];
    }
  constexpr std::size_t stretch = 1 << 16;  // of numbers: a sum over processes gathers as many from each
  for (std::size_t begin = 0; begin < schur.size(); begin += stretch)
    processes_->sum(schur.data() + begin, std::min(stretch, schur.size() - begin));
  // Symmetric but for rounding.
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j)
      schur[i * size + j] = schur[j * size + i] = 0.5 * (schur[i * size + j] + schur[j * size + i]);
  const auto whole = size > 0 ? dense_inverse(schur, static_cast<int>(size)) : std::vector<double>();
  if (whole.size() != schur.size()) refuse();
  inverse_.clear();
  for (const std::int64_t row : number_)
    inverse_.insert(inverse_.end(), whole.begin() + static_cast<std::ptrdiff_t>(row * size_),
                    whole.begin() + static_cast<std::ptrdiff_t>((row + 1) * size_));
}

void SharedCholesky::solve(const std::vector<double>& b, int count, std::vector<double>& x) const {
  assert(factorised_);
  if (size_ == 0) {
    x.resize(b.size());
    if (!inner_.empty()) solver_.solve(b, count, x);
    return;
  }
  const std::size_t inner = inner_.size(), own = inner + own_separated_, separated = separated_.size(), columns = count;
  assert(b.size() == own * columns);
  inner_b_.resize(inner * columns);
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t i = 0; i < inner; ++i) inner_b_[inner * c + i] = b[own * c + inner_[i]];
  const bool single = !single_couplings_.empty();
  if (single) {
    single_b_.assign(inner_b_.begin(), inner_b_.end());
    multiply_transposed(single_couplings_, separated, single_b_, count, separator_x_);
  } else {
    multiply_transposed(couplings_, separated, inner_b_, count, separator_x_);
  }
  of_separator_.assign(static_cast<std::size_t>(size_) * columns, 0.0);
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t j = 0; j < separated; ++j) {
      double& sum = of_separator_[static_cast<std::size_t>(size_) * c + number_[j]];
      sum -= separator_x_[separated * c + j];
      if (static_cast<int>(j) < own_separated_) sum += b[own * c + separated_[j]];
    }
  processes_->sum(of_separator_);
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t j = 0; j < separated; ++j)
      separator_x_[separated * c + j] =
          scalar_product(inverse_.data() + static_cast<std::size_t>(size_) * j,
                         of_separator_.data() + static_cast<std::size_t>(size_) * c, static_cast<std::size_t>(size_));
  if (inner > 0) solver_.solve(inner_b_, count, inner_x_);
  if (single)
    subtract_product(single_couplings_, separated, separator_x_, count, inner_x_);
  else
    subtract_product(couplings_, separated, separator_x_, count, inner_x_);
  x.resize(own * columns);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t i = 0; i < inner; ++i) x[own * c + inner_[i]] = inner_x_[inner * c + i];
    for (int j = 0; j < own_separated_; ++j) x[own * c + separated_[j]] = separator_x_[separated * c + j];
  }
}

double SharedCholesky::bytes() const {
  return solver_.bytes() + static_cast<double>((couplings_.size() + inverse_.size()) * sizeof(double) +
                                               single_couplings_.size() * sizeof(float));
}

}  // namespace fsi
