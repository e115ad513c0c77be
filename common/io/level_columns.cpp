#include "io/level_columns.hpp"

namespace fsi {

const Columns<CentrePoint>& centreline_columns() {
  using R = CentrePoint;
  static const Columns<R> columns{
      {"z_mm", [](const R& r) { return r.z; }},
      {"pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.pressure; }, Measure::pressure}};
  return columns;
}

const Columns<WallPoint>& wall_columns() {
  using R = WallPoint;
  static const Columns<R> columns{{"z_mm", [](const R& r) { return r.z; }},
                                  {"radial_mm", [](const R& r) { return r.radial; }, Measure::displacement},
                                  {"axial_mm", [](const R& r) { return r.axial; }, Measure::displacement}};
  return columns;
}

const Columns<FlowRecord>& flow_columns() {
  using R = FlowRecord;
  static const Columns<R> columns{
      {"inlet_flow_mm3_per_ms", [](const R& r) { return r.inlet_flow; }, Measure::flow},
      {"outlet_flow_mm3_per_ms", [](const R& r) { return r.outlet_flow; }, Measure::flow},
      {"inlet_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.inlet_pressure; }, Measure::pressure},
      {"outlet_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.outlet_pressure; }, Measure::pressure}};
  return columns;
}

const Columns<OpeningRecord>& opening_columns() {
  using R = OpeningRecord;
  static const Columns<R> columns{
      {"flow_mm3_per_ms", [](const R& r) { return r.flow; }, Measure::flow},
      {"mean_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.mean_pressure; }, Measure::pressure},
      {"windkessel_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.windkessel_pressure; },
       Measure::pressure}};
  return columns;
}

const Columns<SurfaceRecord>& surface_columns() {
  using R = SurfaceRecord;
  static const Columns<R> columns{{"area_mm2", [](const R& r) { return r.area; }},
                                  {"force_x_mN", [](const R& r) { return r.force[0]; }},
                                  {"force_y_mN", [](const R& r) { return r.force[1]; }},
                                  {"force_z_mN", [](const R& r) { return r.force[2]; }},
                                  {"pressure_force_x_mN", [](const R& r) { return r.pressure[0]; }},
                                  {"pressure_force_y_mN", [](const R& r) { return r.pressure[1]; }},
                                  {"pressure_force_z_mN", [](const R& r) { return r.pressure[2]; }},
                                  {"viscous_force_x_mN", [](const R& r) { return r.force[0] - r.pressure[0]; }},
                                  {"viscous_force_y_mN", [](const R& r) { return r.force[1] - r.pressure[1]; }},
                                  {"viscous_force_z_mN", [](const R& r) { return r.force[2] - r.pressure[2]; }}};
  return columns;
}

}  // namespace fsi
