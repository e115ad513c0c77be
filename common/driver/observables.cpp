#include "driver/observables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "driver/same_rows.hpp"
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
  if (!points_.centre_line.empty()) folder.write_centerline(state.time, centre_points(seen));
  if (scene_.fluid) folder.write_flow(state.time, seen.flow);
  if (!points_.wall_line.empty()) folder.write_wall(state.time, wall_points(seen));
  for (std::size_t i = 0; i < seen.samples.size(); ++i)
    folder.write_sampled(samples_.tables()[i], state.time, seen.samples[i]);
}

template <int n>
std::vector<CentrePoint> Observables<n>::centre_points(const Seen& seen) const {
  std::vector<CentrePoint> found;
  for (std::size_t i = 0; i < seen.pressure.size(); ++i) found.push_back({points_.centre_z[i], seen.pressure[i]});
  return found;
}

template <int n>
std::vector<WallPoint> Observables<n>::wall_points(const Seen& seen) const {
  std::vector<WallPoint> found;
  for (std::size_t i = 0; i < seen.radial.size(); ++i)
    found.push_back({points_.wall_z[i], seen.radial[i], seen.axial[i]});
  return found;
}

template <int n>
void Observables<n>::require_same(const State& level, const EarlierTables& earlier) const {
  const Seen seen = look(level);
  require_same_rows(earlier, centerline_table().file, level.time, centreline_columns(), centre_points(seen));
  require_same_rows(earlier, wall_table().file, level.time, wall_columns(), wall_points(seen));
  require_same_rows(earlier, flow_table().file, level.time, flow_columns(), std::vector<FlowRecord>{seen.flow});
  for (std::size_t t = 0; t < seen.samples.size(); ++t) {
    const SampledTable& table = samples_.tables()[t];
    const auto& before = earlier.last_level(table.file);
    const auto& now = seen.samples[t];
    std::map<int, Agreement> by_kind;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto& value = now.at(i / table.kinds.size()).at(i % table.kinds.size());
      auto& found = by_kind[table.kinds[i % table.kinds.size()]];
      if (std::isnan(before[i]) != !value.has_value())
        found.differ();
      else if (value)
        found.include(before[i], *value);
    }
    for (const auto& [kind, found] : by_kind) require_agreement(earlier, table.file, level.time, found);
  }
}

#define FSI_INSTANTIATE(n) template class Observables<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
