// Observed order of the time schemes on fixed meshes: backward Euler for the fluid, Newmark with beta = gamma = 1 for
// the wall, and the schemes of second order. tau of the fluid's stabilisation depends on the step; for steps so short
// that 2/dt prevails in it, the solution on a given mesh goes on changing with the step. The fluids here are viscous
// enough to keep clear of that, or their elements have no tau.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "beltrami_flow.hpp"
#include "fem/elements.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/errors.hpp"
#include "support/problems.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::time_convergence_tests {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int single_thread = set_threads(1);

/// Orders observed from results with successively halved steps, from the quotient of successive differences: it needs
/// no exact solution and the error of the mesh drops out.
std::vector<double> orders_of(const std::string& title, const std::vector<std::vector<double>>& results,
                              double first_step) {
  fmt::print("{}\n        dt   difference to dt/2   order\n", title);
  std::vector<double> orders;
  double last = 0;
  for (std::size_t k = 0; k + 1 < results.size(); ++k) {
    const double change = norm(difference(results[k], results[k + 1])) / norm(results.back());
    fmt::print("  {:8.5f}           {:10.3e}", first_step / std::pow(2.0, k), change);
    if (k > 0) {
      orders.push_back(std::log2(last / change));
      fmt::print("   {:5.2f}", orders.back());
    }
    fmt::print("\n");
    last = change;
  }
  return orders;
}

// A Beltrami flow that swings to and fro in a box that pulsates.
TEST(TimeConvergence, FlowOnAPulsatingMeshIsOfFirstOrder) {
  const double nu = 0.2, end = 0.6, first_step = 0.0375;
  const BeltramiFlow flow{1.0, /*wave_number=*/1.5, /*frequency=*/4};
  const auto displacement = [](const Point& x, double t) {
    const double s = 0.1 * std::sin(2 * t);
    return Point{s * std::sin(2 * x[1] + 1) * x[2], s * x[0] * x[2], s * std::cos(2 * x[0]) * x[1]};
  };
  const auto mesh = irregular_cube(5);
  const auto boundary = boundary_marks(mesh);
  std::vector<std::vector<double>> velocities, pressures;
  for (int halvings = 0; halvings < 4; ++halvings) {
    const int steps = static_cast<int>(std::lround(end / first_step)) << halvings;
    const double dt = end / steps;
    FluidProblem<Tet> fluid(whole(mesh), {flow.density, nu, false, dt}, {});
    FluidStep<Tet> step(fluid, [&](int a, int i) { return i < 3 && boundary[a] && !open_face(mesh.nodes[a]); });
    for (int s = 0; s <= steps; ++s) {
      step.mesh_old = step.mesh;
      step.fluid_old = step.solution;
      auto now = mesh.nodes;
      std::vector<double> mesh_velocity(3 * now.size());
      for (std::size_t a = 0; a < now.size(); ++a) {
        const Point d = displacement(mesh.nodes[a], s * dt);
        for (int i = 0; i < 3; ++i) {
          step.mesh[3 * a + i] = d[i];
          now[a][i] += d[i];
          mesh_velocity[3 * a + i] = (d[i] - step.mesh_old[3 * a + i]) / dt;
        }
        if (s == 0 || (boundary[a] && !open_face(mesh.nodes[a])))
          for (int i = 0; i < 3; ++i) step.solution[4 * a + i] = flow.velocity(now[a], s * dt).value[i];
      }
      if (s == 0) continue;
      step.load = flow.load(now, mesh.cells, fluid.form(), s * dt, mesh_velocity);
      NewtonOptions options;
      options.tolerance = 1e-10;
      const auto report = newton(step, options);
      ASSERT_TRUE(report.converged) << report.failure;
    }
    velocities.push_back(only(step.solution, 4, 0, 3));
    pressures.push_back(only(step.solution, 4, 3, 1));
  }
  EXPECT_NEAR(orders_of("velocity of a swinging Beltrami flow", velocities, first_step).back(), 1, 0.1);
  EXPECT_NEAR(orders_of("its pressure", pressures, first_step).back(), 1, 0.1);
}

/// Marches a case to its end.
State march(const Case& setup, const TetrahedralMesh& mesh) {
  const auto scene = build_scene<P1Tetrahedron>(setup, mesh);
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-10;
  NewtonStepper<3> stepper(*scene, loads, options, number_scene(*scene));
  State state = scene->at_rest();
  for (int step = 0; step < loads.steps(); ++step) stepper.advance(state);
  EXPECT_DOUBLE_EQ(state.time, setup.time->end);
  return state;
}

// A pressure that rises at the inlet of a viscous fluid lifts the wall above it.
TEST(TimeConvergence, CoupledMotionIsOfFirstOrder) {
  Case setup = coupled_case("artery");
  setup.fluid->viscosity = 1;
  setup.structure->axis_origin = {0.5, 0.5, -1};
  setup.structure->axis_direction = {0, 1, 0};
  setup.structure->bulk_modulus = 1e3;
  setup.inlet = PressureTable{{{0, 0}, {2, 2}}};
  setup.time->end = 2;
  const auto mesh = fluid_and_wall_box(2);
  std::vector<std::vector<double>> flows, walls;
  const double first_step = 0.4;
  for (int halvings = 0; halvings < 4; ++halvings) {
    setup.time->step = first_step / (1 << halvings);
    const auto state = march(setup, mesh);
    walls.push_back(only(state.now.wall, 4, 0, 3));
    flows.push_back(only(state.now.fluid, 4, 0, 3));
  }
  EXPECT_NEAR(orders_of("displacement of a wall above a viscous fluid", walls, first_step).back(), 1, 0.15);
  EXPECT_NEAR(orders_of("velocity of the fluid", flows, first_step).back(), 1, 0.15);
}

class SecondOrder : public testing::TestWithParam<std::string> {};
std::string name_of(const testing::TestParamInfo<std::string>& test) {
  return test.param == "midpoint"  ? "Midpoint"
         : test.param == "bdf2"    ? "Bdf2"
         : test.param == "tr-bdf2" ? "TrBdf2"
                                   : "GeneralisedAlpha";
}
INSTANTIATE_TEST_SUITE_P(TimeConvergence, SecondOrder,
                         testing::Values("midpoint", "bdf2", "tr-bdf2", "generalised-alpha"), name_of);

// A smooth pulse at the inlet of a short tube of Taylor-Hood elements: jumps, and fibres that begin to act, would move
// the stiffest modes of the mesh, which no step here resolves (for both: test_ring_in_time.cpp). One step more is taken,
// so that pressures at the time looked at are settled.
TEST_P(SecondOrder, CoupledMotionInEveryField) {
  Case setup = coupled_case("mooney-rivlin");
  setup.fluid->viscosity = 0.5;
  setup.structure->bulk_modulus = 1e4;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.inlet = PressureTable{};
  for (int i = 0; i <= 1000; ++i)
    setup.inlet->points.push_back({0.002 * i, 0.5 * std::pow(std::sin(std::acos(0.0) * 0.002 * i), 4)});
  setup.time->scheme = GetParam();
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.axial = 4;
  const auto mesh = with_mid_edge_nodes(generate_artery_section(shape, cells));
  const double first_step = 0.025, time = 2;
  const char* names[] = {"displacement of the wall", "velocity of the blood", "displacement of the mesh",
                         "velocity of the wall",     "pressure of the blood", "pressure of the wall"};
  std::vector<std::vector<double>> results[6];
  for (int halvings = 0; halvings < 4; ++halvings) {
    setup.time->step = first_step / (1 << halvings);
    setup.time->end = time + setup.time->step;
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, mesh);
    const Loads loads(setup);
    NewtonOptions options;
    options.tolerance = 1e-10;
    NewtonStepper<2> stepper(*scene, loads, options, number_scene(*scene));
    State state = scene->at_rest();
    std::vector<double> wall_velocity;
    for (int step = 0; step < loads.steps(); ++step) {
      wall_velocity = state.wall_velocity;
      stepper.advance(state);
    }
    ASSERT_NEAR(state.times[1], time, 1e-9);
    const Solution& at = state.before[1];
    const std::vector<double> fields[] = {only(at.wall, 3, 0, 2), only(at.fluid, 3, 0, 2), at.mesh,
                                          wall_velocity,          only(at.fluid, 3, 2, 1), only(at.wall, 3, 2, 1)};
    for (int field = 0; field < 6; ++field) results[field].push_back(fields[field]);
  }
  for (int field = 0; field < 6; ++field)
    EXPECT_NEAR(orders_of(names[field], results[field], first_step).back(), 2, 0.1) << names[field];
}

/// A slow pulse through a short tube: the wall follows in 1 ms, the flow in 20, the pressure takes 200. Steps of 2.5 ms and
/// more do not resolve the wall's own motion.
Case slow_pulse() {
  Case setup = coupled_case("mooney-rivlin");
  setup.fluid->viscosity = 0.02;
  setup.structure->bulk_modulus = 1e4;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.inlet = PressureTable{};
  for (int i = 0; i <= 1000; ++i)
    setup.inlet->points.push_back({0.2 * i, 0.02 * std::pow(std::sin(std::acos(0.0) * 0.002 * i), 4)});
  setup.time->scheme.reset();
  return setup;
}

/// The least order, of the last halving, of displacement and velocity at 60 ms.
double order_of_long_steps(const std::string& title, Case setup) {
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.axial = 4;
  const auto mesh = with_mid_edge_nodes(generate_artery_section(shape, cells));
  const double first_step = 20;
  setup.time->end = 60;
  std::vector<std::vector<double>> walls, flows;
  for (int halvings = 0; halvings < 4; ++halvings) {
    setup.time->step = first_step / (1 << halvings);
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, mesh);
    const Loads loads(setup);
    NewtonOptions options;
    options.tolerance = 1e-10;
    NewtonStepper<2> stepper(*scene, loads, options, number_scene(*scene));
    State state = scene->at_rest();
    for (int step = 0; step < loads.steps(); ++step) stepper.advance(state);
    walls.push_back(only(state.now.wall, 3, 0, 2));
    flows.push_back(only(state.now.fluid, 3, 0, 2));
  }
  return std::min(orders_of(title + ": displacement of the wall", walls, first_step).back(),
                  orders_of(title + ": velocity of the blood", flows, first_step).back());
}

// The scheme that a case has which names none, and a midpoint rule whose shift grows with the step until theta is 1.
TEST(TimeConvergence, StepsLongAgainstTheWallsTimeAreOfSecondOrder) {
  Case setup = slow_pulse();
  EXPECT_NEAR(order_of_long_steps("chosen scheme", setup), 2, 0.2);
  setup.time->scheme = "midpoint";
  setup.time->scheme_values["damping"] = 0.2;  // 1/ms, what the scene would give
  EXPECT_LT(order_of_long_steps("unbounded shift", setup), 1.4);
}

}  // namespace

}  // namespace fsi::test::time_convergence_tests
