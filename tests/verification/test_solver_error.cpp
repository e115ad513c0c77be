// What a report says that solving a step left (StepReport::solver_error), against the same step solved to rounding.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "fem/elements.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "partitioned/registry.hpp"
#include "support/every_element.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::solver_error_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

/// The pulse ends after four steps. What is solved in three dimensions takes its time.
template <class Element>
constexpr int steps = Element::dim == 2 ? 12 : 6;

template <class Element>
auto artery_mesh() {
  ArteryShape shape;
  shape.length = 6;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.around = 8;
  cells.axial = Element::dim == 2 ? 20 : 8;
  const auto linear = [&] {
    if constexpr (Element::dim == 2)
      return generate_artery_section(shape, cells);
    else
      return generate_artery(shape, cells);
  }();
  if constexpr (Element::order == 1)
    return linear;
  else
    return with_mid_edge_nodes(linear);
}

Case artery_case(const std::string& scheme) {
  Case setup = coupled_case("neo-hookean", 1.0 / 32);
  setup.stabilisation = Stabilisation::projected;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.inlet = PressureTable{{{0, 1.332}, {0.125, 1.332}, {0.125, 0}}};
  setup.time->end = 12 * setup.time->step;
  setup.time->scheme = scheme;
  return setup;
}

/// The larger of the norms of a's and b's difference, of the velocity, the wall's displacement and the pressures of both,
/// each relative to what a step changes: half of what two steps do, which leaves out what alternates, but at most the
/// field itself and at least a hundredth of it (docs/theory.md, section 9.3).
template <int n>
double apart(const Scene<n>& scene, const Solution& a, const Solution& b, const Solution& before, int between) {
  double largest = 0;
  const auto look = [&](const std::vector<double>& volumes, std::vector<double> Solution::*field) {
    for (const bool scalar : {false, true}) {
      double error = 0, change = 0, size = 0;
      for (std::size_t i = 0; i < (a.*field).size(); ++i) {
        if ((static_cast<int>(i % (n + 1)) == n) != scalar) continue;
        const double volume = volumes[i / (n + 1)], x = (a.*field)[i], y = (b.*field)[i], old = (before.*field)[i];
        error += volume * (x - y) * (x - y);
        change += volume * (y - old) * (y - old) / (between * between);
        size += volume * y * y;
      }
      largest = std::max(largest, std::sqrt(error / std::max(std::min(change, size), 1e-4 * size)));
    }
  };
  look(scene.fluid->space().volumes(), &Solution::fluid);
  look(scene.wall->space().volumes(), &Solution::wall);
  return largest;
}

/// Largest of the steps of a run.
struct Errors {
  double said = 0, true_one = 0;
};

/// Takes each step of a run twice from the same levels: as `make` solves it, and to rounding. Steps of one stage: a
/// second stage begins with what the first one left, which is not its own.
template <class Element, class Make>
Errors errors_of_steps(const Case& setup, const Make& make) {
  constexpr int n = Element::components;
  const auto mesh = artery_mesh<Element>();
  const auto scene = build_scene<Element>(setup, mesh), other = build_scene<Element>(setup, mesh);
  const Loads loads(setup);
  const std::unique_ptr<Stepper> loose = make(*scene, loads);
  NewtonOptions tight;
  tight.tolerance = 1e-12;
  NewtonStepper<n> exact(*other, loads, tight, number_scene(*other));
  State state = scene->at_rest();
  Errors errors;
  for (int i = 0; i < steps<Element>; ++i) {
    const State start = state;
    const double said = loose->advance(state).solver_error;
    if (scene->integrator->stages(start) > 1) continue;
    State solved = start;
    exact.advance(solved);
    const bool two = start.balances_since_jump > 1;
    const double true_one = apart(*scene, state.last_balance(), solved.last_balance(),
                                  two ? start.balances[1] : start.last_balance(), two ? 2 : 1);
    errors.said = std::max(errors.said, said);
    errors.true_one = std::max(errors.true_one, true_one);
  }
  return errors;
}

void expect_right(const Errors& errors, const std::string& of, double tolerance) {
  EXPECT_GT(errors.said, errors.true_one / 3) << of << ", tolerance " << tolerance;
  EXPECT_LT(errors.said, errors.true_one * 3) << of << ", tolerance " << tolerance;
}

std::vector<std::string> schemes(int dim) {
  if (dim == 3) return {"euler", "midpoint"};
  return {"euler", "midpoint", "bdf2", "generalised-alpha"};
}

template <class Element>
class SolverError : public testing::Test {};
using Artery = testing::Types<P1Tetrahedron, P1AxisymmetricTriangle, P2P1Tetrahedron, P2P1AxisymmetricTriangle>;
TYPED_TEST_SUITE(SolverError, Artery, ElementNames);

TYPED_TEST(SolverError, OfNewtonsMethodIsRightWithinAFactorOfThree) {
  struct Solving {
    NewtonMode mode;
    double tolerance;
  };
  std::vector<Solving> solvings{{NewtonMode::kept, 1e-1}, {NewtonMode::kept, 1e-3}, {NewtonMode::full, 1e-1}};
  if (TypeParam::dim == 2) solvings.insert(solvings.end(), {{NewtonMode::kept, 1e-2}, {NewtonMode::kept, 1e-4}});
  for (const std::string& scheme : schemes(TypeParam::dim))
    for (const auto& [mode, tolerance] : solvings) {
      NewtonOptions options;
      options.mode = mode;
      options.tolerance = tolerance;
      const Errors errors = errors_of_steps<TypeParam>(artery_case(scheme), [&](auto& scene, const Loads& loads) {
        return std::make_unique<NewtonStepper<TypeParam::components>>(scene, loads, options, number_scene(scene));
      });
      expect_right(errors, scheme + ", " + newton_modes().name_of(mode), tolerance);
    }
}

// Methods without a memory of passes, aitken for one, say up to six times too much.
TYPED_TEST(SolverError, OfAQuasiNewtonCouplingIsRightWithinAFactorOfThree) {
  for (const std::string& scheme : schemes(TypeParam::dim))
    for (const char* coupling : {"robin-neumann-iqn", "iqn-ils"})
      for (const double tolerance : {1e-2, 1e-4}) {
        if (TypeParam::dim == 3 && (tolerance < 1e-2 || scheme != "midpoint")) continue;
        Case setup = artery_case(scheme);
        setup.partitioned.scheme = coupling;
        setup.partitioned.tolerance = tolerance;
        const Errors errors = errors_of_steps<TypeParam>(
            setup, [&](auto& scene, const Loads& loads) { return make_coupling_stepper(scene, loads, setup); });
        expect_right(errors, scheme + ", " + coupling, tolerance);
      }
}

}  // namespace

}  // namespace fsi::test::solver_error_tests
