#pragma once

#include <string_view>

// linear.preconditioner: the preconditioners of `fast` for velocities and pressures, each a row of its name in case files
// and the function that makes it. The first is the default. A further one is a file in
// linear/velocity_pressure/preconditioners/ that defines its function, and its row here.
#define FSI_FLOW_PRECONDITIONERS(ROW)      \
  ROW("block-factors", make_block_factors) \
  ROW("simple", make_simple)

namespace fsi {

#define FSI_ROW(name, make) name,
inline constexpr std::string_view flow_preconditioner_list[] = {FSI_FLOW_PRECONDITIONERS(FSI_ROW)};
#undef FSI_ROW

}  // namespace fsi
