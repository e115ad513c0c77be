#pragma once

namespace fsi {

/// Times of a run that are this part of themselves, or of a step, apart are one time: what adding up steps leaves.
inline constexpr double time_rounding = 1e-9;

}  // namespace fsi
