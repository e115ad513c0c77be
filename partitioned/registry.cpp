#include "partitioned/registry.hpp"

#include <array>
#include <string_view>

#include "base/names.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/block_newton/block_newton_stepper.hpp"
#include "partitioned/coupling_stepper.hpp"
#include "partitioned/inexact_stepper.hpp"
#include "partitioned/scheme_checks.hpp"
#include "partitioned/scheme_choice.hpp"

namespace fsi {

namespace {

template <int n>
using Make = std::unique_ptr<Stepper> (*)(Scene<n>&, const Loads&, const Case&);

template <class Made, int n>
std::unique_ptr<Stepper> make(Scene<n>& scene, const Loads& loads, const Case& setup) {
  return std::make_unique<Made>(scene, loads, setup);
}

/// A scheme with a stepper of its own; all others are rows of schemes.cpp for CouplingStepper.
struct OwnStepper {
  std::string_view scheme;
  Make<2> in_plane;
  Make<3> in_space;
};

constexpr std::array<OwnStepper, 2> own_steppers{{
    {"block-newton", make<BlockNewtonStepper<2>, 2>, make<BlockNewtonStepper<3>, 3>},
    {"robin-neumann-inexact", make<InexactStepper<2>, 2>, make<InexactStepper<3>, 3>},
}};

}  // namespace

template <int n>
std::unique_ptr<Stepper> make_coupling_stepper(Scene<n>& scene, const Loads& loads, const Case& setup) {
  const SchemeChoice choice = chosen_scheme(setup, scene);
  note_foreign_options(choice.name, setup, scene.notices);
  for (const OwnStepper& own : own_steppers) {
    if (own.scheme != choice.name) continue;
    if constexpr (n == 2)
      return own.in_plane(scene, loads, setup);
    else
      return own.in_space(scene, loads, setup);
  }
  return std::make_unique<CouplingStepper<n>>(scene, loads, setup);
}

#define FSI_INSTANTIATE(n) \
  template std::unique_ptr<Stepper> make_coupling_stepper<n>(Scene<n>&, const Loads&, const Case&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
