#include "observers/sample_tables.hpp"

#include <array>
#include <utility>

#include "fem/dimensions.hpp"
#include "io/column.hpp"
#include "observers/observables.hpp"

namespace fsi {

namespace {

/// Message where an earlier run has no such table.
const ResultTable::Missing no_samples{"output", "its samples are wanted, but the earlier run wrote none",
                                      "continue without them, or run from the start"};

/// Interpolated vectors as vectors of space.
template <class Layout, std::size_t n>
std::array<double, 3> vector_at(const NodalSample& sample, const std::vector<double>& field,
                                const std::array<int, n>& axes) {
  std::array<double, 3> sum{0, 0, 0};
  for (std::size_t a = 0; a < sample.nodes.size(); ++a)
    for (std::size_t k = 0; k < n; ++k)
      sum[axes[k]] += sample.weights[a] * field[Layout::vector(sample.nodes[a], static_cast<int>(k))];
  return sum;
}

/// Numbers of a sample at a level.
struct SampleReading {
  bool in_fluid = false;
  double pressure = 0;                               // Pa
  std::array<double, 3> velocity{}, displacement{};  // mm/ms, mm
};

bool is_in_fluid(const SampleReading& reading) {
  return reading.in_fluid;
}

/// Columns in a scene with these media; samples in the wall have no velocity.
Columns<SampleReading> sample_columns(bool fluid, bool wall) {
  using Reading = const SampleReading&;
  Columns<SampleReading> columns{{"pressure_Pa", [](Reading r) { return r.pressure; }, Measure::pressure}};
  if (fluid)
    columns.insert(columns.end(),
                   {{"velocity_x_mm_per_ms", [](Reading r) { return r.velocity[0]; }, Measure::velocity, is_in_fluid},
                    {"velocity_y_mm_per_ms", [](Reading r) { return r.velocity[1]; }, Measure::velocity, is_in_fluid},
                    {"velocity_z_mm_per_ms", [](Reading r) { return r.velocity[2]; }, Measure::velocity, is_in_fluid}});
  if (wall)
    columns.insert(columns.end(),
                   {{"displacement_x_mm", [](Reading r) { return r.displacement[0]; }, Measure::displacement},
                    {"displacement_y_mm", [](Reading r) { return r.displacement[1]; }, Measure::displacement},
                    {"displacement_z_mm", [](Reading r) { return r.displacement[2]; }, Measure::displacement}});
  return columns;
}

/// Where a plane cuts nothing there is no pressure.
const Columns<PlaneRow>& plane_columns() {
  using Seen = const PlaneRow&;
  static const Columns<PlaneRow> columns{{"flow_mm3_per_ms", [](Seen p) { return p.flow; }, Measure::flow},
                                         {"pressure_Pa", [](Seen p) { return pascal_per_kilopascal * p.pressure; },
                                          Measure::pressure, [](Seen p) { return p.area > 0; }},
                                         {"area_mm2", [](Seen p) { return p.area; }, Measure::area}};
  return columns;
}

}  // namespace

template <int n>
SampleTables<n>::SampleTables(const RequestedSamples& samples, const Scene<n>& scene)
    : scene_(scene), samples_(samples) {
  add(points_file, samples_.points, false);
  add(lines_file, samples_.lines, true);
  if (samples_.planes.empty()) return;
  std::vector<std::string> names;
  for (const SampledPlane& plane : samples_.planes) names.push_back(plane.name);
  add(table_of(planes_file, plane_columns(), RowsPer::level, "plane", std::move(names)));
}

template <int n>
void SampleTables<n>::add(ResultTable table) {
  table.missing = no_samples;
  tables_.push_back(std::move(table));
}

template <int n>
void SampleTables<n>::add(const char* file, const std::vector<SampledPoint>& samples, bool along_line) {
  if (samples.empty()) return;
  std::vector<std::string> names;
  for (const SampledPoint& sample : samples) {
    std::string place = sample.name;
    if (along_line) place += ',' + number_text(sample.s);
    for (const double x : sample.at) place += ',' + number_text(x);
    names.push_back(place);
  }
  add(table_of(file, sample_columns(scene_.fluid != nullptr, scene_.wall != nullptr), RowsPer::level,
               along_line ? "line,s_mm,x_mm,y_mm,z_mm" : "point,x_mm,y_mm,z_mm", std::move(names)));
}

namespace {

/// This process's part of a reading: samples have weights of its own nodes alone.
template <int n>
SampleReading reading_of(const SampledPoint& sample, const State& level, const Scene<n>& scene) {
  using Mixed = MixedLayout<n>;
  const auto& medium = sample.in_fluid ? level.now.fluid : level.now.wall;
  SampleReading reading;
  reading.in_fluid = sample.in_fluid;
  for (std::size_t a = 0; a < sample.scalars.nodes.size(); ++a)
    reading.pressure +=
        pascal_per_kilopascal * sample.scalars.weights[a] * medium[Mixed::scalar(sample.scalars.nodes[a])];
  if (sample.in_fluid) reading.velocity = vector_at<Mixed>(sample.vectors, medium, scene.axes);
  if (scene.wall)
    reading.displacement = sample.in_fluid ? vector_at<VectorLayout<n>>(sample.vectors, level.now.mesh, scene.axes)
                                           : vector_at<Mixed>(sample.vectors, medium, scene.axes);
  return reading;
}

}  // namespace

template <int n>
std::vector<TableRow> SampleTables<n>::rows(const ResultTable& table, const State& level) const {
  if (table.file == planes_file) {
    std::vector<const PlaneCut*> planes;
    for (const SampledPlane& plane : samples_.planes) planes.push_back(plane.cut.get());
    const auto seen = look_at(planes, level.now.mesh, level.now.fluid, scene_.processes());
    return rows_of(table.file, {}, plane_columns(), seen).rows;
  }
  std::vector<SampleReading> readings;
  for (const SampledPoint& sample : table.file == points_file ? samples_.points : samples_.lines)
    readings.push_back(reading_of(sample, level, scene_));
  return rows_of(table.file, {}, sample_columns(scene_.fluid != nullptr, scene_.wall != nullptr), readings).rows;
}

template <int n>
std::vector<std::vector<TableRow>> SampleTables<n>::rows(const State& level, PartialSums& sums) const {
  std::vector<std::vector<TableRow>> all;
  for (const ResultTable& table : tables_) {
    all.push_back(rows(table, level));
    if (table.file == planes_file) continue;  // whole already
    for (TableRow& row : all.back())
      for (auto& value : row)
        if (value) sums.include(*value);
  }
  return all;
}

#define FSI_INSTANTIATE(n) template class SampleTables<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
