#include "partitioned/registry.hpp"

#include <array>
#include <memory>
#include <string_view>

#include "base/error.hpp"
#include "base/names.hpp"
#include "fem/dimensions.hpp"
#include "partitioned/accelerators/makers.hpp"
#include "partitioned/block_newton/block_newton_stepper.hpp"
#include "partitioned/scheme_checks.hpp"
#include "partitioned/scheme_choice.hpp"
#include "partitioned/schemes/explicit_stepper.hpp"
#include "partitioned/schemes/inexact_stepper.hpp"
#include "partitioned/schemes/iterating_steppers.hpp"
#include "partitioned/schemes/robin_robin_corrected_stepper.hpp"
#include "partitioned/schemes/robin_robin_stepper.hpp"
#include "partitioned/schemes/semi_implicit_stepper.hpp"

namespace fsi {

namespace {

using namespace accelerators;

template <int n>
using Make = std::unique_ptr<Stepper> (*)(Scene<n>&, const Loads&, const Case&, const CouplingScheme&);

template <class Made, int n>
std::unique_ptr<Stepper> make(Scene<n>& scene, const Loads& loads, const Case& setup, const CouplingScheme& scheme) {
  return std::make_unique<Made>(scene, loads, setup, scheme);
}

/// The class that makes steps in the plane and in space.
struct Maker {
  Make<2> in_plane;
  Make<3> in_space;
};
template <template <int> class Made>
constexpr Maker by{make<Made<2>, 2>, make<Made<3>, 3>};

struct Row {
  CouplingScheme scheme;
  Maker make;
};

constexpr auto other = "a larger partitioned.max_iterations, a smaller time.step, or the monolithic driver";
constexpr auto loose = "a smaller time.step, or a scheme that iterates: partitioned.scheme = \"block-newton\"";
constexpr auto none = nullptr;
constexpr std::array<Row, 15> rows{{
    {{"aitken", aitken, "partitioned.scheme = \"iqn-ils\", or a larger partitioned.max_iterations", option::of_passes},
     by<DirichletNeumannStepper>},
    {{"block-newton", none, "a smaller time.step or load, or the monolithic driver", option::of_differences},
     by<BlockNewtonStepper>},
    {{"constant", constant, "partitioned.scheme = \"iqn-ils\", or a smaller partitioned.relaxation", option::of_passes},
     by<DirichletNeumannStepper>},
    {{"explicit", constant,
      "a scheme that iterates: partitioned.scheme = \"iqn-ils\"; one pass a step is unstable where the fluid's added "
      "mass exceeds the wall's",
      option::of_passes | option::velocity_gap},
     by<ExplicitStepper>},
    {{"iqn-ils", iqn_ils, other, option::of_passes | option::of_differences}, by<DirichletNeumannStepper>},
    {{"iqn-imvj", iqn_imvj, other, option::of_passes | option::of_differences}, by<DirichletNeumannStepper>},
    {{"newton-krylov", newton_krylov, other, option::of_passes | option::of_differences}, by<DirichletNeumannStepper>},
    {{"robin-neumann", robin, "partitioned.scheme = \"robin-neumann-iqn\", or a smaller time.step", option::of_passes},
     by<RobinNeumannStepper>},
    {{"robin-neumann-inexact", regularised,
      "a smaller time.step, partitioned.scheme = \"block-newton\", which needs both media's Jacobians, or the "
      "monolithic driver",
      option::relaxation | option::force_tolerance | option::columns},
     by<InexactStepper>},
    {{"robin-neumann-iqn", robin_iqn, other, option::of_passes | option::of_differences}, by<RobinNeumannStepper>},
    {{"robin-neumann-imvj", robin_imvj, other, option::of_passes | option::of_differences}, by<RobinNeumannStepper>},
    {{"robin-robin", robin_iqn, loose, option::of_passes | option::of_differences | option::robin_coefficient},
     by<RobinRobinStepper>},
    {{"robin-robin-corrected", robin_iqn, loose,
      option::of_passes | option::of_differences | option::robin_coefficient},
     by<RobinRobinCorrectedStepper>},
    {{"robin-robin-parallel", robin_iqn, loose, option::of_passes | option::of_differences | option::robin_coefficient},
     by<RobinRobinParallelStepper>},
    {{"semi-implicit", robin_iqn, other, option::of_passes | option::of_differences}, by<SemiImplicitStepper>},
}};

constexpr bool names_are_those_of_cases() {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].scheme.name != coupling_scheme_list[i]) return false;
  return rows.size() == coupling_scheme_list.size();
}
static_assert(names_are_those_of_cases(), "case/choices.hpp owns these names");

const Row& row_of(const std::string& name) {
  for (const Row& row : rows)
    if (row.scheme.name == name) return row;
  refuse_name("partitioned.scheme", name, coupling_scheme_names());
}

}  // namespace

const CouplingScheme& coupling_scheme(const std::string& name) {
  return row_of(name).scheme;
}

template <int n>
std::unique_ptr<Stepper> make_coupling_stepper(Scene<n>& scene, const Loads& loads, const Case& setup) {
  const Row& row = row_of(chosen_scheme(setup, scene).name);
  note_foreign_options(row.scheme, setup, scene.notices);
  if constexpr (n == 2)
    return row.make.in_plane(scene, loads, setup, row.scheme);
  else
    return row.make.in_space(scene, loads, setup, row.scheme);
}

#define FSI_INSTANTIATE(n) \
  template std::unique_ptr<Stepper> make_coupling_stepper<n>(Scene<n>&, const Loads&, const Case&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
