#pragma once

namespace fsi {

/// What programs of different compilers may make of one state, relative to its largest value.
inline constexpr double same_state = 1e-6;

}  // namespace fsi
