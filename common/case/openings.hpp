#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

/// What happens at one surface through which fluid may pass.
struct OpeningData {
  std::string surface;                    ///< name of the facet group
  std::optional<PressureTable> pressure;  ///< on the fluid from outside; none: free of traction
};

/// The open boundaries of a case with fluid, in the order in which scenes and loads hold them.
inline std::vector<OpeningData> openings_of(const Case& setup) {
  if (!setup.fluid) return {};
  std::vector<OpeningData> openings{{group::inlet, setup.inlet}};
  if (setup.fluid->outlet) openings.push_back({group::outlet, std::nullopt});
  return openings;
}

}  // namespace fsi
