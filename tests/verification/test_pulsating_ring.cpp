// The pulsating ring of docs/theory.md, section 13.2: an exact solution of fluid, wall and moving mesh together at
// finite strain. Computations are held against the ring as the same time scheme steps it, so that their error is that
// of space alone: but for what the error of a step owes to the mesh, whose vertices are off the harmonic motion by h^2. So
// steps are short with quadratic elements. Fluid is compared where its mesh is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/build_scene.hpp"
#include "support/errors.hpp"
#include "support/pulsating_ring.hpp"
#include "support/ring_meshes.hpp"
#include "support/scene_errors.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test::pulsating_ring_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

struct Pulse {
  double pressure;  ///< kPa
  double off;       ///< ms
};
constexpr Pulse pulses[] = {{0.10, 2}, {0.20, 1}};  // of the table's two rows
constexpr double table_times[] = {0.5, 1, 2, 3, 4, 6, 8, 12};
constexpr double table[2][8] = {
    {1.436427264, 1.454763790, 1.516247993, 1.562332206, 1.548498129, 1.398794775, 1.355349637, 1.541284940},
    {1.442857548, 1.479624609, 1.555236155, 1.569089891, 1.514690561, 1.349390123, 1.412109766, 1.479952453}};

TEST(PulsatingRing, OrdinaryDifferentialEquationReproducesTheTable) {
  for (int row = 0; row < 2; ++row) {
    const PulsatingRing ring{tubes()[row]};
    for (int i = 0; i < 8; ++i) {
      const auto at = ring_motion(ring, pulses[row].pressure, pulses[row].off, table_times[i], 0.004);
      EXPECT_NEAR(at.a, table[row][i], 0.51e-9) << ring.tube.name << " at " << table_times[i] << " ms";
      if (table_times[i] != 3) continue;
      const auto finer = ring_motion(ring, pulses[row].pressure, pulses[row].off, 3, 0.002);
      EXPECT_NEAR(at.a, finer.a, 1e-12);
    }
  }
}

TEST(PulsatingRing, StepsConvergeToTheDifferentialEquationAtFirstOrder) {
  for (int row = 0; row < 2; ++row) {
    const PulsatingRing ring{tubes()[row]};
    const auto exact = ring_motion(ring, pulses[row].pressure, pulses[row].off, 3, 0.004);
    ConvergenceTable errors(ring.tube.name, {"a at 3 ms, mm", "u at the wall, mm/ms"});
    for (int steps : {48, 96, 192}) {
      SteppedRing stepped(ring, 3.0 / steps);
      for (int i = 0; i < steps; ++i) stepped.advance(3.0 * i / steps < pulses[row].off ? pulses[row].pressure : 0.0);
      errors.add(3.0 / steps, {std::abs(stepped.inner_radius_now() - exact.a),
                               std::abs(stepped.velocity(inner_radius) - exact.q / exact.a)});
    }
    errors.print();
    EXPECT_NEAR(errors.last_order(0), 1, 0.1);
    EXPECT_NEAR(errors.last_order(1), 1, 0.1);
  }
}

/// Marches the ring on a mesh. Returns the relative L2 errors at the end: the wall's displacement and pressure, the
/// fluid's velocity and pressure.
template <class Element>
std::vector<double> ring_errors(int material, const RingCells& cells, double height, double step, int steps,
                                LayerPressure pressures = LayerPressure::separate) {
  constexpr int n = Element::components;
  const PulsatingRing ring{tubes()[material]};
  const Pulse pulse = pulses[material == 0 ? 0 : 1];
  const auto mesh = ring_mesh<Element>(cells, ring.porous_radius, height);
  static constexpr const char* names[] = {"neo-hookean", "mooney-rivlin", "artery"};
  Case setup = coupled_case(names[material], step);
  setup.fluid->outlet = false;
  setup.structure->bulk_modulus = 1e9;             // compression would show: p/kappa is 1e-6 at the artery's
  setup.stabilisation = Stabilisation::projected;  // of linear elements
  setup.structure->layer_pressure = pressures;
  setup.inlet = PressureTable{{{0, pulse.pressure}, {pulse.off, pulse.pressure}, {pulse.off, 0}}};
  setup.time->end = step * steps;
  const auto scene = build_scene<Element>(setup, mesh);
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-9;
  NewtonStepper<n> stepper(*scene, loads, options, number_scene(*scene));
  State state = scene->at_rest();
  SteppedRing exact(ring, step);
  for (int i = 1; i <= steps; ++i) {
    exact.advance(loads.opening_pressures(i)[0]);
    stepper.advance(state);
  }

  RelativeError d, wall_p, u, fluid_p;
  const auto radius = [](const Point& x) { return Element::axisymmetric ? x[0] : std::hypot(x[0], x[1]); };
  const auto radial = [&](const Point& x, double value) {
    const double r = radius(x);
    return Point{value * x[0] / r, Element::axisymmetric ? 0 : value * x[1] / r, 0};
  };
  const PolynomialFit fluid_pressure(ring.porous_radius, inner_radius, 24,
                                     [&](double r) { return exact.fluid_pressure(r); });
  add_errors<Element>(
      dynamic_cast<const FluidProblem<Element>&>(*scene->fluid).part(), mesh.region_index("fluid"), state.now.fluid,
      [&](const Point& x) { return radial(x, exact.velocity(exact.reference_radius(radius(x)))); },
      [&](const Point& x) { return fluid_pressure(exact.reference_radius(radius(x))); }, u, fluid_p, &state.now.mesh);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const auto& data = ring.tube.layers[layer];
    const PolynomialFit pressure(data.inner, data.outer, 12, [&](double r) { return exact.wall_pressure(layer, r); });
    add_errors<Element>(
        dynamic_cast<const WallProblem<Element>&>(*scene->wall).part(), mesh.region_index(data.name), state.now.wall,
        [&](const Point& x) { return radial(x, exact.displacement(radius(x))); },
        [&](const Point& x) { return pressure(radius(x)); }, d, wall_p);
  }
  return {d.value(), wall_p.value(), u.value(), fluid_p.value()};
}

/// Errors on meshes with the cells multiplied by each of some numbers.
template <class Element>
ConvergenceTable ring_table(const std::string& title, int material, const std::vector<int>& multiples,
                            const RingCells& cells, double height, double step, int steps,
                            LayerPressure pressures = LayerPressure::separate) {
  ConvergenceTable errors(std::string(tubes()[material].name) + ", " + title,
                          {"d, wall", "p, wall", "u, fluid", "p, fluid"});
  for (int m : multiples)
    errors.add(1.0 / m,
               ring_errors<Element>(material, {m * cells.fluid, m * cells.media, m * cells.adventitia, m * cells.along},
                                    Element::dim == 3 ? height / m : height, step, steps, pressures));
  errors.print();
  return errors;
}

/// At least: with few fluid cells their error, which reaches the wall through a and is of fourth order, prevails there.
void expect_taylor_hood_orders(const ConvergenceTable& errors, double displacement_error) {
  EXPECT_GT(errors.last_order(0), 2.85);
  EXPECT_GT(errors.last_order(1), 1.9);
  EXPECT_GT(errors.last_order(2), 2.85);
  EXPECT_GT(errors.last_order(3), 1.9);
  EXPECT_LT(errors.last_error(0), displacement_error);
}

class PulsatingRingScene : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Materials, PulsatingRingScene, testing::Values(0, 1, 2), [](const auto& test) {
  return std::string(test.param == 0 ? "NeoHookean" : test.param == 1 ? "MooneyRivlin" : "Artery");
});

TEST_P(PulsatingRingScene, PlaneTaylorHoodIsOfThirdOrder) {
  expect_taylor_hood_orders(ring_table<P2P1PlaneTriangle>("plane", GetParam(), {1, 2, 4}, {6, 1, 1, 4}, 0, 0.0625, 16),
                            5e-6);
}
TEST_P(PulsatingRingScene, AxisymmetricTaylorHoodIsOfThirdOrder) {
  expect_taylor_hood_orders(
      ring_table<P2P1AxisymmetricTriangle>("axisymmetric", GetParam(), {1, 2, 4}, {6, 1, 1, 1}, 0.4, 0.0625, 16), 3e-6);
}

TEST(PulsatingRing, LinearTrianglesAreOfSecondOrder) {
  const auto plane = ring_table<P1PlaneTriangle>("plane, linear", 0, {1, 2, 4}, {12, 4, 2, 8}, 0, 0.5, 4);
  const auto axisymmetric =
      ring_table<P1AxisymmetricTriangle>("axisymmetric, linear", 0, {1, 2, 4}, {12, 4, 2, 1}, 0.1, 0.5, 4);
  for (const auto& errors : {plane, axisymmetric}) {
    EXPECT_NEAR(errors.last_order(0), 2, 0.2);
    EXPECT_GT(errors.last_order(2), 1.7);
  }
}

// What a pressure of each layer's own is for.
TEST(PulsatingRing, OnePressureForBothLayersCostsMoreThanAnOrder) {
  const auto errors = ring_table<P2P1AxisymmetricTriangle>("axisymmetric, one pressure for both layers", 0, {1, 2, 4},
                                                           {6, 1, 1, 1}, 0.4, 0.5, 4, LayerPressure::continuous);
  EXPECT_LT(errors.last_order(0), 2);
  EXPECT_GT(errors.last_error(0), 1e-3);
}

TEST(PulsatingRing, TaylorHoodTetrahedraBetweenSymmetryPlanesAreOfThirdOrder) {
  expect_taylor_hood_orders(
      ring_table<P2P1Tetrahedron>("three-dimensional", 0, {1, 2, 3}, {3, 1, 1, 4}, 0.4, 0.125, 16), 1.2e-5);
}

}  // namespace

}  // namespace fsi::test::pulsating_ring_tests
