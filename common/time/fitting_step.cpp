#include "time/fitting_step.hpp"

#include <cmath>

#include "time/time_rounding.hpp"

namespace fsi {

double fitting_step(double period, double step) {
  constexpr double shortest = 0.8;  // of the step
  const double least = std::ceil(period / step * (1 - time_rounding));
  for (double scale = 1; scale <= 1e3; scale *= 10)
    for (double count = least; count * step <= period / shortest; ++count) {
      const double digits = period / count / std::pow(10.0, std::floor(std::log10(step))) * scale;
      if (std::abs(digits - std::round(digits)) < 1e-9 * digits) return period / count;
    }
  return period / least;
}

}  // namespace fsi
