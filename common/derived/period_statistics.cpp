#include "derived/period_statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "time/time_rounding.hpp"

namespace fsi {

namespace {

double size_of(const std::vector<double>& vectors, std::size_t node) {
  return std::hypot(vectors[3 * node], vectors[3 * node + 1], vectors[3 * node + 2]);
}

}  // namespace

void PeriodStatistics::add(double time, const std::vector<double>& shear) {
  if (!begun_) {
    begun_ = true;
    time_ = start_ = time;
    periods_ = std::floor(time / period_ * (1 + time_rounding));
    now_ = shear;
    integral_.assign(shear.size(), 0.0);
    magnitude_.assign(shear.size() / 3, 0.0);
    return;
  }
  if (time <= time_) return;
  assert(shear.size() == now_.size());
  // Ends of periods within the step, or where it ends.
  for (double end = (periods_ + 1) * period_; end <= time * (1 + time_rounding); end = (periods_ + 1) * period_) {
    const double part = std::min(1.0, (end - time_) / (time - time_));
    std::vector<double> between = shear;
    if (part < 1 - time_rounding)
      for (std::size_t i = 0; i < between.size(); ++i) between[i] = now_[i] + part * (shear[i] - now_[i]);
    const double stop = part < 1 - time_rounding ? end : time;
    accumulate(stop - time_, now_, between);
    now_ = std::move(between);
    time_ = stop;
    finish(end);
    if (stop == time) break;
  }
  if (time > time_) accumulate(time - time_, now_, shear);
  now_ = shear;
  time_ = time;
}

void PeriodStatistics::accumulate(double duration, const std::vector<double>& from, const std::vector<double>& to) {
  for (std::size_t i = 0; i < integral_.size(); ++i) integral_[i] += 0.5 * duration * (from[i] + to[i]);
  for (std::size_t a = 0; a < magnitude_.size(); ++a)
    magnitude_[a] += 0.5 * duration * (size_of(from, a) + size_of(to, a));
}

void PeriodStatistics::finish(double time) {
  const bool whole = time - start_ >= period_ * (1 - time_rounding);
  if (whole) {
    const std::size_t nodes = magnitude_.size();
    ShearStatistics found{std::vector<double>(nodes), std::vector<double>(nodes), std::vector<double>(nodes)};
    for (std::size_t a = 0; a < nodes; ++a) {
      const double mean = magnitude_[a] / period_, net = size_of(integral_, a) / period_;
      found.mean[a] = mean;
      found.oscillation[a] = mean > 0 ? std::clamp(0.5 * (1 - net / mean), 0.0, 0.5) : 0;
      found.residence[a] = mean > 0 ? 1 / std::max(net, smallest_mean * mean) : 0;
    }
    last_ = std::move(found);
    until_ = time;
  }
  ++periods_;
  start_ = time;
  std::fill(integral_.begin(), integral_.end(), 0.0);
  std::fill(magnitude_.begin(), magnitude_.end(), 0.0);
}

void PeriodStatistics::keep(RestartArchive& archive) {
  if (!archive.recalls() && !begun_) return;
  std::vector<double> times{period_, time_, periods_, start_, until_};
  const bool kept = archive.wants({"times", "now", "integral", "magnitude"});
  if (kept) archive.array("times", ArrayKind::alike, times, {times.size()});
  if (!kept || times[0] != period_)
    return archive.warn("the statistics begin anew: the earlier run had none of this period");
  begun_ = true;
  time_ = times[1];
  periods_ = times[2];
  start_ = times[3];
  until_ = times[4];
  archive.array("now", ArrayKind::shear_vectors, now_);
  archive.array("integral", ArrayKind::shear_vectors, integral_);
  archive.array("magnitude", ArrayKind::shear_scalars, magnitude_);
  if (archive.recalls() ? !archive.wants({"mean", "oscillation", "residence"}) : !last_) return;
  if (archive.recalls()) last_.emplace();
  archive.array("mean", ArrayKind::shear_scalars, last_->mean);
  archive.array("oscillation", ArrayKind::shear_scalars, last_->oscillation);
  archive.array("residence", ArrayKind::shear_scalars, last_->residence);
}

}  // namespace fsi
