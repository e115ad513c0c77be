#include "partitioned/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/names.hpp"

namespace fsi {

namespace {
constexpr double default_factor = 0.01;  // below the coarse artery's limit of about 0.014
}

void ConstantRelaxation::correct(std::vector<double>& d, const std::vector<double>& r) {
  for (std::size_t i = 0; i < d.size(); ++i) d[i] += factor_ * r[i];
}

void AitkenRelaxation::start() {
  factor_ = std::clamp(std::abs(factor_), 1e-4, largest_start);
  last_.clear();
}

void AitkenRelaxation::correct(std::vector<double>& d, const std::vector<double>& r) {
  if (!last_.empty()) {
    double numerator = 0, denominator = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      numerator += last_[i] * (r[i] - last_[i]);
      denominator += (r[i] - last_[i]) * (r[i] - last_[i]);
    }
    if (denominator > 0) factor_ *= -numerator / denominator;
  }
  last_ = r;
  for (std::size_t i = 0; i < d.size(); ++i) d[i] += factor_ * r[i];
}

std::unique_ptr<Relaxation> make_relaxation(const std::string& scheme, double factor) {
  const double first = factor > 0 ? factor : default_factor;
  if (scheme == "constant") return std::make_unique<ConstantRelaxation>(first);
  if (scheme == "aitken") return std::make_unique<AitkenRelaxation>(first);
  const std::vector<std::string> known{"constant", "aitken"};
  throw InputError("", "partitioned.scheme", "unknown scheme \"" + scheme + "\"", "use " + one_of(known));
}

}  // namespace fsi
