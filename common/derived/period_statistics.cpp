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

std::map<std::string, std::vector<double>> PeriodStatistics::memory() const {
  std::map<std::string, std::vector<double>> memory;
  if (!begun_) return memory;
  memory["times"] = {period_, time_, periods_, start_, until_};
  memory["now"] = now_;
  memory["integral"] = integral_;
  memory["magnitude"] = magnitude_;
  if (!last_) return memory;
  memory["mean"] = last_->mean;
  memory["oscillation"] = last_->oscillation;
  memory["residence"] = last_->residence;
  return memory;
}

bool PeriodStatistics::recall(const std::map<std::string, std::vector<double>>& memory, std::size_t nodes) {
  const auto has = [&](const char* name, std::size_t size) {
    const auto found = memory.find(name);
    return found != memory.end() && found->second.size() == size;
  };
  if (!has("times", 5) || !has("now", 3 * nodes) || !has("integral", 3 * nodes) || !has("magnitude", nodes))
    return false;
  const auto& times = memory.at("times");
  if (times[0] != period_) return false;
  const bool whole = has("mean", nodes) && has("oscillation", nodes) && has("residence", nodes);
  if (!whole && memory.count("mean") != 0) return false;
  begun_ = true;
  time_ = times[1];
  periods_ = times[2];
  start_ = times[3];
  until_ = times[4];
  now_ = memory.at("now");
  integral_ = memory.at("integral");
  magnitude_ = memory.at("magnitude");
  if (whole) last_ = {memory.at("mean"), memory.at("oscillation"), memory.at("residence")};
  return true;
}

}  // namespace fsi
