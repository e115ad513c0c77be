#pragma once

#include <string>
#include <vector>

namespace fsi {

/// Refuses numbers that are not finite, so that none reaches a result. They come from parameters out of all proportion,
/// where a square or an exponential overflows.
/// \param what  the quantity and the step, "step 3 (to t = 0.375 ms): the wall's displacement or pressure"
/// \throws ConvergenceError
void require_finite(const std::vector<double>& numbers, const std::string& what);

}  // namespace fsi
