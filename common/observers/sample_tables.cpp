#include "observers/sample_tables.hpp"

#include <array>
#include <utility>

#include "fem/dimensions.hpp"
#include "io/column.hpp"
#include "observers/observables.hpp"

namespace fsi {

namespace {

/// What to say where an earlier run has no such table.
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

/// A table of samples without names.
ResultTable begun(const char* file, const char* header, std::vector<Measure> measures) {
  ResultTable table{file, header};
  table.measures = std::move(measures);
  table.blanks = true;
  table.missing = no_samples;
  return table;
}

}  // namespace

template <int n>
SampleTables<n>::SampleTables(const RequestedSamples& samples, const Scene<n>& scene)
    : scene_(scene), samples_(samples) {
  add(points_file, samples_.points, false);
  add(lines_file, samples_.lines, true);
  if (samples_.planes.empty()) return;
  ResultTable table = begun(planes_file, "time_ms,plane,flow_mm3_per_ms,pressure_Pa,area_mm2",
                            {Measure::flow, Measure::pressure, Measure::area});
  for (const SampledPlane& plane : samples_.planes) table.names.push_back(plane.name);
  tables_.push_back(table);
}

template <int n>
void SampleTables<n>::add(const char* file, const std::vector<SampledPoint>& samples, bool along_line) {
  if (samples.empty()) return;
  ResultTable table = begun(
      file, along_line ? "time_ms,line,s_mm,x_mm,y_mm,z_mm,pressure_Pa" : "time_ms,point,x_mm,y_mm,z_mm,pressure_Pa",
      {Measure::pressure});
  if (scene_.fluid) {
    table.header += ",velocity_x_mm_per_ms,velocity_y_mm_per_ms,velocity_z_mm_per_ms";
    table.measures.insert(table.measures.end(), 3, Measure::velocity);
  }
  if (scene_.wall) {
    table.header += ",displacement_x_mm,displacement_y_mm,displacement_z_mm";
    table.measures.insert(table.measures.end(), 3, Measure::displacement);
  }
  for (const SampledPoint& sample : samples) {
    std::string place = sample.name;
    if (along_line) place += ',' + number_text(sample.s);
    for (const double x : sample.at) place += ',' + number_text(x);
    table.names.push_back(place);
  }
  tables_.push_back(table);
}

template <int n>
TableRow SampleTables<n>::row(const SampledPoint& sample, const State& level) const {
  using Mixed = MixedLayout<n>;
  const auto& medium = sample.in_fluid ? level.now.fluid : level.now.wall;
  TableRow row(1, 0.0);
  for (std::size_t a = 0; a < sample.scalars.nodes.size(); ++a)
    *row[0] += pascal_per_kilopascal * sample.scalars.weights[a] * medium[Mixed::scalar(sample.scalars.nodes[a])];
  if (scene_.fluid && !sample.in_fluid) row.resize(4);  // no velocity
  if (sample.in_fluid)
    for (const double u : vector_at<Mixed>(sample.vectors, medium, scene_.axes)) row.emplace_back(u);
  if (scene_.wall) {
    const auto moved = sample.in_fluid ? vector_at<VectorLayout<n>>(sample.vectors, level.now.mesh, scene_.axes)
                                       : vector_at<Mixed>(sample.vectors, medium, scene_.axes);
    for (const double d : moved) row.emplace_back(d);
  }
  return row;
}

template <int n>
std::vector<TableRow> SampleTables<n>::rows(const ResultTable& table, const State& level) const {
  std::vector<TableRow> rows;
  if (table.file == planes_file) {
    std::vector<const PlaneCut*> planes;
    for (const SampledPlane& plane : samples_.planes) planes.push_back(plane.cut.get());
    for (const PlaneRow& seen : look_at(planes, level.now.mesh, level.now.fluid, scene_.processes())) {
      rows.push_back({seen.flow, std::nullopt, seen.area});
      if (seen.area > 0) rows.back()[1] = pascal_per_kilopascal * seen.pressure;
    }
  } else {
    for (const SampledPoint& sample : table.file == points_file ? samples_.points : samples_.lines)
      rows.push_back(row(sample, level));
  }
  return rows;
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
