// Openings whose pressure answers the flow: their share in the residual, and Newton's corrections with it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "case/network_data.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "linear/choice/general_solvers.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/nodal_arrays.hpp"
#include "support/opening_laws.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "system/medium_system.hpp"
#include "system/numbering.hpp"

namespace fsi::test {

namespace {

constexpr double initial_pressure = 0.8;
const OpeningLawData at_outlet = windkessel(0.3, 0.05, 2.0, 0.5, initial_pressure),
                     at_inlet{"resistance", {{"resistance", 1.5}, {"distal_pressure", 0.2}}};

/// Both openings lead through a resistance and a valve to one compliance.
std::shared_ptr<const NetworkData> joining_both() {
  NetworkData data;
  data.ground_pressure = 0.1;
  data.elements = {{"r", "resistor", "inlet", "m", {{"resistance", 1.5}}},
                   {"v", "valve", "outlet", "m", {{"resistance", 0.4}, {"quadratic", 2}, {"leak", 0.01}}},
                   {"c", "capacitor", "m", "ground", {{"compliance", 0.05}, {"initial_pressure", 0.8}}},
                   {"d", "resistor", "m", "ground", {{"resistance", 2}}}};
  return std::make_shared<const NetworkData>(data);
}

/// The fluid of a box at a random state, a Windkessel at the outlet and perhaps a resistance at the inlet, or a network.
struct OpenFluid {
  std::unique_ptr<Scene<3>> scene;
  State state;
  StepData data;

  explicit OpenFluid(bool both = true, bool network = false) {
    Case setup = coupled_case("neo-hookean");
    if (network) {
      setup.inlet.reset();
      for (const char* surface : {"inlet", "outlet"}) setup.openings[surface].joined = true;
      setup.network = joining_both();
    } else {
      setup.openings["outlet"].law = at_outlet;
    }
    if (both && !network) {
      setup.inlet.reset();
      setup.openings["inlet"].law = at_inlet;
    }
    for (auto& [surface, conditions] : setup.openings) conditions.backflow = 0;
    scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
    state = scene->at_rest();
    data.rates = scene->integrator->rates(state, 0.125);
    data.opening_pressures = {0.1, 0.2};
    state.now.fluid = random_field(scene->fluid->nodes().nodes, 4, 0.3, 1e-3, 1);
  }
  std::unique_ptr<System<3>> system() {
    auto made = std::make_unique<System<3>>("fluid", *scene, number_fluid(*scene));
    made->work_on(state, data);
    return made;
  }
};

TEST(OpeningTerms, PressAsTheirLawSays) {
  OpenFluid open;
  const auto& boundaries = open.scene->fluid->open_boundaries();
  ASSERT_EQ(boundaries.size(), 2u);
  EXPECT_EQ(open.state.now.openings, std::vector<double>{initial_pressure});
  std::vector<double> with, without;
  open.scene->assemble_fluid(open.state.now, open.data, with);
  Case plain = coupled_case("neo-hookean");
  const auto other = build_scene<P1Tetrahedron>(plain, fluid_and_wall_box(2));
  other->fluid->assemble(other->fluid_input(open.state, open.data.rates), open.data.opening_pressures, without);
  for (const auto& boundary : boundaries) {
    const double flow = boundary.outflow(open.state.now.fluid);
    const auto& law = boundary.name() == "outlet" ? at_outlet : at_inlet;
    boundary.add_pressure(law.make()->pressure(open.data.rates.fluid_factor, &initial_pressure, flow), without);
  }
  EXPECT_LT(largest(difference(with, without)), 1e-13);
}

/// The residual's derivative along Newton's correction is the residual's opposite: by differences, which know nothing of
/// how the correction was found.
void expect_exact_corrections(const std::string& solver, bool coupled, double linear_tolerance, double tolerance,
                              bool network = false) {
  OpenFluid open(true, network);
  FastOptions iterative;
  iterative.direct_below = 0;
  const auto system = std::make_unique<System<3>>("tested", *open.scene,
                                                  coupled ? number_scene(*open.scene) : number_fluid(*open.scene),
                                                  general_solver_factory<3>(solver, iterative));
  for (const double period : {1.0, 2.0}) {  // the second time with another slope
    open.data.rates = open.scene->integrator->rates(open.state, 0.125 * period);
    system->work_on(open.state, open.data);
    system->evaluate();
    const std::vector<double> residual = system->residual();
    system->linearise();
    system->solve(linear_tolerance);
    const double size = norm(residual), step = 1e-5;
    system->move(step);
    system->evaluate();
    std::vector<double> ahead = system->residual();
    system->move(-2 * step);
    system->evaluate();
    const std::vector<double> behind = system->residual();
    system->move(step);
    for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = (ahead[i] - behind[i]) / (2 * step) + residual[i];
    EXPECT_LT(norm(ahead), tolerance * size) << solver << ", " << period;
  }
}

TEST(OpeningTerms, AreInCorrectionsByFactorisation) {
  expect_exact_corrections("direct", false, 1e-12, 1e-7);
  expect_exact_corrections("direct", true, 1e-12, 1e-7);
}

TEST(OpeningTerms, AreInCorrectionsByIteration) {
  expect_exact_corrections("fast", false, 1e-8, 1e-7);
  expect_exact_corrections("fast", true, 1e-8, 1e-7);
}

TEST(OpeningTerms, OfANetworkAreInCorrections) {
  for (const bool coupled : {false, true}) {
    expect_exact_corrections("direct", coupled, 1e-12, 1e-7, true);
    expect_exact_corrections("fast", coupled, 1e-8, 1e-7, true);
  }
}

/// The pressures of both openings are those of the network at both flows, and neither is there without the other's.
TEST(OpeningTerms, OfANetworkJoinOpenings) {
  OpenFluid open(true, true);
  const auto& joined = open.scene->openings.joined();
  ASSERT_EQ(joined.openings().size(), 2u);
  const FluidInput in = open.scene->fluid_input(open.state, open.data.rates);
  const auto& rates = open.data.rates;
  const std::vector<double> slopes = joined.slopes(in, rates.time, rates.openings_reference);
  EXPECT_GT(slopes[1], 0.1);
  EXPECT_NEAR(slopes[1], slopes[2], 1e-12 * slopes[1]) << "passive elements answer symmetrically";
  std::vector<double> flows;
  for (const auto& opening : joined.openings()) flows.push_back(opening.surface->relative_outflow(in));
  const NetworkState state =
      joined.network().solve({1 / rates.fluid_factor, rates.time}, rates.openings_reference.data(), flows);
  const std::vector<double> pressures = open.scene->opening_pressures(open.state.now, open.data);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(pressures[i], open.data.opening_pressures[i] + state.pressures[i], 1e-14);
  EXPECT_FALSE(joined.outdated());
}

/// A resistance a thousand times that of the fluid lets nothing through: the correction takes the flow away.
TEST(OpeningTerms, HoldTheFlowBack) {
  OpenFluid open;
  const auto system = open.system();
  system->evaluate();
  const std::vector<double> residual = system->residual();
  system->linearise();
  const auto& outlet = open.scene->fluid->open_boundaries().back();
  const auto flow_of = [&](const std::vector<double>& x) {
    std::vector<double> flow(system->numbering().fluid.size(), 0.0);
    add_to_field(system->numbering().fluid, x, 1, flow);
    return outlet.outflow(flow);
  };
  const auto flow_with = [&](double slope) {
    const std::vector<OpeningTerm> terms{{&outlet.normals(), slope}};
    LowRankLinearSolver<3> solver(system->blocks(), std::make_unique<DirectLinearSolver<3>>(system->blocks()), terms);
    solver.update();
    std::vector<double> x;
    solver.solve(residual, 1e-12, x);
    return flow_of(x);
  };
  const double free = flow_with(0), answer = free / flow_with(1) - 1;  // Q = Q_0 / (1 + slope w^T A^-1 w)
  EXPECT_GT(answer, 0);
  EXPECT_NEAR(flow_with(1e4), free / (1 + 1e4 * answer), 1e-9 * std::abs(free));
}

/// A flow that is given beside a resistance: its pressure balances the equations, whichever solver is behind.
TEST(OpeningTerms, FindThePressureOfAGivenFlow) {
  OpenFluid open;
  const auto system = open.system();
  system->evaluate();
  std::vector<double> b = system->residual();
  system->linearise();
  const auto& numbering = system->numbering();
  const auto &inlet = open.scene->fluid->open_boundaries()[0], &outlet = open.scene->fluid->open_boundaries()[1];
  constexpr double slope = 2.0, given = 0.3;
  FastOptions iterative;
  iterative.direct_below = 0;
  for (const std::string name : {"direct", "fast"})
    for (const double share : {1.0, 0.0}) {  // of the residual: at last the gap is all there is
      for (double& row : b) row *= share;
      std::vector<OpeningTerm> terms{{&inlet.normals(), slope}, {&outlet.normals(), 0, nullptr, true, given}};
      LowRankLinearSolver<3> solver(system->blocks(), general_solver_factory<3>(name, iterative)(system->blocks()),
                                    terms);
      solver.update();
      EXPECT_EQ(solver.medium_preconditioner(), nullptr) << "no cycle knows a pressure that is an unknown";
      std::vector<double> x, rows;
      ASSERT_TRUE(solver.solve(b, 1e-10, x).converged) << name;
      std::vector<double> flow(numbering.fluid.size(), 0.0), forces = flow;
      add_to_field(numbering.fluid, x, 1, flow);
      EXPECT_NEAR(outlet.outflow(flow), given, 1e-11);
      JacobianProduct<3>(system->blocks()).multiply(x, rows);
      inlet.add_pressure(slope * inlet.outflow(flow), forces);
      outlet.add_pressure(solver.pressures()[1], forces);
      EXPECT_GT(std::abs(solver.pressures()[1]), 1e-3);
      const double size = norm(forces);
      add_to_system(numbering.fluid_rows, forces, rows);
      EXPECT_LT(norm(difference(rows, b)), 1e-8 * (size + norm(b))) << name << ", " << share;
    }
}

/// Who iterates over several systems has a way of his own where one of them does not get there.
TEST(OpeningTerms, AreNotFactorisedForWhoAsksForCycles) {
  OpenFluid open;
  FastOptions few;
  few.direct_below = 0;
  few.max_iterations = few.restart = 1;
  MediumSystem<3> system("tested", *open.scene, number_fluid(*open.scene), general_solver_factory<3>("fast", few));
  system.work_on(open.state, open.data);
  system.evaluate();
  system.linearise();
  const auto rescues = [&] {
    const auto& counters = open.scene->profile.counters();
    const auto found = counters.find("linear solves rescued by factorisation");
    return found == counters.end() ? 0 : found->second;
  };
  EXPECT_EQ(system.preconditioner(), nullptr);
  EXPECT_TRUE(system.is_iterative());
  EXPECT_EQ(rescues(), 0);
  system.solve(1e-6);
  EXPECT_EQ(rescues(), 1);
  EXPECT_EQ(system.preconditioner(), nullptr) << "it is factorised";
}

TEST(OpeningTerms, AreNotBuiltWithoutThem) {
  const auto scene = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(2));
  System<3> fluid("fluid", *scene, number_fluid(*scene)), wall("wall", *scene, number_wall(*scene));
  EXPECT_NE(dynamic_cast<const DirectLinearSolver<3>*>(&fluid.solver()), nullptr);
  OpenFluid open(false);
  EXPECT_NE(dynamic_cast<const LowRankLinearSolver<3>*>(&open.system()->solver()), nullptr);
  System<3> own_wall("wall", *open.scene, number_wall(*open.scene));
  EXPECT_NE(dynamic_cast<const DirectLinearSolver<3>*>(&own_wall.solver()), nullptr);
}

}  // namespace

}  // namespace fsi::test
