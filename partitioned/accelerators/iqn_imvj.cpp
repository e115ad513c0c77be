#include "partitioned/accelerators/iqn_imvj.hpp"

#include <utility>

#include "algebra/vector_operations.hpp"
#include "partitioned/accelerators/filtered_qr.hpp"

namespace fsi {

namespace {

std::vector<const std::vector<double>*> pointers(const std::vector<std::vector<double>>& columns) {
  std::vector<const std::vector<double>*> list;
  for (const auto& column : columns) list.push_back(&column);
  return list;
}

}  // namespace

void IqnImvj::start() {
  v_.clear();
  a_.clear();
  has_last_ = false;
  status_ = {};
}

std::vector<double> IqnImvj::old_jacobian_times(const std::vector<double>& r) const {
  std::vector<double> product = jacobian_.times(r);
  axpy(1 - options_.mixing, r, product);
  return product;
}

void IqnImvj::add_difference(const std::vector<double>& x, const std::vector<double>& r) {
  if (has_last_) {
    std::vector<double> v = r, a = x;
    axpy(-1, last_r_, v);
    axpy(-1, last_x_, a);
    axpy(1, v, a);  // w
    axpy(-1, old_jacobian_times(v), a);
    v_.insert(v_.begin(), std::move(v));
    a_.insert(a_.begin(), std::move(a));
  }
  has_last_ = true;
  last_x_ = x;
  last_r_ = r;
}

void IqnImvj::correct(std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  const FilteredQr qr(pointers(v_), options_.filter, space_);
  status_ = {0, static_cast<int>(jacobian_.rank() + qr.kept().size())};
  if (status_.columns == 0) {
    axpy(options_.relaxation, r, x);
    status_.relaxation = options_.relaxation;
    return;
  }
  const std::vector<double> c = qr.least_squares(r);
  axpy(1, r, x);
  axpy(-1, old_jacobian_times(r), x);
  for (std::size_t j = 0; j < c.size(); ++j) axpy(-c[j], a_[qr.kept()[j]], x);
}

void IqnImvj::accept(const std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  const FilteredQr qr(pointers(v_), options_.filter, space_);
  auto rows = qr.pseudo_inverse();
  for (std::size_t j = 0; j < rows.size(); ++j) jacobian_.add(std::move(a_[qr.kept()[j]]), std::move(rows[j]));
  if (jacobian_.rank() > static_cast<std::size_t>(options_.columns))
    jacobian_.truncate(static_cast<std::size_t>(options_.columns + 1) / 2, LowRankMap::truncation);
}

void IqnImvj::keep(RestartArchive& archive) {
  jacobian_.keep(archive, "iqn_imvj");
}

}  // namespace fsi
