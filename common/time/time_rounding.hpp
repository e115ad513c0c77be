#pragma once

namespace fsi {

/// Relative tolerance within which two times of a run, or two step lengths, are the same: the rounding of summed steps.
inline constexpr double time_rounding = 1e-9;

}  // namespace fsi
