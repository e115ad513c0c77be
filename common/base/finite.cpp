#include "base/finite.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace fsi {

void require_finite(const std::vector<double>& numbers, const std::string& what) {
  if (std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) return;
  throw ConvergenceError(what + " is not finite",
                         "a smaller time.step or load, and look for a parameter that is out of proportion");
}

}  // namespace fsi
