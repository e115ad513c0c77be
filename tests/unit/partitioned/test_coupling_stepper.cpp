#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_triangle.hpp"
#include "host/threads.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "partitioned/block_newton/block_newton_stepper.hpp"
#include "partitioned/divergence.hpp"
#include "partitioned/registry.hpp"
#include "support/nodal_arrays.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi::test {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int single_thread = set_threads(1);

Case partitioned_case(const std::string& scheme, double tolerance, const std::string& material = "neo-hookean") {
  Case setup = coupled_case(material);
  setup.partitioned.scheme = scheme;
  setup.partitioned.tolerance = tolerance;
  setup.partitioned.max_iterations = 2000;
  return setup;
}

template <int n>
std::unique_ptr<Stepper> make_stepper(Scene<n>& scene, const Loads& loads, const Case& setup) {
  return make_coupling_stepper(scene, loads, setup);
}

/// The stepper of a case's scheme.
class Coupled {
 public:
  template <int n>
  Coupled(Scene<n>& scene, const Loads& loads, const Case& setup) : made_(make_coupling_stepper(scene, loads, setup)) {}
  StepReport advance(State& state) { return made_->advance(state); }
  const StepReport& report() const { return made_->report(); }
  std::string unchecked() const { return made_->unchecked(); }
  void keep(RestartArchive& archive) { made_->keep(archive); }
  void keep_balances(bool on) { made_->keep_balances(on); }

 private:
  std::unique_ptr<Stepper> made_;
};

/// Marches a box of fluid and wall; returns the states after each step.
template <class MakeStepper>
std::vector<State> march(const Case& setup, int steps, MakeStepper make) {
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  const auto stepper = make(*scene, loads);
  std::vector<State> states;
  State state = scene->at_rest();
  for (int n = 0; n < steps; ++n) {
    const StepReport report = stepper->advance(state);
    EXPECT_EQ(report.coupling.has_value(), stepper->reports_coupling());
    states.push_back(state);
  }
  return states;
}

std::vector<State> march_partitioned(const Case& setup, int steps) {
  return march(setup, steps, [&](Scene<3>& scene, const Loads& loads) { return make_stepper(scene, loads, setup); });
}

class EachScheme : public testing::TestWithParam<std::string> {};

/// For both ways in which the layers' pressures can meet.
TEST_P(EachScheme, ConvergesToTheMonolithicSolution) {
  for (const auto& [material, layer_pressure] :
       {std::pair{"neo-hookean", LayerPressure::continuous}, std::pair{"artery", LayerPressure::separate}}) {
    Case setup = partitioned_case(GetParam(), 1e-10, material);
    setup.structure->layer_pressure = layer_pressure;
    NewtonOptions newton;
    newton.tolerance = 1e-12;
    const auto whole = march(setup, 3, [&](Scene<3>& scene, const Loads& loads) {
      return std::make_unique<NewtonStepper<3>>(scene, loads, newton, number_scene(scene));
    });
    const auto parts = march_partitioned(setup, 3);
    for (std::size_t n = 0; n < 3; ++n) {
      const Solution &a = parts[n].before[0], &b = whole[n].before[0];
      EXPECT_LT(norm(difference(a.wall, b.wall)), 1e-7 * norm(b.wall)) << material << ", step " << n + 1;
      EXPECT_LT(norm(difference(a.fluid, b.fluid)), 1e-7 * norm(b.fluid)) << material << ", step " << n + 1;
      EXPECT_LT(norm(difference(a.mesh, b.mesh)), 1e-7 * norm(b.mesh)) << material << ", step " << n + 1;
    }
  }
}

// Taylor-Hood elements of a body of revolution, each layer with its pressure: displacements stay one at the copies of a
// node.
TEST_P(EachScheme, ConvergesToTheMonolithicSolutionOfAnotherElement) {
  Case setup = partitioned_case(GetParam(), 1e-9);
  setup.structure->layer_pressure = LayerPressure::separate;
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.axial = 4;
  const auto mesh = with_mid_edge_nodes(generate_artery_section(shape, cells));
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, mesh),
             other = build_scene<P2P1AxisymmetricTriangle>(setup, mesh);
  ASSERT_TRUE(scene->wall->nodes().has_copies());
  const Loads loads(setup);
  NewtonOptions newton;
  newton.tolerance = 1e-11;
  NewtonStepper<2> whole(*scene, loads, newton, number_scene(*scene));
  const auto parts = make_stepper<2>(*other, loads, setup);
  State a = scene->at_rest(), b = other->at_rest();
  for (int n = 0; n < 2; ++n) {
    whole.advance(a);
    parts->advance(b);
    EXPECT_LT(norm(difference(a.now.wall, b.now.wall)), 1e-6 * norm(a.now.wall)) << "step " << n + 1;
    EXPECT_LT(norm(difference(a.now.fluid, b.now.fluid)), 1e-6 * norm(a.now.fluid)) << "step " << n + 1;
    double jump = 0;
    for (const State* state : {&a, &b})
      for (int node = 0; node < scene->wall->node_count(); ++node) {
        const int original = scene->wall->nodes().original_of(node);
        for (int k = 0; k < 2; ++k) {
          EXPECT_EQ(state->now.wall[3 * node + k], state->now.wall[3 * original + k]);
          EXPECT_EQ(state->wall_velocity[2 * node + k], state->wall_velocity[2 * original + k]);
          EXPECT_EQ(state->wall_acceleration[2 * node + k], state->wall_acceleration[2 * original + k]);
        }
        jump = std::max(jump, std::abs(state->now.wall[3 * node + 2] - state->now.wall[3 * original + 2]));
      }
    EXPECT_GT(jump, 0.01) << "kPa";
  }
}

TEST_P(EachScheme, GoesOnBitForBitFromItsMemory) {
  const Case setup = partitioned_case(GetParam(), 1e-5);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2)),
             scene_again = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  const auto stepper = make_stepper<3>(*scene, loads, setup), again = make_stepper<3>(*scene_again, loads, setup);
  State state = scene->at_rest();
  for (int n = 0; n < 3; ++n) stepper->advance(state);
  State copy = state;
  WrittenArchive archive = archive_of(*stepper);
  again->keep(archive.turn());
  for (int n = 0; n < 2; ++n) {
    const auto first = stepper->advance(state), second = again->advance(copy);
    EXPECT_EQ(first.outer_iterations, second.outer_iterations);
    EXPECT_EQ(first.newton_iterations, second.newton_iterations);
  }
  EXPECT_EQ(state.now.wall, copy.now.wall);
  EXPECT_EQ(state.now.fluid, copy.now.fluid);
  EXPECT_EQ(state.now.mesh, copy.now.mesh);
}

TEST_P(EachScheme, LeavesASceneWithoutLoadAtRest) {
  Case setup = partitioned_case(GetParam(), 1e-8);
  setup.inlet.reset();
  for (const State& state : march_partitioned(setup, 2)) {
    EXPECT_EQ(largest(state.now.wall), 0);
    EXPECT_EQ(largest(state.now.fluid), 0);
  }
}

TEST_P(EachScheme, ReportsWhatItDid) {
  const Case setup = partitioned_case(GetParam(), 1e-6);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  const auto stepper = make_stepper<3>(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper->advance(state);
  ASSERT_TRUE(report.coupling);
  const CouplingReport& coupling = *report.coupling;
  EXPECT_LE(coupling.displacement_residual, 1e-6);
  if (GetParam() != "block-newton") {  // whose passes soon know all of so small an interface
    EXPECT_GT(coupling.displacement_gap, 0);
  }
  EXPECT_GT(coupling.force_residual, 0);
  EXPECT_LT(coupling.force_residual, 1e-4);
  EXPECT_EQ(coupling.failed_passes, 0);
  if (GetParam() == "block-newton") {  // one iteration for both, solved by passes
    EXPECT_EQ(report.newton_iterations, coupling.fluid_newton_iterations);
    EXPECT_EQ(report.newton_iterations, coupling.wall_newton_iterations);
    EXPECT_LE(2 * report.newton_iterations, report.outer_iterations);
  } else {
    EXPECT_EQ(report.newton_iterations, coupling.fluid_newton_iterations + coupling.wall_newton_iterations);
  }
  EXPECT_GT(coupling.fluid_seconds, 0);
  EXPECT_GT(coupling.wall_seconds, 0);
  const bool mesh_is_the_fluids =
      GetParam() == "block-newton" || std::string(GetParam()).rfind("robin", 0) == 0;  // solved with it, in its seconds
  EXPECT_EQ(coupling.mesh_seconds > 0, !mesh_is_the_fluids);
}

/// A short piece of the axisymmetric artery, quadratic elements, pushed for one step.
Case short_pulse(const std::string& scheme, double tolerance, const std::string& time_scheme, double step = 0.0625) {
  Case setup = partitioned_case(scheme, tolerance);
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.time = TimeData{step, 100 * step, std::nullopt};
  setup.time->scheme = time_scheme;
  setup.inlet = PressureTable{{{0.0, 1.332}, {0.0625, 1.332}, {0.0625, 0.0}}};
  return setup;
}

auto short_artery() {
  ArteryShape shape;
  shape.length = 3;
  ArteryCells cells;
  cells.lumen = 2;
  cells.media = cells.adventitia = 1;
  cells.axial = 4;
  return with_mid_edge_nodes(generate_artery_section(shape, cells));
}

constexpr std::array every_time_scheme{"euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2"};

/// Largest difference of the fluid's pressures relative to the largest pressure, at each step's last balance.
std::vector<double> pressures_apart(const Case& setup, int steps) {
  const auto mesh = short_artery();
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, mesh),
             other = build_scene<P2P1AxisymmetricTriangle>(setup, mesh);
  const Loads loads(setup);
  NewtonOptions newton;
  newton.tolerance = 1e-11;
  NewtonStepper<2> whole(*scene, loads, newton, number_scene(*scene));
  const auto parts = make_stepper<2>(*other, loads, setup);
  State a = scene->at_rest(), b = other->at_rest();
  std::vector<double> apart;
  for (int step = 0; step < steps; ++step) {
    whole.advance(a);
    parts->advance(b);
    double gap = 0, pressure = 0;
    const auto &p = a.last_balance().fluid, &q = b.last_balance().fluid;
    for (std::size_t i = 2; i < p.size(); i += 3) {
      gap = std::max(gap, std::abs(p[i] - q[i]));
      pressure = std::max(pressure, std::abs(p[i]));
    }
    apart.push_back(gap / pressure);
  }
  return apart;
}

TEST_P(EachScheme, AgreesWithTheMonolithicDriverInEachTimeScheme) {
  if (GetParam() == "constant" || GetParam() == "aitken") GTEST_SKIP() << "hundreds of passes";
  for (const std::string time_scheme : every_time_scheme)
    for (const double apart : pressures_apart(short_pulse(GetParam(), 1e-8, time_scheme), 3))
      EXPECT_LT(apart, 1e-6) << time_scheme;
}

INSTANTIATE_TEST_SUITE_P(CouplingStepper, EachScheme,
                         testing::Values("constant", "aitken", "block-newton", "iqn-ils", "iqn-imvj", "newton-krylov",
                                         "robin-neumann", "robin-neumann-inexact", "robin-neumann-iqn",
                                         "robin-neumann-imvj"),
                         [](const auto& scheme) {
                           std::string name = scheme.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(CouplingStepper, ExplicitTakesOnePass) {
  const Case setup = partitioned_case("explicit", 1e-6);
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_EQ(report.outer_iterations, 1);
  EXPECT_GT(report.coupling->displacement_residual, 1e-6) << "reported as it is";
}

TEST(CouplingStepper, ExplicitIsRefusedBeforeItsFirstStepWhereTheAddedMassIsLarge) {
  Case setup = partitioned_case("explicit", 1e-6);
  setup.structure->density = 1e-2;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  try {
    stepper.advance(state);
    FAIL();
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("added mass"), std::string::npos) << error.what();
  }
  EXPECT_EQ(state.step, 0);
  EXPECT_EQ(largest(state.now.wall), 0);
}

TEST(CouplingStepper, ExplicitClaimsNothingBeforeItsCheckCanSpeak) {
  Case setup = partitioned_case("explicit", 1e-6);
  setup.structure->density = 1e4;
  setup.time->end = 20 * setup.time->step;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  for (int step = 1; step <= 12; ++step) {
    stepper.advance(state);
    EXPECT_EQ(stepper.unchecked().empty(), step >= VelocityGapMonitor::most_steps) << step;
    Coupled restarted(*scene, loads, setup);
    WrittenArchive archive = archive_of(stepper);
    restarted.keep(archive.turn());
    EXPECT_EQ(restarted.unchecked(), stepper.unchecked());
  }
}

/// Distance of the wall's displacement of a loosely coupled march from the monolithic one at 1 ms, relative.
double loose_error(Case setup) {
  setup.time->end = 1;
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery()),
             other = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
  const Loads loads(setup);
  NewtonOptions newton;
  newton.tolerance = 1e-10;
  NewtonStepper<2> whole(*scene, loads, newton, number_scene(*scene));
  Coupled parts(*other, loads, setup);
  State a = scene->at_rest(), b = other->at_rest();
  for (int n = 0; n < setup.time->steps(); ++n) {
    whole.advance(a);
    const StepReport report = parts.advance(b);
    EXPECT_GT(report.coupling->displacement_gap, 0) << "reported as it is";
    EXPECT_GT(report.coupling->gap_pressure, 0);
    if (setup.partitioned.scheme == "semi-implicit") {
      EXPECT_GT(report.coupling->domain_gap, 0);
    }
  }
  const auto displacements = [](std::vector<double> wall) {
    for (std::size_t i = 2; i < wall.size(); i += 3) wall[i] = 0;
    return wall;
  };
  const std::vector<double> expected = displacements(a.now.wall);
  return norm(difference(expected, displacements(b.now.wall))) / norm(expected);
}

/// 0.5 kPa sin^2, up and down within 1 ms: a polyline of 256 pieces.
PressureTable smooth_pulse() {
  PressureTable table;
  for (int i = 0; i <= 256; ++i) {
    const double sine = std::sin(i / 256. * std::acos(-1.));
    table.points.emplace_back(i / 256., 0.5 * sine * sine);
  }
  return table;
}

// In smooth motion one solve of either medium leaves an error of nearly first order, as theory has it (0.84 and 0.91 here),
// and with the correction's data one of second order (2.07 and 1.90; with bdf2 1.88 and 1.92).
TEST(RobinRobin, SplittingErrorHasItsOrder) {
  struct Expected {
    const char *scheme, *time_scheme;
    double order;
  };
  double plain = 0;
  for (const Expected& expected :
       {Expected{"robin-robin", "euler", 0.8}, Expected{"robin-robin-parallel", "euler", 0.8},
        Expected{"robin-robin-corrected", "euler", 1.8}, Expected{"robin-robin-corrected", "bdf2", 1.8}}) {
    const std::string scheme = expected.scheme;
    const auto error = [&](double step) {
      Case setup = short_pulse(scheme, 1e-7, expected.time_scheme, step);
      setup.inlet = smooth_pulse();
      return loose_error(setup);
    };
    const double coarse = error(1. / 32), middle = error(1. / 64), fine = error(1. / 128);
    const std::string said = scheme + ", " + expected.time_scheme;
    std::cout << said << ": errors " << coarse << ", " << middle << ", " << fine << '\n';
    EXPECT_GT(std::log2(coarse / middle), expected.order) << said;
    EXPECT_GT(std::log2(middle / fine), expected.order) << said;
    if (scheme == "robin-robin") plain = fine;
    if (scheme == "robin-robin-corrected") {
      EXPECT_LT(fine, 0.1 * plain) << said;
    }
  }
}

// What one pass lacks of a jump of the load would swing between fluid and wall for long.
TEST(RobinRobin, StepsBehindJumpsAreIterated) {
  for (const std::string scheme : {"robin-robin", "robin-robin-corrected", "robin-robin-parallel"}) {
    const Case setup = short_pulse(scheme, 1e-8, "euler");
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery()),
               other = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
    const Loads loads(setup);
    NewtonOptions newton;
    newton.tolerance = 1e-11;
    NewtonStepper<2> whole(*scene, loads, newton, number_scene(*scene));
    Coupled parts(*other, loads, setup);
    State a = scene->at_rest(), b = other->at_rest();
    for (int step = 1; step <= 4; ++step) {  // the pulse ends with the first
      whole.advance(a);
      const StepReport report = parts.advance(b);
      const int single = scheme == "robin-robin-corrected" ? 2 : 1;
      EXPECT_EQ(report.outer_iterations > single, step <= 2) << scheme << ", step " << step;
      const double apart = norm(difference(a.now.wall, b.now.wall)) / norm(a.now.wall);
      if (step <= 2)
        EXPECT_LT(apart, 1e-6) << scheme << ", step " << step;
      else
        EXPECT_GT(apart, 1e-4) << scheme << ", step " << step;
    }
  }
}

/// The fluid's rows F and its velocities u on the interface in a balance.
struct InterfaceData {
  std::vector<double> rows, velocity;
};
InterfaceData interface_data(const Scene<3>& scene, const Balance& balance) {
  std::vector<double> rows;
  scene.assemble_fluid(balance.at, balance.data, rows);
  InterfaceData data;
  for (const auto& node : scene.interface)
    for (int k = 0; k < 3; ++k) {
      data.rows.push_back(rows[MixedLayout<3>::vector(node.fluid, k)]);
      data.velocity.push_back(balance.at.fluid[MixedLayout<3>::vector(node.fluid, k)]);
    }
  return data;
}

// The conditions of a step, from the fields that it leaves. The march that predicts for robin-robin-corrected is one of
// robin-robin by itself.
TEST(RobinRobin, BothMediaHaveTheirRobinConditions) {
  for (const std::string scheme : {"robin-robin", "robin-robin-corrected"}) {
    Case setup = partitioned_case(scheme, 1e-9);
    setup.time->scheme = "euler";
    setup.partitioned.robin_coefficient = 0.7;
    Case plain = setup;
    plain.partitioned.scheme = "robin-robin";
    const bool corrected = scheme == "robin-robin-corrected";
    if (corrected) plain.partitioned.robin_coefficient = 0.7 / std::sqrt(2);
    const double alpha = corrected ? 0.7 * std::sqrt(2) : 0.7;
    const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2)),
               other = build_scene<P1Tetrahedron>(plain, fluid_and_wall_box(2));
    const Loads loads(setup);
    Coupled stepper(*scene, loads, setup);
    Coupled predicting(*other, loads, plain);
    stepper.keep_balances(true);
    predicting.keep_balances(true);
    State state = scene->at_rest(), predicted = other->at_rest();
    const std::vector<double> zero(scene->interface.size() * 3, 0.0);
    InterfaceData last{zero, zero}, last_predicted = last;  // lambda^n, u^n
    for (int step = 0; step < 3; ++step) {
      const StepReport report = stepper.advance(state);
      const bool iterated = step == 0;  // behind the jump of the load at the start
      if (iterated)
        EXPECT_GT(report.outer_iterations, 2);
      else
        EXPECT_EQ(report.outer_iterations, corrected ? 2 : 1) << "one pass of each march";
      const Balance& balance = report.balances.front();
      const StepRates& rates = balance.data.rates;
      const InterfaceData now = interface_data(*scene, balance),
                          now_predicted = interface_data(*other, predicting.advance(predicted).balances.front());
      double of_fluid = 0, of_wall = 0, size = 0, change = 0, squared_gap = 0;
      for (std::size_t i = 0; i < scene->interface.size(); ++i) {
        const auto& node = scene->interface[i];
        if (node.clamped) continue;
        const double c = alpha * scene->interface_areas[i];
        for (int k = 0; k < 3; ++k) {
          const std::size_t j = 3 * i + k, w = MixedLayout<3>::vector(node.wall, k);
          const double dl = corrected ? now_predicted.rows[j] - last_predicted.rows[j] : 0,
                       du = corrected ? now_predicted.velocity[j] - last_predicted.velocity[j] : 0;
          const double lambda = last.rows[j] + dl, u = last.velocity[j] + du;
          const double v = rates.interface.velocity(balance.at.wall[w], rates.wall_reference[w]);
          const double load = balance.data.interface_load[w];
          squared_gap += std::pow(rates.interface.period * (v - now.velocity[j]), 2);
          of_fluid = std::max(of_fluid, std::abs(iterated ? c * (now.velocity[j] - v)
                                                          : now.rows[j] - lambda + c * (now.velocity[j] - v)));
          of_wall = std::max(of_wall, std::abs(iterated ? now.rows[j] - load : load - lambda - c * (v - u)));
          size = std::max(size, std::abs(now.rows[j]));
          change = std::max(change, std::abs(dl));
        }
      }
      EXPECT_LT(of_fluid, 1e-7 * size) << scheme << ", " << step;
      EXPECT_LT(of_wall, 1e-7 * size) << scheme << ", " << step;
      EXPECT_NEAR(report.coupling->displacement_gap, std::sqrt(squared_gap), 1e-3 * std::sqrt(squared_gap))
          << scheme << ", " << step;
      if (corrected) {
        EXPECT_GT(change, 1e-3 * size) << "else nothing was corrected";
      }
      last = now;
      last_predicted = now_predicted;
    }
  }
}

// Without an iteration nothing says that fluid and wall agree: the run does where they do not, and its restart alike.
TEST(RobinRobin, SaysWhatItLeavesAndRestartsWithTheSameBits) {
  for (const std::string scheme : {"robin-robin", "robin-robin-corrected", "robin-robin-parallel"}) {
    const Case setup = short_pulse(scheme, 1e-6, "euler");
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
    const Loads loads(setup);
    Coupled stepper(*scene, loads, setup);
    State state = scene->at_rest();
    for (int step = 0; step < 3; ++step) stepper.advance(state);
    EXPECT_NE(stepper.unchecked().find("does not iterate"), std::string::npos);
    Coupled restarted(*scene, loads, setup);
    WrittenArchive archive = archive_of(stepper);
    restarted.keep(archive.turn());
    EXPECT_EQ(restarted.unchecked(), stepper.unchecked());
    State again = state;
    stepper.advance(state);
    restarted.advance(again);
    EXPECT_EQ(again.now.wall, state.now.wall) << scheme;
    EXPECT_EQ(again.now.fluid, state.now.fluid) << scheme;
  }
}

// Solvers that iterate use the scene's matrices: with those of the other march they would need more iterations of Newton's
// method, and after a restart others.
TEST(RobinRobin, MarchesThatIterateHaveTheirOwnJacobians) {
  for (const std::string time_scheme : {"euler", "bdf2"}) {
    const auto case_of = [&](const std::string& scheme) {
      Case setup = partitioned_case(scheme, 1e-6);
      setup.time->scheme = time_scheme;
      setup.partitioned.fast.direct_below = 0;
      return setup;
    };
    const Case setup = case_of("robin-robin-corrected"), plain = case_of("robin-robin");
    const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3)),
               again = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3)),
               other = build_scene<P1Tetrahedron>(plain, fluid_and_wall_box(3));
    const Loads loads(setup);
    Coupled stepper(*scene, loads, setup);
    Coupled single(*other, loads, plain);
    Coupled restarted(*again, loads, setup);
    State state = scene->at_rest(), alone = other->at_rest();
    int twice = 0, once = 0;
    for (int step = 1; step <= 6; ++step) {
      const int steps = stepper.advance(state).newton_iterations, of_single = single.advance(alone).newton_iterations;
      if (step == 1) continue;  // iterated
      twice += steps;
      once += of_single;
    }
    EXPECT_LE(twice, 2.3 * once) << time_scheme;
    WrittenArchive archive = archive_of(stepper);
    restarted.keep(archive.turn());
    State copy = state;
    for (int step = 0; step < 2; ++step)
      EXPECT_EQ(stepper.advance(state).newton_iterations, restarted.advance(copy).newton_iterations);
    EXPECT_EQ(copy.now.wall, state.now.wall) << time_scheme;
    EXPECT_EQ(copy.now.fluid, state.now.fluid) << time_scheme;
  }
}

TEST(RobinRobin, TimeSchemesThatRingAreRefused) {
  for (const std::string time_scheme : every_time_scheme)
    for (const std::string scheme : {"robin-robin", "robin-robin-corrected", "robin-robin-parallel"}) {
      const Case setup = short_pulse(scheme, 1e-6, time_scheme);
      const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
      const Loads loads(setup);
      const bool damps = time_scheme == "euler" || time_scheme == "bdf2" || time_scheme == "generalised-alpha";
      const bool served = scheme == "robin-robin-parallel"    ? time_scheme == "euler"
                          : scheme == "robin-robin-corrected" ? time_scheme == "euler" || time_scheme == "bdf2"
                                                              : damps;
      if (served)
        EXPECT_NO_THROW(make_coupling_stepper(*scene, loads, setup)) << scheme << ", " << time_scheme;
      else
        EXPECT_THROW(make_coupling_stepper(*scene, loads, setup), InputError) << scheme << ", " << time_scheme;
    }
}

// A domain that is extrapolated by the second order leaves an error of that order at least, whatever the time scheme.
TEST(SemiImplicit, ErrorOfTheDomainFallsWithTheSquareOfTheStep) {
  for (const std::string time_scheme : every_time_scheme) {
    const auto error = [&](double step) {
      Case setup = short_pulse("semi-implicit", 1e-9, time_scheme, step);
      setup.inlet = smooth_pulse();
      return loose_error(setup);
    };
    const double coarse = error(1. / 16), middle = error(1. / 32), fine = error(1. / 64);
    std::cout << time_scheme << ": errors " << coarse << ", " << middle << ", " << fine << '\n';
    EXPECT_GT(std::log2(coarse / middle), 1.8) << time_scheme;
    EXPECT_GT(std::log2(middle / fine), 1.8) << time_scheme;
    EXPECT_LT(fine, 1e-4) << time_scheme;
  }
}

// At the end of a step velocities are one on the interface and forces balance, while the domain is where it was
// extrapolated to. A restart goes on with the same bits, and says the same of the domain.
TEST(SemiImplicit, MediaAgreeOnTheExtrapolatedDomain) {
  Case setup = short_pulse("semi-implicit", 1e-9, "euler", 0.125);
  setup.inlet = PressureTable{{{0.0, 4.0}, {0.125, 4.0}, {0.125, 0.0}}};
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  stepper.keep_balances(true);
  State state = scene->at_rest();
  for (int step = 0; step < 4; ++step) {
    State predicted = state;
    StepData data = loads.next(predicted, *scene->integrator);
    scene->integrator->predict(predicted, 2, data);
    const Balance balance = stepper.advance(state).balances.front();
    std::vector<double> rows;
    scene->assemble_fluid(balance.at, balance.data, rows);
    const StepRates& rates = balance.data.rates;
    double velocity = 0, force = 0, apart = 0, domain = 0;
    for (const auto& node : scene->interface) {
      if (node.clamped) continue;
      for (int k = 0; k < 2; ++k) {
        const std::size_t f = MixedLayout<2>::vector(node.fluid, k), w = MixedLayout<2>::vector(node.wall, k),
                          m = VectorLayout<2>::vector(node.fluid, k);
        const double v = rates.interface.velocity(balance.at.wall[w], rates.wall_reference[w]);
        velocity = std::max(velocity, std::abs(balance.at.fluid[f] - v));
        force = std::max(force, std::abs(rows[f] - balance.data.interface_load[w]));
        apart = std::max(apart, std::abs(balance.at.mesh[m] - predicted.now.wall[w]));
        domain = std::max(domain, std::abs(balance.at.mesh[m] - balance.at.wall[w]));
      }
    }
    EXPECT_LT(velocity, 1e-8 * largest(balance.at.fluid)) << step;
    EXPECT_LT(force, 1e-7 * largest(rows)) << step;
    EXPECT_LT(apart, 1e-14) << step;
    EXPECT_GT(domain, 1e-5) << step;
  }
  EXPECT_NE(stepper.unchecked().find("of the vessel's radius"), std::string::npos)
      << "the step is as long as the pulse";
  Coupled restarted(*scene, loads, setup);
  WrittenArchive archive = archive_of(stepper);
  restarted.keep(archive.turn());
  EXPECT_EQ(restarted.unchecked(), stepper.unchecked());
  State again = state;
  stepper.advance(state);
  restarted.advance(again);
  EXPECT_EQ(again.now.wall, state.now.wall);
  EXPECT_EQ(again.now.fluid, state.now.fluid);
  EXPECT_EQ(again.now.mesh, state.now.mesh);
}

// Nothing has a natural size: with a load that is a million million times smaller fluid and wall agree as well.
TEST(CouplingStepper, AgreesForLoadsOfAnySize) {
  for (const double pressure : {1e-3, 1e-15, 1e-60}) {
    Case setup = partitioned_case("iqn-ils", 1e-6);
    setup.inlet = PressureTable{{{0.0, pressure}}};
    const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
    const Loads loads(setup);
    Coupled stepper(*scene, loads, setup);
    State state = scene->at_rest();
    const StepReport report = stepper.advance(state);
    EXPECT_GT(report.coupling->displacement_residual, 0) << pressure;
    EXPECT_LE(report.coupling->displacement_residual, 1e-6) << pressure;
    EXPECT_LE(report.coupling->force_residual, 1e-3) << pressure;
  }
}

TEST(CouplingStepper, WithoutALoadNothingMoves) {
  Case setup = partitioned_case("iqn-ils", 1e-6);
  setup.inlet = PressureTable{{{0.0, 0.0}}};
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  for (int step = 0; step < 3; ++step) EXPECT_EQ(stepper.advance(state).outer_iterations, 1);
  EXPECT_EQ(largest(state.now.wall), 0);
  EXPECT_EQ(largest(state.now.fluid), 0);
}

TEST(CouplingStepper, ExplicitWithoutExtrapolationIsRefused) {
  Case setup = partitioned_case("explicit", 1e-6);
  setup.time->predictor = 0;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  EXPECT_THROW(make_coupling_stepper(*scene, loads, setup), InputError);
}

TEST(CouplingStepper, ExplicitIsRefusedWhereItsGapRings) {
  for (const std::string time_scheme : every_time_scheme) {
    const Case setup = short_pulse("explicit", 1e-6, time_scheme);
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
    const Loads loads(setup);
    const bool rings = time_scheme == "midpoint" || time_scheme == "tr-bdf2";
    if (rings)
      EXPECT_THROW(make_coupling_stepper(*scene, loads, setup), InputError);
    else
      EXPECT_NO_THROW(make_coupling_stepper(*scene, loads, setup));
  }
}

TEST(CouplingStepper, ADivergingIterationEndsEarly) {
  Case setup = partitioned_case("constant", 1e-6);
  setup.partitioned.relaxation = 3;             // more than 2 diverges without any added mass
  setup.inlet = PressureTable{{{0.0, 1e-12}}};  // so small that no element is inverted on the way
  setup.partitioned.absolute_tolerance = 0;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  try {
    stepper.advance(state);
    FAIL();
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("diverges"), std::string::npos) << error.what();
  }
  EXPECT_LT(stepper.report().outer_iterations, 200);
  EXPECT_EQ(state.step, 0);
}

TEST(CouplingStepper, ObeysTheForceTolerance) {
  Case setup = partitioned_case("iqn-ils", 1e-2);
  setup.partitioned.force_tolerance = 1e-8;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_LE(report.coupling->force_residual, 1e-8);
}

TEST(CouplingStepper, AbsoluteToleranceIsEnough) {
  Case setup = partitioned_case("iqn-ils", 1e-12);
  setup.partitioned.absolute_tolerance = 1e-4;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_LE(report.coupling->displacement_gap, 1e-4);
  EXPECT_GT(report.coupling->displacement_residual, 1e-12);
}

TEST(CouplingStepper, APassWithoutAnswerIsTriedAgainCloser) {
  // A strong push and far too large a first relaxation: the first correction turns elements inside out.
  Case setup = partitioned_case("iqn-ils", 1e-6);
  setup.partitioned.relaxation = 1.5;
  setup.inlet = PressureTable{{{0.0, 40.0}}};
  setup.stabilisation = Stabilisation::paper;  // softer: the default bears this push
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  const StepReport report = stepper.advance(state);
  EXPECT_GT(report.coupling->failed_passes, 0);
  EXPECT_LE(report.coupling->displacement_residual, 1e-6);
}

TEST(CouplingStepper, SaysWhenItDoesNotConvergeAndLeavesTheFinishedLevels) {
  Case setup = partitioned_case("iqn-ils", 1e-10);
  setup.partitioned.max_iterations = 2;
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  try {
    stepper.advance(state);
    FAIL();
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("partitioned.max_iterations"), std::string::npos) << error.what();
  }
  EXPECT_EQ(state.step, 0);
  EXPECT_EQ(largest(state.before[0].wall), 0);
  EXPECT_EQ(stepper.report().outer_iterations, 2);
}

TEST(CouplingStepper, AToleranceLeavesThePressureTheSameErrorAtEachStepLength) {
  const auto worst = [](const std::string& time_scheme, double step, ToleranceOf kind) {
    Case setup = short_pulse("robin-neumann-iqn", 1e-3, time_scheme, step);
    setup.partitioned.tolerance_of = kind;
    const auto apart = pressures_apart(setup, static_cast<int>(std::lround(0.25 / step)));
    return *std::max_element(apart.begin(), apart.end());
  };
  for (const std::string time_scheme : every_time_scheme)
    for (const double step : {0.0625, 0.015625})  // some steps' errors meet
      EXPECT_LT(worst(time_scheme, step, ToleranceOf::pressure), 2e-2) << time_scheme << ", " << step << " ms";
  EXPECT_GT(worst("midpoint", 0.0078125, ToleranceOf::displacement), 0.1) << "so that the above means something";
}

// A run whose inexact passes have led nowhere goes on with passes that solve both media, after a restart, too.
TEST(CouplingStepper, GoesOnBySolvedPassesWhereInexactOnesWereGivenUp) {
  const Case setup = short_pulse("robin-neumann-inexact", 1e-9, "euler");
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery()),
             other = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
  const Loads loads(setup);
  NewtonOptions newton;
  newton.tolerance = 1e-11;
  NewtonStepper<2> whole(*scene, loads, newton, number_scene(*scene));
  Coupled inexact(*other, loads, setup), solved(*other, loads, setup);
  WrittenArchive given_up = archive_of(inexact);
  EXPECT_EQ(given_up.numbers.count("solved_passes"), 0U);
  given_up.numbers["solved_passes"] = 1;
  solved.keep(given_up.turn());
  State a = scene->at_rest(), b = other->at_rest();
  for (int step = 0; step < 3; ++step) {
    whole.advance(a);
    const StepReport report = solved.advance(b);
    EXPECT_GT(report.newton_iterations, 3 * report.outer_iterations) << "inexact passes take about two";
    EXPECT_LT(norm(difference(a.now.wall, b.now.wall)), 1e-6 * norm(a.now.wall)) << "step " << step + 1;
  }
  EXPECT_EQ(archive_of(solved).numbers.count("solved_passes"), 1U);
}

/// TR-BDF2 whose second stages meet a load that no wall bears, once `breaks` is set.
class Breaking : public TimeIntegrator {
 public:
  explicit Breaking(const bool& breaks) : breaks_(breaks) {}
  ErrorTerms error_terms() const override { return scheme_.error_terms(); }
  void prepare(State& state) const override { scheme_.prepare(state); }
  int stages(const State& state) const override { return scheme_.stages(state); }
  void predict(State& state, int order, const StepData& data) const override { scheme_.predict(state, order, data); }
  std::array<double, 3> balance_weights(const State& state, int order, const StepData& data) const override {
    return scheme_.balance_weights(state, order, data);
  }
  void accept(State& state, const StepData& data) const override { scheme_.accept(state, data); }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override {
    StepRates rates = scheme_.rates(state, step, stage);
    if (breaks_ && stage == 1) rates.load = {{0, 0.01, 1e9}};
    return rates;
  }
  TrBdf2<2> scheme_;
  const bool& breaks_;
};

TEST(CouplingStepper, AFailedSecondStageLeavesNoTrace) {
  const Case setup = short_pulse("robin-neumann-iqn", 1e-6, "tr-bdf2");
  const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
  bool breaks = false;
  scene->integrator = std::make_unique<Breaking>(breaks);
  const Loads loads(setup);
  Coupled stepper(*scene, loads, setup);
  State state = scene->at_rest();
  stepper.advance(state);
  const WrittenArchive before = archive_of(stepper);
  EXPECT_GT(largest(before.arrays.at("load1")), 0) << "of the first stage";
  breaks = true;
  EXPECT_THROW(stepper.advance(state), ConvergenceError);
  EXPECT_EQ(state.step, 1);
  for (const char* load : {"load0", "load1", "load2"})
    EXPECT_EQ(archive_of(stepper).arrays.at(load), before.arrays.at(load));
  breaks = false;
  stepper.advance(state);
  EXPECT_EQ(archive_of(stepper).arrays.at("load2"), before.arrays.at("load0"));
}

/// What an adaptive step does: the same stepper, after a step that did not converge, is asked again.
TEST(CouplingStepper, GoesOnAfterAStepThatFailed) {
  for (const char* scheme : {"robin-neumann-iqn", "iqn-imvj", "newton-krylov", "aitken"}) {
    Case setup = short_pulse(scheme, 1e-4, "midpoint");
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery()),
               other = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
    const Loads loads(setup);
    Coupled stepper(*scene, loads, setup);
    Coupled undisturbed(*other, loads, setup);
    State state = scene->at_rest();
    State same = state;
    stepper.advance(state);
    undisturbed.advance(same);
    State broken = state;
    for (double& u : broken.before[0].fluid) u *= 1e6;
    for (double& u : broken.before[0].mesh) u *= 1e6;
    EXPECT_THROW(stepper.advance(broken), ConvergenceError) << scheme;
    const WrittenArchive before = archive_of(undisturbed), after = archive_of(stepper);
    for (const auto& [name, values] : before.arrays) {
      const bool is_kept =
          name.rfind("load", 0) == 0 || name.rfind("iqn", 0) == 0 || name.rfind("newton_krylov", 0) == 0;
      if (!is_kept || name.find(".age") != std::string::npos) continue;
      EXPECT_EQ(values, after.arrays.at(name)) << scheme << ": " << name;
    }
    stepper.advance(state);
    undisturbed.advance(same);
    EXPECT_LT(norm(difference(state.now.wall, same.now.wall)), 1e-3 * norm(same.now.wall)) << scheme;
  }
}

TEST(CouplingStepper, KeepsDifferencesThroughAChangeOfStep) {
  // A fifth step half as long, with and without what the first four taught. Three hold little but the pulse's beginning.
  for (const char* scheme : {"iqn-ils", "iqn-imvj", "robin-neumann-iqn", "robin-neumann-imvj"}) {
    Case setup = short_pulse(scheme, 1e-6, "midpoint"), shorter = setup;
    shorter.time->step = 0.03125;
    const auto scene = build_scene<P2P1AxisymmetricTriangle>(setup, short_artery());
    const Loads loads(setup);
    Coupled stepper(*scene, loads, setup);
    State state = scene->at_rest();
    for (int n = 0; n < 4; ++n) stepper.advance(state);
    const WrittenArchive archive = archive_of(stepper);
    std::array<int, 2> passes{};
    for (const bool kept : {false, true}) {
      const auto fresh = build_scene<P2P1AxisymmetricTriangle>(shorter, short_artery());
      Loads finer(shorter);
      finer.axis().go_on(loads.axis().stretches(), state.step, state.time);
      Coupled next(*fresh, finer, shorter);
      WrittenArchive known = archive;
      if (!kept)
        for (const char* name : {"iqn_ils.age", "iqn_ils.v", "iqn_ils.w"}) known.arrays[name].clear();
      if (!kept) known.numbers["iqn_imvj.rank"] = 0;
      next.keep(known.turn(true));
      State copy = state;
      passes[kept ? 1 : 0] = next.advance(copy).outer_iterations;
      EXPECT_DOUBLE_EQ(copy.time, state.time + 0.03125);
    }
    EXPECT_LT(passes[1], passes[0]) << scheme;
  }
}

}  // namespace

}  // namespace fsi::test
