#include "driver/observables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "driver/same_state.hpp"
#include "fem/dimensions.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

template <int n>
Observables<n>::Observables(ObservationPoints points, const Scene<n>& scene)
    : scene_(scene), points_(std::move(points)), samples_(points_.requested, scene) {}

template <int n>
ResultTables Observables<n>::tables() const {
  ResultTables tables{!points_.centre_line.empty(), !points_.wall_line.empty(), scene_.fluid != nullptr};
  tables.sampled = samples_.tables();
  return tables;
}

template <int n>
typename Observables<n>::Seen Observables<n>::look(const State& level) const {
  using Mixed = MixedLayout<n>;
  Seen seen;
  seen.pressure = centre_line_part(level.now.fluid);
  if (scene_.fluid) {
    const auto *inlet = scene_.fluid->open_boundary(group::inlet), *outlet = scene_.fluid->open_boundary(group::outlet);
    const auto &mesh = level.now.mesh, &fluid = level.now.fluid;
    seen.flow = {inlet ? -inlet->outflow(mesh, fluid) : 0.0, outlet ? outlet->outflow(mesh, fluid) : 0.0,
                 inlet ? inlet->mean_pressure(mesh, fluid) : 0.0, outlet ? outlet->mean_pressure(mesh, fluid) : 0.0};
  }
  const AxisFrame frame(points_.wall_line.empty() ? Axis{} : points_.axis);  // of plane scenes there may be none
  const int angles = points_.angles;
  if (!points_.wall_line.empty()) {
    seen.radial.resize(points_.wall_z.size(), 0.0);
    seen.axial.resize(points_.wall_z.size(), 0.0);
  }
  for (std::size_t i = 0; i < points_.wall_line.size(); ++i) {
    const InnerWallSample& sample = points_.wall_line[i];
    for (std::size_t a = 0; a < sample.at.nodes.size(); ++a)
      for (int k = 0; k < n; ++k) {
        const double d = sample.at.weights[a] / angles * level.now.wall[Mixed::vector(sample.at.nodes[a], k)];
        seen.radial[i / angles] += d * sample.direction[scene_.axes[k]];
        seen.axial[i / angles] += d * frame.along[scene_.axes[k]];
      }
  }
  PartialSums sums;
  for (auto* values : {&seen.pressure, &seen.radial, &seen.axial}) sums.include(*values);
  seen.samples = samples_.rows(level, sums);
  sums.add_up(scene_.processes());
  return seen;
}

template <int n>
std::vector<double> Observables<n>::centre_line_part(const std::vector<double>& fluid) const {
  std::vector<double> pressure(points_.centre_line.size(), 0.0);
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    const NodalSample& sample = points_.centre_line[i];
    for (std::size_t a = 0; a < sample.nodes.size(); ++a)
      pressure[i] += sample.weights[a] * fluid[MixedLayout<n>::scalar(sample.nodes[a])];
  }
  return pressure;
}

template <int n>
std::vector<double> Observables<n>::centre_line_pressure(const std::vector<double>& fluid) const {
  std::vector<double> pressure = centre_line_part(fluid);
  scene_.processes().sum(pressure);
  return pressure;
}

template <int n>
void Observables<n>::write(const State& state, ResultFolder& folder) const {
  const Seen seen = look(state);
  if (!points_.centre_line.empty()) folder.write_centerline(state.time, points_.centre_z, seen.pressure);
  if (scene_.fluid) folder.write_flow(state.time, seen.flow);
  if (!points_.wall_line.empty()) folder.write_wall(state.time, points_.wall_z, seen.radial, seen.axial);
  for (std::size_t i = 0; i < seen.samples.size(); ++i)
    folder.write_sampled(samples_.tables()[i], state.time, seen.samples[i]);
}

template <int n>
void Observables<n>::require_same(const State& level, const EarlierTables& earlier) const {
  const Seen seen = look(level);
  using Columns = std::vector<std::pair<std::size_t, const std::vector<double>&>>;
  // Columns of one unit are compared by the largest number in any of them: the small ones may be rounding alone.
  const auto require = [&](const std::string& file, double apart, double size) {
    if (!(apart <= same_state * size))
      throw InputError((earlier.folder() / file).string(), "",
                       fmt::format("its rows of the time {:g} differ from the checkpoint's state by {:.1e} of their "
                                   "largest value: the two are not of one run",
                                   level.time, apart / size),
                       "restart from a folder as its run has left it, or run from the start");
  };
  const auto compare = [&](const ResultTable& table, std::size_t width, const Columns& columns) {
    const auto& rows = earlier.last_level(table.file);
    if (rows.empty()) return;
    double size = 0, apart = 0;
    for (const auto& [column, values] : columns)
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double row = rows.at(i * width + column);
        size = std::max({size, std::abs(row), std::abs(values[i])});
        apart = std::max(apart, std::abs(row - values[i]));
      }
    require(table.file, apart, size);
  };
  std::vector<double> pressure = seen.pressure;
  for (double& p : pressure) p *= pascal_per_kilopascal;
  const std::vector<double> in{seen.flow.inlet_flow}, out{seen.flow.outlet_flow};
  const std::vector<double> pressure_in{pascal_per_kilopascal * seen.flow.inlet_pressure};
  const std::vector<double> pressure_out{pascal_per_kilopascal * seen.flow.outlet_pressure};
  compare(centerline_table(), 3, {{2, pressure}});
  compare(wall_table(), 4, {{2, seen.radial}, {3, seen.axial}});
  compare(flow_table(), 5, {{1, in}, {2, out}});
  compare(flow_table(), 5, {{3, pressure_in}, {4, pressure_out}});
  for (std::size_t t = 0; t < seen.samples.size(); ++t) {
    const SampledTable& table = samples_.tables()[t];
    const auto& before = earlier.last_level(table.file);
    const auto& now = seen.samples[t];
    std::map<int, std::pair<double, double>> by_kind;  // how far apart, largest
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto& value = now.at(i / table.kinds.size()).at(i % table.kinds.size());
      auto& [apart, size] = by_kind[table.kinds[i % table.kinds.size()]];
      if (std::isnan(before[i]) != !value.has_value()) apart = HUGE_VAL;
      if (std::isnan(before[i]) || !value) continue;
      size = std::max({size, std::abs(before[i]), std::abs(*value)});
      apart = std::max(apart, std::abs(before[i] - *value));
    }
    for (const auto& [kind, found] : by_kind) require(table.file, found.first, found.second);
  }
}

#define FSI_INSTANTIATE(n) template class Observables<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
