#include "partitioned/iqn_ils.hpp"

#include <utility>

#include "algebra/vector_operations.hpp"
#include "partitioned/filtered_qr.hpp"

namespace fsi {

void IqnIls::start() {
  last_x_.clear();
  status_ = {};
  for (Column& column : columns_) ++column.age;
  while (!columns_.empty() && columns_.back().age > options_.reused_steps) columns_.pop_back();
}

void IqnIls::add_difference(const std::vector<double>& x, const std::vector<double>& r) {
  if (!last_x_.empty()) {
    Column column{r, x, 0};
    axpy(-1, last_r_, column.v);
    axpy(-1, last_x_, column.w);
    axpy(1, column.v, column.w);
    columns_.insert(columns_.begin(), std::move(column));
    if (columns_.size() > static_cast<std::size_t>(options_.columns)) columns_.pop_back();
  }
  last_x_ = x;
  last_r_ = r;
}

void IqnIls::correct(std::vector<double>& x, const std::vector<double>& r) {
  add_difference(x, r);
  std::vector<const std::vector<double>*> v;
  for (const Column& column : columns_) v.push_back(&column.v);
  const FilteredQr qr(v, options_.filter);
  std::vector<Column> kept;
  for (const std::size_t j : qr.kept()) kept.push_back(std::move(columns_[j]));
  columns_ = std::move(kept);
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
  std::vector<double>&v = memory.arrays["iqn_ils.v"], &w = memory.arrays["iqn_ils.w"],
  &age = memory.arrays["iqn_ils.age"];
  for (const Column& column : columns_) {
    v.insert(v.end(), column.v.begin(), column.v.end());
    w.insert(w.end(), column.w.begin(), column.w.end());
    age.push_back(column.age);
  }
}

void IqnIls::recall(const Memory& memory) {
  const auto v = memory.arrays.find("iqn_ils.v"), w = memory.arrays.find("iqn_ils.w"),
             age = memory.arrays.find("iqn_ils.age");
  columns_.clear();
  if (age == memory.arrays.end() || age->second.empty()) return;
  const auto size = static_cast<std::ptrdiff_t>(v->second.size() / age->second.size());
  for (std::size_t j = 0; j < age->second.size(); ++j) {
    const auto from = static_cast<std::ptrdiff_t>(j) * size;
    columns_.push_back({{v->second.begin() + from, v->second.begin() + from + size},
                        {w->second.begin() + from, w->second.begin() + from + size},
                        static_cast<int>(age->second[j])});
  }
}

}  // namespace fsi
