#pragma once

#include <cstdint>

#include "case/fast_options.hpp"

namespace fsi {

/// Unknowns below which several processes have a system factorised by the first of them (CentralFactorisation): those
/// below which `fast` on one process factorises. None where the case has [petsc] options, which are for the iteration.
std::int64_t factorised_at_first_below(int dimension, const FastOptions& fast = {});

/// \param unknowns  of all processes
inline bool is_factorised_at_first(std::int64_t unknowns, int dimension, const FastOptions& fast = {}) {
  return unknowns < factorised_at_first_below(dimension, fast);
}

}  // namespace fsi
