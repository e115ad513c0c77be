// Backflow at an opening without traction: a flow that feeds on it until it blows up, and its stabilisation, both
// against a solution of the equations of Navier and Stokes in closed form.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "diagnostics/energy_balance.hpp"
#include "fem/elements.hpp"
#include "fluid/backflow.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/ring_meshes.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::backflow_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

/// Radial flow u = q(t)/r between the arcs r1 and r2 of a quarter ring whose straight sides it slides along. It has no
/// viscous force; with both arcs free of traction, p = -2 mu q/r^2 there, Bernoulli's equation between them gives
///   ln(r2/r1) q' = -2 nu (1/r1^2 - 1/r2^2) q + [(1/r1^2 - 1/r2^2)/2 - beta/r1^2] q^2
/// for q > 0, which enters through the narrow arc. Without stabilisation the energy that enters there exceeds what
/// leaves: q grows beyond all bounds in a finite time. With beta = 1/2 it falls.
struct RadialFlow {
  double beta;
  static constexpr double r1 = 1, r2 = 2, nu = 0.05, start = 1;

  double at(double time) const {
    const double drop = 1 / (r1 * r1) - 1 / (r2 * r2), width = std::log(r2 / r1);
    const double a = 2 * nu * drop / width, b = (0.5 * drop - beta / (r1 * r1)) / width;
    return a * start * std::exp(-a * time) / (a - b * start * (1 - std::exp(-a * time)));
  }
  static double blow_up() {
    const RadialFlow free{0};
    double from = 0, to = 10;  // q is positive before and negative behind
    for (int i = 0; i < 60; ++i) (free.at(0.5 * (from + to)) > 0 ? from : to) = 0.5 * (from + to);
    return from;
  }
};

/// The ring with groups `outlet`, the narrow arc, and `inlet`, the wide one.
template <class Element>
SimplexMesh<2, Element::order> quarter_ring(int across, int along) {
  const double quarter = std::acos(0.0);
  auto unbent = triangle_grid(
      {across, along}, {"fluid"},
      [&](int i, int j) {
        return Point{RadialFlow::r1 * std::pow(RadialFlow::r2 / RadialFlow::r1, static_cast<double>(i) / across), 0,
                     quarter * j / along};
      },
      [](int, int) { return 0; });
  unbent.facet_groups = {{group::outlet, boundary_where(unbent, where(0, RadialFlow::r1))},
                         {group::inlet, boundary_where(unbent, where(0, RadialFlow::r2))},
                         {group::symmetry[1], boundary_where(unbent, where(2, 0))},
                         {group::symmetry[0], boundary_where(unbent, where(2, quarter))}};
  auto mesh = in_order<Element>(unbent);
  for (auto& x : mesh.nodes) x = {x[2] > quarter - 1e-9 ? 0.0 : x[0] * std::cos(x[2]), x[0] * std::sin(x[2]), 0};
  return mesh;
}

struct Marched {
  double q = 0;          ///< at the end, from the flow through the wide arc
  double growth = 0;     ///< of the kinetic energy
  double entered = 0;    ///< kinetic energy through the narrow arc, uJ
  double taken = 0;      ///< of it by the stabilisation
  double remainder = 0;  ///< largest of a step over the kinetic energy
  int most_iterations = 0;
};

template <class Element>
Marched march(const SimplexMesh<2, Element::order>& mesh, double beta, double end, int steps) {
  Case setup;
  setup.geometry = Geometry::plane;
  setup.fluid = FluidData{1.0, RadialFlow::nu};
  setup.inlet = PressureTable{{{0.0, 0.0}}};
  setup.time.emplace();
  setup.time->step = end / steps;
  setup.time->end = end;
  setup.time->scheme_values["damping"] = 0;
  const auto scene = build_scene<Element>(setup, mesh);
  scene->fluid->stabilise_backflow(1, beta);
  EXPECT_EQ(scene->fluid->open_boundaries()[1].name(), group::outlet);

  State state = scene->at_rest();
  const auto& nodes = scene->fluid->nodes().nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (int k = 0; k < 2; ++k)
      state.now.fluid[MixedLayout<2>::vector(static_cast<int>(a), k)] =
          RadialFlow::start * nodes[a][k] / (nodes[a][0] * nodes[a][0] + nodes[a][1] * nodes[a][1]);
  scene->impose_conditions(state.now);
  state.before[0] = state.now;
  scene->integrator->prepare(state);

  const Loads loads(setup);
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.tolerance = 1e-10;
  NewtonStepper<2> stepper(*scene, loads, options, number_scene(*scene));
  stepper.keep_balances(true);
  EnergyBalance<2> balance(*scene, state);
  Marched result;
  const double at_start = scene->fluid->kinetic_energy({}, state.before[0].fluid);
  while (state.step < loads.steps()) {
    const StepReport report = stepper.advance(state);
    const EnergyRecord e = balance.step_to(state, report);
    result.entered -= e.outlet_kinetic;
    result.taken += e.backflow;
    result.remainder = std::max(result.remainder, std::abs(e.remainder) / e.fluid_kinetic);
    result.most_iterations = std::max(result.most_iterations, report.newton_iterations);
    result.growth = e.fluid_kinetic / at_start;
  }
  const auto& wide = *scene->fluid->open_boundary(group::inlet);
  result.q = wide.outflow(state.before[0].fluid) / std::acos(0.0);
  return result;
}

TEST(BackflowAtAnOpening, GainsEnergyWithoutBoundsAndNoneWhenStabilised) {
  const double end = 1.7;
  EXPECT_GT(RadialFlow::blow_up(), 2);
  EXPECT_LT(RadialFlow::blow_up(), 2.2);
  const auto mesh = quarter_ring<P2P1PlaneTriangle>(4, 6);
  for (double beta : {0.0, 0.2, 0.5, 1.0}) {
    const RadialFlow exact{beta};
    const Marched flow = march<P2P1PlaneTriangle>(mesh, beta, end, 120);
    fmt::print(
        "beta {:.1f}: q {:.5f}, exact {:.5f}; energy times {:.3f}; entered {:.4f} uJ, taken {:.4f} uJ; remainder "
        "{:.1e}; {} iterations\n",
        beta, flow.q, exact.at(end), flow.growth, flow.entered, flow.taken, flow.remainder, flow.most_iterations);
    EXPECT_NEAR(flow.q / exact.at(end), 1, 2e-3);
    EXPECT_NEAR(flow.taken, 2 * beta * flow.entered, 1e-12 * flow.entered);
    EXPECT_LT(flow.remainder, 1e-12);
    EXPECT_LE(flow.most_iterations, 5);
    if (beta == 0) {
      EXPECT_GT(flow.growth, 20);
    }
    if (beta >= 0.5) {
      EXPECT_LT(flow.growth, 1);
    }
  }
}

/// A pipe of revolution 0 < r < 1, 0 < z < 2.
template <class Element>
SimplexMesh<2, Element::order> short_pipe(int across, int along) {
  auto mesh = triangle_grid(
      {across, along}, {"fluid"},
      [&](int i, int j) {
        return Point{static_cast<double>(i) / across, 0, 2.0 * j / along};
      },
      [](int, int) { return 0; });
  mesh.facet_groups = {{group::inlet, boundary_where(mesh, where(2, 0))},
                       {group::outlet, boundary_where(mesh, where(2, 2))}};
  return in_order<Element>(mesh);
}

/// A pressure that swings at one end: near the wall the flow turns first, so that both ends have fluid that enters
/// beside fluid that leaves, at points that change from step to step. Newton's method meets the kink of (u . n)_- each
/// time.
template <class Element>
void check_swinging_flow() {
  constexpr double period = 2;
  Case setup;
  setup.fluid = FluidData{1.0, 0.1};
  setup.inlet = PressureTable{};
  for (int i = 0; i <= 200; ++i)
    setup.inlet->points.emplace_back(0.01 * period * i, 10 * std::cos(0.02 * std::acos(-1.0) * i));
  setup.time.emplace();
  setup.time->step = 0.05;
  setup.time->end = 2 * period;
  const auto scene = build_scene<Element>(setup, short_pipe<Element>(5, 6));
  for (std::size_t end : {0, 1}) scene->fluid->stabilise_backflow(end, BackflowTraction::standard);
  const Loads loads(setup);
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.tolerance = 1e-10;
  NewtonStepper<2> stepper(*scene, loads, options, number_scene(*scene));
  stepper.keep_balances(true);
  State state = scene->at_rest();
  EnergyBalance<2> balance(*scene, state);
  const auto& nodes = scene->fluid->nodes().nodes;
  int mixed = 0, most = 0;
  double taken = 0, largest = 0, off = 0;
  while (state.step < loads.steps()) {
    const StepReport report = stepper.advance(state);
    const EnergyRecord e = balance.step_to(state, report);
    bool in = false, out = false;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (nodes[a][2] > 2 - 1e-9) {
        const double u = report.balances[0].at.fluid[MixedLayout<2>::vector(static_cast<int>(a), 1)];
        in = in || u < -1e-3;
        out = out || u > 1e-3;
      }
    mixed += in && out;
    most = std::max(most, report.newton_iterations);
    taken += e.backflow;
    largest = std::max(largest, e.fluid_kinetic);
    off = std::max(off, std::abs(e.remainder));
    EXPECT_GE(e.backflow, 0);
  }
  fmt::print(
      "swinging flow: {} of {} steps with both directions at the outlet, {} iterations at most, taken {:.3f} uJ, "
      "kinetic energy up to {:.3f} uJ, remainder up to {:.1e} uJ\n",
      mixed, loads.steps(), most, taken, largest, off);
  EXPECT_GT(mixed, 5);
  EXPECT_LE(most, 6);
  EXPECT_GT(taken, 0.1 * largest);
  EXPECT_LT(off, 1e-8 * largest);
}

TEST(BackflowAtAnOpening, NewtonsMethodConvergesWhereSomeFluidEntersAndSomeLeaves) {
  check_swinging_flow<P1AxisymmetricTriangle>();
  check_swinging_flow<P2P1AxisymmetricTriangle>();
}

}  // namespace

}  // namespace fsi::test::backflow_tests
