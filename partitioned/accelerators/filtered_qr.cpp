#include "partitioned/accelerators/filtered_qr.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

namespace {
constexpr double rounding = 1e-12;  // a part of a column that is new and shorter than this, relative to it
}

FilteredQr::FilteredQr(const std::vector<const std::vector<double>*>& columns, double filter,
                       const InterfaceSpace& space)
    : filter_(filter), space_(space) {
  const std::vector<double> lengths = space_.norms(columns);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    std::vector<double> v = *columns[j];
    const double length = lengths[j];
    if (!(length > 0) || !std::isfinite(length)) continue;
    std::vector<double> r = orthogonalise(v, length);
    if (!(r.back() > filter * length)) continue;
    scale(1 / r.back(), v);
    q_.push_back(std::move(v));
    r_.push_back(std::move(r));
    kept_.push_back(j);
    lengths_.push_back(length);
  }
}

std::vector<double> FilteredQr::orthogonalise(std::vector<double>& v, double length) const {
  std::vector<double> r(q_.size() + 1, 0.0);
  for (int pass = 0; pass < 2; ++pass) {  // the second, where much cancels, makes Q orthogonal to rounding
    const std::vector<double> along = space_.subtract_projections(q_, v);
    for (std::size_t i = 0; i < q_.size(); ++i) r[i] += along[i];
    r.back() = space_.norm(v);
    if (r.back() > 0.1 * length) break;
  }
  return r;
}

bool FilteredQr::insert_first(const std::vector<double>& v) {
  const double length = space_.norm(v);
  std::vector<double> direction = v;
  std::vector<double> along = orthogonalise(direction, length);
  const double rest = along.back();
  if (!(rest > rounding * length) || !std::isfinite(length)) return false;
  scale(1 / rest, direction);
  q_.push_back(std::move(direction));
  for (auto& column : r_) column.push_back(0);
  r_.insert(r_.begin(), std::move(along));
  lengths_.insert(lengths_.begin(), length);
  for (std::size_t i = q_.size() - 1; i-- > 0;) rotate(i, 0);
  r_[0].resize(1);
  kept_.resize(q_.size());
  std::iota(kept_.begin(), kept_.end(), std::size_t{0});
  for (std::size_t j = 0; j < r_.size();)
    if (std::abs(r_[j][j]) > filter_ * lengths_[j])
      ++j;
    else
      remove(j);
  return true;
}

void FilteredQr::remove(std::size_t j) {
  const auto at = static_cast<std::ptrdiff_t>(j);
  r_.erase(r_.begin() + at);
  lengths_.erase(lengths_.begin() + at);
  kept_.erase(kept_.begin() + at);
  for (std::size_t i = j; i < r_.size(); ++i) {
    rotate(i, i);
    r_[i].resize(i + 1);
  }
  q_.pop_back();
}

void FilteredQr::rotate(std::size_t i, std::size_t j) {
  const double a = r_[j][i], b = r_[j][i + 1], length = std::hypot(a, b);
  if (length == 0) return;
  const double c = a / length, s = b / length;
  const auto turn = [c, s](double& x, double& y) {
    const double first = c * x + s * y;
    y = c * y - s * x;
    x = first;
  };
  for (auto& column : r_)
    if (column.size() > i + 1) turn(column[i], column[i + 1]);
  for (std::size_t k = 0; k < q_[i].size(); ++k) turn(q_[i][k], q_[i + 1][k]);
}

std::vector<double> FilteredQr::least_squares(const std::vector<double>& b) const {
  std::vector<double> c = space_.dots(q_, b);
  for (std::size_t j = q_.size(); j-- > 0;) {  // R c = Q^T b
    c[j] /= r_[j][j];
    for (std::size_t i = 0; i < j; ++i) c[i] -= r_[j][i] * c[j];
  }
  return c;
}

std::vector<std::vector<double>> FilteredQr::pseudo_inverse() const {
  std::vector<std::vector<double>> rows = q_;
  for (std::size_t j = rows.size(); j-- > 0;) {  // the same substitution on the rows of Q^T
    scale(1 / r_[j][j], rows[j]);
    for (std::size_t i = 0; i < j; ++i) axpy(-r_[j][i], rows[j], rows[i]);
  }
  return rows;
}

}  // namespace fsi
