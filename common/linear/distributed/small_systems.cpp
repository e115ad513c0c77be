#include "linear/distributed/small_systems.hpp"

#include "linear/distributed/petsc_options.hpp"

namespace fsi {

std::int64_t factorised_at_first_below(int dimension, const FastOptions& fast) {
  return has_petsc_options() ? 0 : fast.direct_below.value_or(FastOptions::standard_direct_below(dimension));
}

}  // namespace fsi
