#pragma once

#include <vector>

#include "mesh/axis.hpp"

namespace fsi {

/// Interpolation of a nodal field at one point: the sum of weights times the values at the nodes of a part.
struct NodalSample {
  std::vector<int> nodes;
  std::vector<double> weights;
};

/// The displacement along a direction at one point of the inner wall.
struct InnerWallSample {
  NodalSample at;   ///< of vectors
  Point direction;  ///< of space, unit length, away from the axis
};

/// Where the tables of a run look at the fields. Empty where a scene has no such line.
struct ObservationPoints {
  Axis axis;
  std::vector<double> centre_z;            ///< mm along the axis
  std::vector<NodalSample> centre_line;    ///< the fluid's scalars
  std::vector<double> wall_z;              ///< mm along the axis
  std::vector<InnerWallSample> wall_line;  ///< `angles` samples for each of wall_z
  int angles = 1;
};

}  // namespace fsi
