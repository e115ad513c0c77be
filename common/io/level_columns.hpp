#pragma once

#include "io/column.hpp"
#include "io/surface_record.hpp"

namespace fsi {

/// What centerline_pressure.csv says of a point at a level.
struct CentrePoint {
  double z = 0;         ///< mm, reference coordinate
  double pressure = 0;  ///< kPa; written in Pa
};

/// What wall_displacement.csv says of a position along the inner wall at a level: means over the circumference.
struct WallPoint {
  double z = 0;       ///< mm, reference coordinate
  double radial = 0;  ///< mm
  double axial = 0;   ///< mm
};

/// What flow.csv says of a level. Flow is positive from inlet to outlet; pressures are means over the face.
struct FlowRecord {
  double inlet_flow = 0;       ///< mm^3/ms, into the fluid
  double outlet_flow = 0;      ///< mm^3/ms, out of the fluid
  double inlet_pressure = 0;   ///< kPa; written in Pa
  double outlet_pressure = 0;  ///< kPa; written in Pa
};

/// What openings.csv says of an opening at a level.
struct OpeningRecord {
  double flow = 0;                 ///< mm^3/ms, out of the fluid
  double mean_pressure = 0;        ///< of the fluid, over the surface, kPa; written in Pa
  double windkessel_pressure = 0;  ///< stored; behind a resistance the distal pressure, else 0; kPa; written in Pa
};

/// Columns of the tables of levels, behind time and, where rows have names, the name.
const Columns<CentrePoint>& centreline_columns();
const Columns<WallPoint>& wall_columns();
const Columns<FlowRecord>& flow_columns();
const Columns<OpeningRecord>& opening_columns();
/// Of surfaces.csv, whose times lie within the steps.
const Columns<SurfaceRecord>& surface_columns();

}  // namespace fsi
