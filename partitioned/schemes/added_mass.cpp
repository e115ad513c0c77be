#include "partitioned/schemes/added_mass.hpp"

#include <algorithm>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
double added_mass(const Scene<n>& scene, CouplingPass<n>& problem, const InterfaceSpace& space, int order,
                  const State& state, const StepData& data) {
  constexpr int passes = 5;           // modes are few and far apart: the longest wave's counts
  constexpr double amplitude = 1e-6;  // of the wall's thickness: the answer is linear
  constexpr PassAccuracy accuracy{1e-4, false};
  State rest = state;
  StepData push = data;
  push.wall_pressure = 0;
  push.opening_flows.clear();
  // What stands behind an opening without flow is taken off: the answer to the push alone counts.
  const auto push_all = [&](double pressure) {
    std::fill(push.opening_pressures.begin(), push.opening_pressures.end(), pressure);
    for (const auto& opening : scene.openings.answering())
      push.opening_pressures[opening.number] -=
          opening.law->pressure(push.rates.fluid_factor, push.rates.openings_reference.data() + opening.place, 0);
    const StepRates& rates = push.rates;
    scene.openings.joined().subtract_still_pressures(rates.fluid_factor, rates.time, rates.openings_reference,
                                                     push.opening_pressures);
  };
  const double at_rest = scene.initial_load ? scene.initial_load->pressure : 0.0;
  if (scene.initial_load)
    push.support_loads = scene.initial_load->support_loads;
  else
    std::fill(push.support_loads.begin(), push.support_loads.end(), 0.0);
  double growth = 0;
  try {
    // Pushed by one pressure at all openings the wall moves outward everywhere, as its supports allow.
    problem.start_from_prediction(rest, push, order);
    push_all(at_rest + amplitude * problem.pressure_of_thickness());
    std::vector<double> x = problem.first_guess(0);
    set_zero(x);
    Pass pass = problem.pass(x, accuracy);
    push_all(at_rest);
    for (int k = 0; k < passes; ++k) {
      const double before = space.norm(x), length = space.norm(pass.displacement);
      if (!(length > 0)) break;
      if (k > 0) growth = length / before;
      x = pass.displacement;
      if (k > 0) scale(before / length, x);
      pass = problem.pass(x, accuracy);
    }
  } catch (const PassFailure&) {
    growth = 0;
  }
  problem.cost = {};
  return growth;
}

#define FSI_INSTANTIATE(n)                                                                                   \
  template double added_mass<n>(const Scene<n>&, CouplingPass<n>&, const InterfaceSpace&, int, const State&, \
                                const StepData&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
