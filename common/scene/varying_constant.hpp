#pragma once

#include <string>
#include <vector>

namespace fsi {

/// What a constant of a layer is where fields or regions let it vary: over the layer's quadrature points.
struct VaryingConstant {
  std::string layer;     ///< or the part that a region has cut out of it, LAYER/REGION
  std::string constant;  ///< its key in the case
  std::string unit;
  double smallest = 0, largest = 0;
  double mean = 0;                   ///< over the layer's volume
  std::vector<std::string> sources;  ///< names of the file and of the regions that say it
};

}  // namespace fsi
