#include "partitioned/interface_space.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

#include "algebra/vector_operations.hpp"

namespace fsi {

double InterfaceSpace::own_dot(const std::vector<double>& x, const std::vector<double>& y) const {
  assert(x.size() == y.size() && own(x) <= x.size());
  if (is_whole()) return fsi::dot(x, y);
  return std::inner_product(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(own_), y.begin(), 0.0);
}

double InterfaceSpace::dot(const std::vector<double>& x, const std::vector<double>& y) const {
  return processes_->sum(own_dot(x, y));
}

double InterfaceSpace::norm(const std::vector<double>& x) const {
  return std::sqrt(dot(x, x));
}

std::vector<double> InterfaceSpace::norms(const std::vector<const std::vector<double>*>& vectors) const {
  std::vector<double> lengths;
  lengths.reserve(vectors.size());
  for (const auto* x : vectors) lengths.push_back(own_dot(*x, *x));
  processes_->sum(lengths);
  for (double& length : lengths) length = std::sqrt(length);
  return lengths;
}

std::vector<double> InterfaceSpace::dots(const std::vector<std::vector<double>>& q,
                                         const std::vector<double>& x) const {
  std::vector<double> products;
  products.reserve(q.size());
  for (const auto& column : q) products.push_back(own_dot(column, x));
  processes_->sum(products);
  return products;
}

std::vector<double> InterfaceSpace::subtract_projections(const std::vector<std::vector<double>>& q,
                                                         std::vector<double>& v) const {
  if (!is_whole()) {
    std::vector<double> along = dots(q, v);
    for (std::size_t i = 0; i < q.size(); ++i) axpy(-along[i], q[i], v);
    return along;
  }
  std::vector<double> along;
  along.reserve(q.size());
  for (const auto& column : q) {
    along.push_back(fsi::dot(column, v));
    axpy(-along.back(), column, v);
  }
  return along;
}

}  // namespace fsi
