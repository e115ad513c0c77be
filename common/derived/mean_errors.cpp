#include "derived/mean_errors.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace fsi {

void MeanErrors::add(double time, const CellErrors& errors) {
  if (!wants(time)) return;
  if (!begun_) {
    begun_ = true;
    start_ = time_ = time;
    integral_.assign(2 * errors.vectors.size(), 0.0);
    return;
  }
  assert(integral_.size() == 2 * errors.vectors.size());
  const double step = time - time_;
  for (std::size_t c = 0; c < errors.vectors.size(); ++c) {
    integral_[2 * c] += step * errors.vectors[c] * errors.vectors[c];
    integral_[2 * c + 1] += step * errors.pressure[c] * errors.pressure[c];
  }
  time_ = time;
}

CellErrors MeanErrors::mean(std::size_t cells) const {
  CellErrors errors{std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)};
  if (!(time_ > start_)) return errors;
  for (std::size_t c = 0; c < cells; ++c) {
    errors.vectors[c] = std::sqrt(integral_[2 * c] / (time_ - start_));
    errors.pressure[c] = std::sqrt(integral_[2 * c + 1] / (time_ - start_));
  }
  return errors;
}

void MeanErrors::keep(RestartArchive& archive, ArrayKind kind) {
  if (!archive.recalls() && !begun_) return;
  if (!archive.wants({"times", "integral"})) {
    archive.warn("the mean of the error indicator begins anew: the earlier run had none");
    return;
  }
  std::vector<double> times{start_, time_};
  archive.array("times", ArrayKind::alike, times, {times.size()});
  archive.array("integral", kind, integral_);
  begun_ = true;
  start_ = times[0];
  time_ = times[1];
}

}  // namespace fsi
