#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fsi {

/// What [output] asks for beyond the solution itself. Nothing of it is computed unless the case names it.
struct DerivedOutput {
  std::vector<std::string> surfaces;                       ///< each one row of surfaces.csv per step
  std::map<std::string, std::vector<std::string>> forces;  ///< [output.forces.NAME] surfaces: one row for them together
  bool statistics = false;                                 ///< of the wall shear stress over periods
  std::optional<double> period{};                          ///< ms, of the statistics
  bool error_indicator = false;                            ///< of the cells of both media
};

}  // namespace fsi
