#include "partitioned/accelerators/affine_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

namespace {

constexpr double little = 0.5;           // of what was not explained, that a guess of it should leave at most
constexpr double pair_rounding = 1e-10;  // of pairs, relative
constexpr double hardly = 1e-3;  // of a residual that a pass leaves, what was not explained before: pairs are to blame

using Matrix = Eigen::Map<const Eigen::MatrixXd>;

Matrix matrix_of(const std::vector<double>& columns, std::size_t rows, std::size_t count) {
  return {columns.data(), static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(count)};
}

Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

}  // namespace

std::vector<double> AffineMap::products(const std::vector<double>& r) const {
  std::vector<double> sums(pairs_, 0.0);
  if (pairs_ == 0) return sums;
  const auto own = static_cast<Eigen::Index>(space_.own(r));
  const Eigen::VectorXd of_rows = matrix_of(v_, size_, pairs_).topRows(own).transpose() * vector_of(r).head(own);
  for (std::size_t j = 0; j < pairs_; ++j) sums[j] = of_rows[static_cast<Eigen::Index>(j)];
  if (!space_.is_whole()) space_.sum(sums.data(), sums.size());
  return sums;
}

void AffineMap::add(const Columns& columns, const std::vector<double>& weights, std::vector<double>& to) const {
  if (pairs_ == 0 || size_ == 0) return;
  const Eigen::VectorXd sum = matrix_of(columns, size_, pairs_) * vector_of(weights);
  Eigen::Map<Eigen::VectorXd>(to.data(), sum.size()) += sum;
}

std::vector<double> AffineMap::column(const Columns& columns, std::size_t j) const {
  const auto from = columns.begin() + static_cast<std::ptrdiff_t>(j * size_);
  return {from, from + static_cast<std::ptrdiff_t>(size_)};
}

std::vector<double> AffineMap::correction(const std::vector<double>& r) {
  size_ = r.size();
  std::vector<double> along = products(r);
  scale(-1, along);
  unexplained_ = r;
  add(v_, along, unexplained_);
  step_ = unexplained_;
  if (before_.rank() > 0) axpy(1, before_.times(unexplained_), step_);
  corrected_ = r;
  correction_ = step_;
  add(w_, along, correction_);
  return correction_;
}

void AffineMap::mend_pairs(const std::vector<double>& r) {
  std::vector<double> change = r;
  axpy(-1, corrected_, change);
  std::vector<double> along = products(change);
  const double square = dot(along, along);
  if (square == 0) return;
  scale(-1, along);
  std::vector<double> lacking = correction_;
  add(w_, along, lacking);
  for (std::size_t j = 0; j < pairs_; ++j) {
    const double part = -along[j] / square;
    for (std::size_t i = 0; i < size_; ++i) w_[j * size_ + i] += part * lacking[i];
  }
}

void AffineMap::learn(const std::vector<double>& r, double accuracy) {
  // v = S (1 + L) u: the other part of the last change of x, -W V^T r, changed the residual by -V V^T r, to rounding.
  std::vector<double> v = r, w = step_;
  axpy(-1, unexplained_, v);
  // Where (1 + L) u has reduced the unexplained part little, L is dropped, and pairs are taken whatever the filter.
  const bool misled = space_.norm(r) > little * space_.norm(unexplained_);
  if (misled) before_.clear();
  const double least = std::max(misled ? pair_rounding : filter_, accuracy) * space_.norm(corrected_);
  if (!(space_.norm(v) > least)) return;
  std::vector<double> along = products(v);
  scale(-1, along);
  add(v_, along, v);
  add(w_, along, w);
  const double left = space_.norm(v);
  if (!(left > least)) {
    if (space_.norm(unexplained_) < hardly * space_.norm(r)) mend_pairs(r);
    return;
  }
  scale(1 / left, v);
  scale(1 / left, w);
  if (pairs_ < most_) {
    ++pairs_;
    v_.resize(pairs_ * size_);
    w_.resize(pairs_ * size_);
  }
  std::copy(v.begin(), v.end(), v_.begin() + static_cast<std::ptrdiff_t>(next_ * size_));
  std::copy(w.begin(), w.end(), w_.begin() + static_cast<std::ptrdiff_t>(next_ * size_));
  next_ = (next_ + 1) % most_;
}

void AffineMap::renew() {
  std::vector<std::vector<double>> left;
  for (std::size_t j = 0; j < pairs_; ++j) {
    const std::vector<double> v = column(v_, j);
    left.push_back(before_.times(v));
    axpy(1, column(w_, j), left.back());
    axpy(1, v, left.back());
    scale(-1, left.back());
  }
  for (std::size_t j = 0; j < left.size(); ++j) before_.add(std::move(left[j]), column(v_, j));
  if (before_.rank() > most_) before_.truncate((most_ + 1) / 2, LowRankMap::truncation);
  pairs_ = next_ = 0;
}

void AffineMap::clear() {
  pairs_ = next_ = 0;
  before_.clear();
}

void AffineMap::keep(RestartArchive& archive, const std::string& name) {
  before_.keep(archive, name + ".before");
  if (archive.recalls()) pairs_ = next_ = 0;
  if (!archive.wants({name + ".pairs", name + ".next", name + ".v", name + ".w"})) return;
  auto pairs = static_cast<double>(pairs_), next = static_cast<double>(next_);
  archive.number(name + ".pairs", pairs, count_range);
  archive.number(name + ".next", next, count_range);
  const auto count = static_cast<std::size_t>(pairs);
  std::vector<double> v(v_.begin(), v_.begin() + static_cast<std::ptrdiff_t>(pairs_ * size_));
  std::vector<double> w(w_.begin(), w_.begin() + static_cast<std::ptrdiff_t>(pairs_ * size_));
  archive.array(name + ".v", ArrayKind::interface_columns, v, {{}, count});
  archive.array(name + ".w", ArrayKind::interface_columns, w, {{}, count});
  if (!archive.recalls() || count == 0) return;
  size_ = v.size() / count;
  pairs_ = std::min(count, most_);
  next_ = pairs_ < most_ ? pairs_ : std::min(static_cast<std::size_t>(next), most_ - 1);
  v_.assign(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(pairs_ * size_));
  w_.assign(w.begin(), w.begin() + static_cast<std::ptrdiff_t>(pairs_ * size_));
}

}  // namespace fsi
