#include "partitioned/schemes/richardson_stepper.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/schemes/added_mass.hpp"

namespace fsi {

template <int n>
RichardsonStepper<n>::RichardsonStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                        const CouplingScheme& scheme)
    : Base(scene, loads, setup, scheme, std::make_unique<Richardson<n>>(scene, setup.partitioned), 2),
      file_(setup.path.string()),
      named_(setup.partitioned.relaxation.has_value()),
      passes_(static_cast<Richardson<n>&>(Base::problem())) {}

template <int n>
std::optional<CouplingMethod> RichardsonStepper<n>::coupling_method() const {
  return CouplingMethod{"interface",
                        "a step is one pass, fluid and wall each solved by itself, of which a part alpha is taken; "
                        "nothing iterated"};
}

template <int n>
void RichardsonStepper<n>::keep(Memory& memory) {
  Base::keep(memory);
  if (named_) return;
  double alpha = passes_.alpha();
  memory.number_if_there("richardson_alpha", alpha, {0, 1});
  passes_.set_alpha(alpha);
}

template <int n>
void RichardsonStepper<n>::begin_stage(const State& state, const StepData& data) {
  if (passes_.alpha() > 0) return;
  if (state.step > 0)
    throw InputError(
        file_, "partitioned.relaxation",
        fmt::format("left out, where \"{}\" goes on from a run of another scheme: alpha is measured at rest "
                    "alone",
                    Base::scheme().name),
        "give it: \"explicit\" says in its log what the added mass is over the wall's answer, G, and "
        "1/(1 + G) serves");
  const double ratio = added_mass(Base::scene(), Base::problem(), Base::space(), Base::first_order(), state, data);
  passes_.set_alpha(1 / (1 + ratio));
  Base::report_.history.push_back(
      fmt::format("added mass over the wall's answer: {:.3g}; alpha {:.4g}", ratio, passes_.alpha()));
}

template <int n>
void RichardsonStepper<n>::judge_pass(const State& state, const StepData& data) {
  CouplingReport taken = Base::coupling();
  taken.displacement_gap *= passes_.alpha();
  taken.displacement_residual *= passes_.alpha();
  Base::march().check(state.step + 1, data.time, taken, Base::problem().movement());
}

template <int n>
void RichardsonStepper<n>::finish_stage(State& state, const StepData& data) {
  Base::problem().follow_wall();
  Base::scene().impose_interface(state, data.rates);  // the fluid's velocity there, too
}

#define FSI_INSTANTIATE(n) template class RichardsonStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
