#include "partitioned/accelerators/regularised_iqn.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

namespace {
/// Error of a column relative to its length: of one of this step, as passes of one Newton iteration leave it, and what each
/// step adds while the Jacobian drifts (docs/coupling.md).
constexpr double noise = 0.1, drift = 0.02;
}  // namespace

void RegularisedIqn::start() {
  has_last_ = false;
  status_ = {};
  std::size_t old = 0;
  for (int& age : age_) {
    ++age;
    if (age > options_.reused_steps) ++old;
  }
  drop(old);
}

void RegularisedIqn::drop(std::size_t count) {
  if (count == 0) return;
  const auto begin = static_cast<std::ptrdiff_t>(count);
  v_.erase(v_.begin(), v_.begin() + begin);
  w_.erase(w_.begin(), w_.begin() + begin);
  age_.erase(age_.begin(), age_.begin() + begin);
  const auto left = static_cast<Eigen::Index>(v_.size());
  gram_ = gram_.bottomRightCorner(left, left).eval();
}

void RegularisedIqn::abandon() {
  while (!age_.empty() && age_.back() == 0) {
    v_.pop_back();
    w_.pop_back();
    age_.pop_back();
  }
  const auto left = static_cast<Eigen::Index>(v_.size());
  gram_ = gram_.topLeftCorner(left, left).eval();
}

void RegularisedIqn::change(bool longer) {
  if (longer) drop(v_.size());
}

void RegularisedIqn::add_column(std::vector<double> v, std::vector<double> w, int age) {
  v_.push_back(std::move(v));
  w_.push_back(std::move(w));
  age_.push_back(age);
  const std::vector<double> products = space_.dots(v_, v_.back());
  const auto size = static_cast<Eigen::Index>(v_.size());
  gram_.conservativeResize(size, size);
  for (Eigen::Index j = 0; j < size; ++j) gram_(j, size - 1) = gram_(size - 1, j) = products[j];
  if (v_.size() > static_cast<std::size_t>(options_.columns)) drop(1);
}

void RegularisedIqn::add_difference(const std::vector<double>& x, const std::vector<double>& r) {
  if (has_last_) {
    std::vector<double> v = r, w = x;
    axpy(-1, last_r_, v);
    axpy(-1, last_x_, w);
    add_column(std::move(v), std::move(w), 0);
  }
  has_last_ = true;
  last_x_ = x;
  last_r_ = r;
}

void RegularisedIqn::correct(std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  if (v_.empty()) {
    axpy(options_.relaxation, r, x);
    status_ = {options_.relaxation, 0};
    return;
  }
  const auto size = static_cast<Eigen::Index>(v_.size());
  Eigen::VectorXd scale(size), right(size);
  for (Eigen::Index j = 0; j < size; ++j) scale[j] = gram_(j, j) > 0 ? 1 / std::sqrt(gram_(j, j)) : 0;
  Eigen::MatrixXd normal = scale.asDiagonal() * gram_ * scale.asDiagonal();
  for (Eigen::Index j = 0; j < size; ++j) {
    const double aged = drift * age_[static_cast<std::size_t>(j)];
    normal(j, j) = 1 + noise * noise + aged * aged;
  }
  const std::vector<double> products = space_.dots(v_, r);
  for (Eigen::Index j = 0; j < size; ++j) right[j] = -scale[j] * products[static_cast<std::size_t>(j)];
  const Eigen::VectorXd c = scale.asDiagonal() * normal.ldlt().solve(right);
  axpy(options_.mixing, r, x);
  for (std::size_t j = 0; j < v_.size(); ++j) {
    axpy(c[static_cast<Eigen::Index>(j)], w_[j], x);
    axpy(options_.mixing * c[static_cast<Eigen::Index>(j)], v_[j], x);
  }
  status_ = {0, static_cast<int>(v_.size())};
}

void RegularisedIqn::accept(const std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
}

void RegularisedIqn::keep(RestartArchive& archive) {
  if (archive.recalls()) drop(v_.size());
  if (!archive.wants({"regularised_iqn.age", "regularised_iqn.v", "regularised_iqn.w"})) return;
  std::vector<double> v, w, age(age_.begin(), age_.end());
  for (std::size_t j = 0; j < v_.size(); ++j) {
    v.insert(v.end(), v_[j].begin(), v_[j].end());
    w.insert(w.end(), w_[j].begin(), w_[j].end());
  }
  ArrayRule ages;
  ages.each = count_range;
  archive.array("regularised_iqn.age", ArrayKind::alike, age, ages);
  archive.array("regularised_iqn.v", ArrayKind::interface_columns, v, {{}, age.size()});
  archive.array("regularised_iqn.w", ArrayKind::interface_columns, w, {{}, age.size()});
  if (!archive.recalls() || age.empty()) return;
  const auto size = static_cast<std::ptrdiff_t>(v.size() / age.size());
  for (std::size_t j = 0; j < age.size(); ++j) {
    const auto from = static_cast<std::ptrdiff_t>(j) * size;
    add_column({v.begin() + from, v.begin() + from + size}, {w.begin() + from, w.begin() + from + size},
               static_cast<int>(age[j]));
  }
}

}  // namespace fsi
