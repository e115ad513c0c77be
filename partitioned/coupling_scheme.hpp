#pragma once

#include <memory>
#include <string_view>

#include "case/case.hpp"
#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/interface_space.hpp"

namespace fsi {

/// Options of [partitioned] that not all schemes have a use for.
namespace option {
inline constexpr unsigned relaxation = 1, columns = 2, filter = 4, gap_demands = 8, force_tolerance = 16,
                          velocity_gap = 32, robin_coefficient = 64;
/// Options of schemes that iterate until fluid and wall agree; options of quasi-Newton methods, whose columns are
/// differences of passes.
inline constexpr unsigned of_passes = relaxation | gap_demands | force_tolerance, of_differences = columns | filter;
}  // namespace option

/// What registry.cpp says of a scheme beside its class.
struct CouplingScheme {
  std::string_view name;  ///< partitioned.scheme, one of coupling_scheme_names()
  /// How passes are accelerated. Null: the scheme is no CouplingStepper.
  std::unique_ptr<Accelerator> (*make_accelerator)(const PartitionedData& options, const InterfaceSpace& space);
  const char* advice;  ///< what helps when it does not converge
  unsigned options;    ///< bits of `option` that have an effect
};

}  // namespace fsi
