#include "driver/observables.hpp"

#include <utility>

#include "fem/dimensions.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

template <int n>
Observables<n>::Observables(ObservationPoints points, const Scene<n>& scene)
    : scene_(scene), points_(std::move(points)) {}

template <int n>
ResultTables Observables<n>::tables() const {
  return {!points_.centre_line.empty(), !points_.wall_line.empty(), scene_.fluid != nullptr};
}

template <int n>
void Observables<n>::write(const State& state, ResultFolder& folder) const {
  using Mixed = MixedLayout<n>;
  if (!points_.centre_line.empty()) {
    std::vector<double> pressure(points_.centre_line.size(), 0.0);
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const NodalSample& sample = points_.centre_line[i];
      for (std::size_t a = 0; a < sample.nodes.size(); ++a)
        pressure[i] += sample.weights[a] * state.now.fluid[Mixed::scalar(sample.nodes[a])];
    }
    folder.write_centerline(state.time, points_.centre_z, pressure);
  }
  if (scene_.fluid) {
    const auto *inlet = scene_.fluid->open_boundary(group::inlet), *outlet = scene_.fluid->open_boundary(group::outlet);
    const auto& fluid = state.now.fluid;
    folder.write_flow(state.time,
                      {inlet ? -inlet->outflow(fluid) : 0.0, outlet ? outlet->outflow(fluid) : 0.0,
                       inlet ? inlet->mean_pressure(fluid) : 0.0, outlet ? outlet->mean_pressure(fluid) : 0.0});
  }
  if (!points_.wall_line.empty()) {
    const AxisFrame frame(points_.axis);
    const int angles = points_.angles;
    std::vector<double> radial(points_.wall_z.size(), 0.0), axial(points_.wall_z.size(), 0.0);
    for (std::size_t i = 0; i < points_.wall_line.size(); ++i) {
      const InnerWallSample& sample = points_.wall_line[i];
      for (std::size_t a = 0; a < sample.at.nodes.size(); ++a)
        for (int k = 0; k < n; ++k) {
          const double d = sample.at.weights[a] / angles * state.now.wall[Mixed::vector(sample.at.nodes[a], k)];
          radial[i / angles] += d * sample.direction[scene_.axes[k]];
          axial[i / angles] += d * frame.along[scene_.axes[k]];
        }
    }
    folder.write_wall(state.time, points_.wall_z, radial, axial);
  }
}

#define FSI_INSTANTIATE(n) template class Observables<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
