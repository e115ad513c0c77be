#include "partitioned/accelerators/iqn_ils.hpp"

#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

void IqnIls::start() {
  has_last_ = false;
  status_ = {};
  columns_.start();
  if (before_.rank() > 0 && ++before_age_ > most_before) before_.clear();
}

void IqnIls::change(bool longer) {
  before_age_ = 0;
  if (longer) {  // the wall's stiffness, which they know too little of, then weighs more
    before_.clear();
    columns_.clear();
    return;
  }
  const FilteredQr& qr = columns_.factorise();
  auto rows = qr.pseudo_inverse();
  std::vector<std::vector<double>> left;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    left.push_back(columns_[j].w);
    axpy(-(1 - options_.mixing), columns_[j].v, left.back());
    axpy(-1, before_.times(columns_[j].v), left.back());
  }
  for (std::size_t j = 0; j < rows.size(); ++j) before_.add(std::move(left[j]), std::move(rows[j]));
  const auto most = static_cast<std::size_t>(options_.columns);
  if (before_.rank() > most) before_.truncate((most + 1) / 2, LowRankMap::truncation);
  columns_.clear();
}

void IqnIls::add_difference(const std::vector<double>& x, const std::vector<double>& r) {
  if (has_last_) {
    std::vector<double> v = r, w = x;
    axpy(-1, last_r_, v);
    axpy(-1, last_x_, w);
    axpy(1, v, w);
    columns_.add(std::move(v), std::move(w));
  }
  has_last_ = true;
  last_x_ = x;
  last_r_ = r;
}

void IqnIls::correct(std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  const FilteredQr& qr = columns_.factorise();
  if (columns_.empty() && before_.rank() == 0) {
    axpy(options_.relaxation, r, x);
    status_ = {options_.relaxation, 0};
    return;
  }
  const std::vector<double> c = qr.least_squares(r);  // of |V c - r|: the signs are turned here
  axpy(options_.mixing, r, x);
  for (std::size_t j = 0; j < c.size(); ++j) {
    axpy(-c[j], columns_[j].w, x);
    axpy((1 - options_.mixing) * c[j], columns_[j].v, x);
  }
  status_ = {0, static_cast<int>(columns_.size() + before_.rank())};
  if (before_.rank() == 0) return;
  std::vector<double> unexplained = r;
  for (std::size_t j = 0; j < c.size(); ++j) axpy(-c[j], columns_[j].v, unexplained);
  axpy(-1, before_.times(unexplained), x);
}

void IqnIls::accept(const std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  columns_.finish();
}

void IqnIls::keep(RestartArchive& archive) {
  columns_.keep(archive, "iqn_ils");
  before_.keep(archive, "iqn_ils.before");
  archive.count_if_there("iqn_ils.before.age", before_age_);
}

}  // namespace fsi
