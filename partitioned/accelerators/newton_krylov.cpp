#include "partitioned/accelerators/newton_krylov.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

namespace {
constexpr double largest_forcing = 0.1, smallest_forcing = 1e-4;
constexpr int most_halvings = 3;      // of a Newton step that raises the residual
constexpr double probe_length = 0.1;  // |h p| over the residual at most: passes stay near the base point
constexpr double breakdown = 1e-12;   // of a new direction, relative to the product it comes from
}  // namespace

void NewtonKrylov::start() {
  at_base_ = true;
  has_base_ = false;
  halvings_ = 0;
  last_beta_ = 0;
  h_.clear();
  columns_.start();
}

void NewtonKrylov::correct(std::vector<double>& x, const std::vector<double>& r) {
  if (at_base_) {
    if (has_base_ && halvings_ < most_halvings && !(space_.norm(r) < beta_)) {
      // The Newton step was too long: half of it.
      ++halvings_;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.5 * (base_x_[i] + x[i]);
      return;
    }
    begin(x, r);
    if (beta_ > 0) probe(x);
    return;
  }
  // The pass was a product, unless it was cut short: the difference holds for whatever multiple of p it probed.
  std::vector<double> moved = x, product = r;
  axpy(-1, base_x_, moved);
  const double h = space_.dot(moved, p_.back()) / space_.dot(p_.back(), p_.back());
  axpy(-1, base_r_, product);
  if (h != 0) scale(1 / h, product);
  products_.push_back(product);
  const double length = space_.norm(product);
  std::vector<double> column = space_.subtract_projections(q_, product);
  column.push_back(space_.norm(product));
  const bool exhausted = !(column.back() > breakdown * length);
  h_.push_back(std::move(column));
  std::vector<double> y;
  const double left = minimise(y);
  if (!exhausted && left > forcing_ * beta_ && static_cast<int>(h_.size()) < most_directions) {
    scale(1 / h_.back().back(), product);
    q_.push_back(std::move(product));
    probe(x);
    return;
  }
  x = base_x_;
  for (std::size_t j = 0; j < y.size(); ++j) axpy(y[j], p_[j], x);
  at_base_ = true;
  keep_products();
}

void NewtonKrylov::accept(const std::vector<double>&, const std::vector<double>&) {
  keep_products();
}

void NewtonKrylov::abandon() {
  columns_.abandon();
  products_.clear();
  p_.clear();
}

void NewtonKrylov::keep_products() {
  for (std::size_t j = 0; j < products_.size(); ++j) columns_.add(std::move(products_[j]), std::move(p_[j]));
  products_.clear();
  p_.clear();
}

void NewtonKrylov::begin(const std::vector<double>& x, const std::vector<double>& r) {
  has_base_ = true;
  base_x_ = x;
  base_r_ = r;
  halvings_ = 0;
  beta_ = space_.norm(r);
  const double ratio = last_beta_ > 0 ? beta_ / last_beta_ : 1;
  forcing_ = std::clamp(0.9 * ratio * ratio, smallest_forcing, largest_forcing);
  // No tighter than what the coupling's tolerance leaves to do.
  if (beta_ > 0) forcing_ = std::clamp(0.3 * aim_ / beta_, forcing_, largest_forcing);
  last_beta_ = beta_;
  h_.clear();
  q_.clear();
  if (beta_ == 0) return;
  qr_ = columns_.factorise();
  q_.push_back(r);
  scale(1 / beta_, q_.back());
  at_base_ = false;
}

std::vector<double> NewtonKrylov::precondition(const std::vector<double>& q) const {
  std::vector<double> p = q;
  scale(-mixing_, p);
  const std::vector<double> c = qr_.least_squares(q);
  for (std::size_t j = 0; j < c.size(); ++j) {
    axpy(c[j], columns_[j].w, p);
    axpy(mixing_ * c[j], columns_[j].v, p);
  }
  return p;
}

void NewtonKrylov::probe(std::vector<double>& x) {
  p_.push_back(precondition(q_.back()));
  const double length = space_.norm(p_.back());
  x = base_x_;
  axpy(-beta_ * std::min(1.0, probe_length / length), p_.back(), x);
}

void NewtonKrylov::keep(RestartArchive& archive) {
  columns_.keep(archive, "newton_krylov");
}

/// y = argmin |beta e_1 + H y|; returns the minimum. By Givens rotations, anew for each column: H is tiny.
double NewtonKrylov::minimise(std::vector<double>& y) const {
  const std::size_t m = h_.size();
  std::vector<std::vector<double>> h = h_;
  std::vector<double> g(m + 1, 0.0);
  g[0] = -beta_;
  for (std::size_t j = 0; j < m; ++j) {
    const double length = std::hypot(h[j][j], h[j][j + 1]);
    const double c = length > 0 ? h[j][j] / length : 1, s = length > 0 ? h[j][j + 1] / length : 0;
    for (std::size_t k = j; k < m; ++k) {
      const double upper = h[k][j], lower = h[k][j + 1];
      h[k][j] = c * upper + s * lower;
      h[k][j + 1] = -s * upper + c * lower;
    }
    g[j + 1] = -s * g[j];
    g[j] *= c;
  }
  y.assign(m, 0.0);
  for (std::size_t j = m; j-- > 0;) {
    double sum = g[j];
    for (std::size_t k = j + 1; k < m; ++k) sum -= h[k][j] * y[k];
    y[j] = h[j][j] != 0 ? sum / h[j][j] : 0;
  }
  return std::abs(g[m]);
}

}  // namespace fsi
