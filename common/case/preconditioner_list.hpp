#pragma once

#include <string_view>

// linear.preconditioner: the preconditioners of `fast` for velocities and pressures. A row has the name in case files
// and the function that makes it; the first is the default. To add one: a file in
// linear/velocity_pressure/preconditioners/ that defines its function, and a row here.
#define FSI_FLOW_PRECONDITIONERS(ROW)      \
  ROW("block-factors", make_block_factors) \
  ROW("simple", make_simple)

namespace fsi {

#define FSI_ROW(name, make) name,
inline constexpr std::string_view flow_preconditioner_list[] = {FSI_FLOW_PRECONDITIONERS(FSI_ROW)};
#undef FSI_ROW

}  // namespace fsi
