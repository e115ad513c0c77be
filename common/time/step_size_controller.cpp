#include "time/step_size_controller.hpp"

#include <algorithm>
#include <cmath>

#include "time/time_rounding.hpp"

namespace fsi {

namespace {

constexpr double safety = 0.9, growth = 2, shrinkage = 0.2;
constexpr double least_change = 0.95;    // downwards
constexpr double rungs = 4;              // to an octave
constexpr double negligible = 1e-10;     // smaller errors, over the allowed one, count as this
constexpr double of_failed_step = 0.25;  // what is left of the length of a step without solution

}  // namespace

StepSizeController::StepSizeController(const StepLimits& limits, int order)
    : limits_(limits), order_(order), wanted_(limits.first) {}

double StepSizeController::rung(double length) const {
  const double number = std::floor(rungs * std::log2(length / limits_.first) + time_rounding);
  return std::clamp(limits_.first * std::exp2(number / rungs), limits_.smallest, limits_.largest);
}

void StepSizeController::restart() {
  wanted_ = std::min(wanted_, limits_.first);
  error_before_ = 0;
}

void StepSizeController::accept(double) {
  held_ = false;
}

void StepSizeController::accept(double length, double error) {
  error = std::max(error, negligible);
  // What the step before would have had at this length.
  const double before =
      error_before_ > 0 ? std::max(error_before_ * std::pow(length / length_before_, order_), negligible) : error;
  error_before_ = error;
  length_before_ = length;
  const bool may_grow = !held_;
  held_ = false;
  if (length < 0.5 * wanted_) return;  // cut to end at a stop: it says nothing about the length wanted
  const double factor = safety * std::pow(error * before, -0.5 / order_);
  const double next = rung(std::clamp(factor, shrinkage, growth) * length);
  // Two rungs up are worth another Jacobian.
  if ((may_grow && next > wanted_ * std::exp2(1.5 / rungs)) || (factor < least_change && next < wanted_))
    wanted_ = next;
}

bool StepSizeController::reject(double length, double error) {
  if (length <= limits_.smallest * (1 + time_rounding)) return false;
  const double factor = std::clamp(safety * std::pow(error, -1.0 / order_), shrinkage, 0.8);
  wanted_ = rung(factor * length);
  held_ = true;
  return true;
}

void StepSizeController::fail(double length) {
  wanted_ = of_failed_step * length;  // also below the smallest: this is no matter of accuracy
  held_ = true;
}

void StepSizeController::keep(RestartArchive& archive) {
  std::vector<double> numbers{wanted_, error_before_, length_before_};
  archive.array("controller", ArrayKind::alike, numbers, {3});
  wanted_ = archive.recalls() ? std::min(numbers[0], limits_.largest) : wanted_;
  error_before_ = numbers[1];
  length_before_ = numbers[2];
}

}  // namespace fsi
