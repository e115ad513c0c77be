#include "partitioned/accelerators/relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/vector_operations.hpp"

namespace fsi {

namespace {
constexpr double smallest_start = 1e-4;
}

void ConstantRelaxation::correct(std::vector<double>& x, const std::vector<double>& r) {
  axpy(factor_, r, x);
}

void AitkenRelaxation::start() {
  start_ = factor_;
  factor_ = std::clamp(std::abs(factor_), smallest_start, largest_start_);
  has_last_ = false;
}

void AitkenRelaxation::correct(std::vector<double>& x, const std::vector<double>& r) {
  if (has_last_) {
    double numerator = 0, denominator = 0;
    for (std::size_t i = 0; i < space_.own(r); ++i) {
      numerator += (x[i] - last_x_[i]) * (r[i] - last_r_[i]);
      denominator += (r[i] - last_r_[i]) * (r[i] - last_r_[i]);
    }
    std::array<double, 2> sums{numerator, denominator};
    space_.sum(sums.data(), sums.size());
    if (sums[1] > 0) factor_ = -sums[0] / sums[1];
  }
  has_last_ = true;
  last_x_ = x;
  last_r_ = r;
  axpy(factor_, r, x);
}

void AitkenRelaxation::keep(RestartArchive& archive) {
  archive.number_if_there("relaxation", factor_);
}

}  // namespace fsi
