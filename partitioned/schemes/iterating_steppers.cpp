#include "partitioned/schemes/iterating_steppers.hpp"

#include <utility>

#include "fem/dimensions.hpp"
#include "partitioned/interface/dirichlet_neumann.hpp"
#include "partitioned/scheme_checks.hpp"

namespace fsi {

template <int n>
DirichletNeumannStepper<n>::DirichletNeumannStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                                    const CouplingScheme& scheme)
    : CouplingStepper<n>(scene, loads, setup, scheme, std::make_unique<DirichletNeumann<n>>(scene, setup.partitioned)) {
  require_determined_pressure(scheme, setup, scene);
}

template <int n>
RobinNeumannStepper<n>::RobinNeumannStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                            const CouplingScheme& scheme)
    : RobinNeumannStepper(scene, loads, setup, scheme, std::make_unique<RobinNeumann<n>>(scene, setup.partitioned)) {}

template <int n>
RobinNeumannStepper<n>::RobinNeumannStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                            const CouplingScheme& scheme, std::unique_ptr<RobinNeumann<n>> problem)
    : CouplingStepper<n>(scene, loads, setup, scheme, std::move(problem)) {
  note_where_robin_neumann_is_slow(scheme, setup, scene);
}

#define FSI_INSTANTIATE(n)                   \
  template class DirichletNeumannStepper<n>; \
  template class RobinNeumannStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
