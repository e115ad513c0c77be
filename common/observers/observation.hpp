#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/axis.hpp"
#include "sampling/plane_cut.hpp"

namespace fsi {

/// Interpolation of a nodal field at one point: the sum of weights times the values at the nodes of a part. Processes
/// that share the part have the entries of their own nodes each, and the value is the sum over the processes.
struct NodalSample {
  std::vector<int> nodes;
  std::vector<double> weights;
};

/// The displacement along a direction at one point of the inner wall.
struct InnerWallSample {
  NodalSample at;   ///< of vectors
  Point direction;  ///< of space, unit length, away from the axis
};

/// A point in the fluid or in the wall at which a case asks for fields.
struct SampledPoint {
  std::string name;  ///< of the point or its line
  double s = 0;      ///< mm, along the line from its beginning
  Point at;          ///< reference coordinates, mm
  bool in_fluid;     ///< else in the wall
  NodalSample vectors, scalars;
};

/// A plane at which a case asks for flow and pressure.
struct SampledPlane {
  std::string name;
  std::shared_ptr<const PlaneCut> cut;
};

/// Samples that a case asks for by name, in the order of the names, without points that lie in no cell.
struct RequestedSamples {
  std::vector<SampledPoint> points, lines;
  std::vector<SampledPlane> planes;
};

/// Where the tables of a run sample the fields. Lines are empty where a scene has none.
struct ObservationPoints {
  Axis axis;
  std::vector<double> centre_z;            ///< mm along the axis
  std::vector<NodalSample> centre_line;    ///< the fluid's scalars
  std::vector<double> wall_z;              ///< mm along the axis
  std::vector<InnerWallSample> wall_line;  ///< `angles` samples for each of wall_z
  int angles = 1;
  RequestedSamples requested;
  std::vector<std::string> notes;     ///< what was decided here, for the log
  std::vector<std::string> warnings;  ///< samples left out, a line each
};

}  // namespace fsi
