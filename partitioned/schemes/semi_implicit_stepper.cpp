#include "partitioned/schemes/semi_implicit_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/interface/semi_implicit.hpp"

namespace fsi {

template <int n>
SemiImplicitStepper<n>::SemiImplicitStepper(Scene<n>& scene, const Loads& loads, const Case& setup,
                                            const CouplingScheme& scheme)
    : Base(scene, loads, setup, scheme, std::make_unique<SemiImplicit<n>>(scene, setup.partitioned)) {
  if (setup.time) return;
  throw InputError(
      setup.path.string(), "partitioned.scheme",
      fmt::format("\"{}\" extrapolates the fluid's domain in time, and a static case has none", scheme.name),
      "use \"block-newton\"");
}

template <int n>
std::string SemiImplicitStepper<n>::unchecked() const {
  const double part = gap_ / Base::problem().radius();
  if (!(part > small)) return {};
  return fmt::format(
      "the {} coupling extrapolates the fluid's domain, which has missed the wall by {:.2g} of the vessel's radius "
      "(root mean square over the interface, more than {:g}); take a smaller time.step, or compare with "
      "partitioned.scheme = \"block-newton\"",
      Base::scheme().name, part, small);
}

template <int n>
void SemiImplicitStepper<n>::keep(RestartArchive& archive) {
  Base::keep(archive);
  archive.number_if_there("domain_gap", gap_);
}

template <int n>
void SemiImplicitStepper<n>::finish_stage(State&, const StepData&) {
  gap_ = std::max(gap_, Base::coupling().domain_gap);
}

#define FSI_INSTANTIATE(n) template class SemiImplicitStepper<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
