#include "partitioned/accelerators/filtered_qr.hpp"

#include <cmath>
#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

FilteredQr::FilteredQr(const std::vector<const std::vector<double>*>& columns, double filter,
                       const InterfaceSpace& space)
    : space_(space) {
  const std::vector<double> lengths = space_.norms(columns);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    std::vector<double> v = *columns[j];
    const double length = lengths[j];
    if (!(length > 0) || !std::isfinite(length)) continue;
    std::vector<double> r(q_.size() + 1, 0.0);
    for (int pass = 0; pass < 2; ++pass) {  // the second, where much cancels, makes Q orthogonal to rounding
      const std::vector<double> along = space_.subtract_projections(q_, v);
      for (std::size_t i = 0; i < q_.size(); ++i) r[i] += along[i];
      r.back() = space_.norm(v);
      if (r.back() > 0.1 * length) break;
    }
    if (!(r.back() > filter * length)) continue;
    scale(1 / r.back(), v);
    q_.push_back(std::move(v));
    r_.push_back(std::move(r));
    kept_.push_back(j);
  }
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
