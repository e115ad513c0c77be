#include "system/given_flows.hpp"

#include <cmath>
#include <numeric>

#include "fem/dimensions.hpp"
#include "scene/wave_speed.hpp"

namespace fsi {

template <int n>
GivenFlows<n>::GivenFlows(const Scene<n>& scene) : scene_(&scene) {
  for (const auto& opening : scene.openings.driven()) {
    const auto& normals = opening.surface->normals();
    const double square = std::inner_product(normals.begin(), normals.end(), normals.begin(), 0.0);
    flows_.push_back({&opening, std::sqrt(scene.processes().sum(square)), opening.surface->area(), 0});
  }
  if (flows_.empty()) return;
  const double speed = wave_speed(scene);
  stiffness_ = scene.fluid->form().density * speed * speed / scene.fluid->volume();
}

template <int n>
double GivenFlows<n>::compare(const State& state, const StepData& data) {
  double forces = 0;
  for (std::size_t i = 0; i < flows_.size(); ++i) {
    Flow& flow = flows_[i];
    const double end = data.opening_flows.empty() ? 0.0 : -data.opening_flows[flow.opening->number];
    flow.gap = flow.opening->surface->relative_outflow(scene_->fluid_input(state, data.rates)) -
               Openings<n>::given_outflow(*flow.opening, state.before[0].openings, end, data.rates.carry);
    const double force = force_of_gap(i, data.rates.fluid_factor) * flow.gap;
    forces += force * force;
  }
  return forces;
}

template <int n>
double GivenFlows<n>::force_of_gap(std::size_t i, double fluid_factor) const {
  const AleFluid& form = scene_->fluid->form();
  const double area = flows_[i].area;
  const double pressure = (form.density * fluid_factor + form.viscosity / area) / std::sqrt(area) +
                          (fluid_factor > 0 ? stiffness_ / fluid_factor : 0);
  return flows_[i].normal * pressure;
}

#define FSI_INSTANTIATE(n) template class GivenFlows<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
