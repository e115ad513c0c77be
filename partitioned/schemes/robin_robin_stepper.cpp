#include "partitioned/schemes/robin_robin_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/interface/robin_robin_parallel.hpp"
#include "partitioned/scheme_checks.hpp"
#include "partitioned/schemes/explicit_stepper.hpp"
#include "scene/time_scheme.hpp"

namespace fsi {

template <int n>
RobinRobinStepper<n>::RobinRobinStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                        const CouplingScheme& scheme)
    : RobinRobinStepper(scene, loads, setup, scheme, std::make_unique<RobinRobin<n>>(scene, setup.partitioned)) {
  require_for_loose(scheme, setup, scene);
  require_scheme_for_one_pass(scheme, setup, scene);
}

template <int n>
RobinRobinStepper<n>::RobinRobinStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                        const CouplingScheme& scheme, std::unique_ptr<RobinRobin<n>> problem)
    : Base(scene, loads, setup, scheme, std::move(problem)),
      problem_(static_cast<const RobinRobin<n>&>(Base::problem())),
      march_(scheme),
      before_(scheme) {
  const RobinCoefficient& alpha = problem_.coefficient();
  Base::add_choice({"partitioned.robin_coefficient", fmt::format("{:.4g} kPa/(mm/ms)", alpha.value), alpha.reason});
}

template <int n>
std::optional<CouplingMethod> RobinRobinStepper<n>::coupling_method() const {
  return one_pass_a_step();
}

template <int n>
void RobinRobinStepper<n>::keep(RestartArchive& archive) {
  Base::keep(archive);
  march_.keep(archive);
  Base::keep_jump(archive);
}

template <int n>
void RobinRobinStepper<n>::begin_step(const State&) {
  before_ = march_;
  Base::problem().iterate(iterates());
}

template <int n>
void RobinRobinStepper<n>::finish_stage(State&, const StepData&) {
  march_.add(Base::coupling().displacement_gap, problem_.movement());
  Base::problem().follow_wall();
}

template <int n>
double RobinRobinStepper<n>::size_of(const Pass& pass) const {
  std::vector<double> of_fluid = pass.displacement;  // in the first step it may move alone
  axpy(-1, pass.gap(), of_fluid);
  return std::max(Base::size_of(pass), Base::space().norm(of_fluid));
}

template <int n>
RobinRobinParallelStepper<n>::RobinRobinParallelStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                                        const CouplingScheme& scheme)
    : RobinRobinStepper<n>(scene, loads, setup, scheme,
                           std::make_unique<RobinRobinParallel<n>>(scene, setup.partitioned)) {
  require_for_loose(scheme, setup, scene);
  if (const std::string name = time_scheme_of(setup, scene); name != "euler")
    refuse_time_scheme(scheme, setup, name,
                       "each medium has the other's data of the last step alone, and the pressure rings",
                       "use \"euler\", or another coupling scheme: \"robin-robin\"");
  require_moving_start(scheme, setup, CouplingStepper<n>::first_order());
  require_scheme_for_one_pass(scheme, setup, scene);
}

#define FSI_INSTANTIATE(n)             \
  template class RobinRobinStepper<n>; \
  template class RobinRobinParallelStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
