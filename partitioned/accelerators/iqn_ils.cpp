#include "partitioned/accelerators/iqn_ils.hpp"

#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

void IqnIls::start() {
  last_x_.clear();
  status_ = {};
  columns_.start();
}

void IqnIls::add_difference(const std::vector<double>& x, const std::vector<double>& r) {
  if (!last_x_.empty()) {
    std::vector<double> v = r, w = x;
    axpy(-1, last_r_, v);
    axpy(-1, last_x_, w);
    axpy(1, v, w);
    columns_.add(std::move(v), std::move(w));
  }
  last_x_ = x;
  last_r_ = r;
}

void IqnIls::correct(std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  const FilteredQr qr = columns_.factorise();
  if (columns_.empty()) {
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
  status_ = {0, static_cast<int>(columns_.size())};
}

void IqnIls::accept(const std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
}

void IqnIls::remember(Memory& memory) const {
  columns_.remember(memory, "iqn_ils");
}

void IqnIls::recall(const Memory& memory) {
  columns_.recall(memory, "iqn_ils");
}

}  // namespace fsi
