// The energy balance (docs/energy.md): its terms are evaluated one by one, so what is left over of them tells of every
// mistake in any.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "diagnostics/energy_balance.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/nodal_arrays.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::energy_tests {

namespace {

template <class Element>
SimplexMesh<3, Element::order> box(int n) {
  if constexpr (Element::order == 1)
    return fluid_and_wall_box(n);
  else
    return with_mid_edge_nodes(fluid_and_wall_box(n));
}

[[maybe_unused]] const int single_thread = set_threads(1);

/// No term small beside the others: softer volume, more viscous fluid, longer step than the artery's.
Case lively_case(const std::string& material) {
  Case setup = coupled_case(material, 0.5);
  setup.fluid = FluidData{1.3, 0.5, true, true};
  setup.structure->bulk_modulus = 50;
  setup.structure->stabilisation = 0.5;  // no term drowns in another
  setup.structure->axis_origin = {0.4, 0.5, -1.0};
  setup.structure->axis_direction = {0, 1, 0};
  setup.time->scheme_values["newmark_beta"] = 0.4;
  setup.time->scheme_values["newmark_gamma"] = 0.7;
  return setup;
}

void impose_boundary(const Scene<3>& scene, Solution& level) {
  for (int a = 0; a < scene.fluid->node_count(); ++a)
    for (int k = 0; k < 3; ++k) {
      if (scene.velocity_conditions.fixes(a)) level.fluid[4 * a + k] = 0;
      if (scene.mesh_conditions.fixes(a)) level.mesh[3 * a + k] = 0;
    }
  for (int a = 0; a < scene.wall->node_count(); ++a)
    for (int k = 0; k < 3; ++k)
      if (scene.wall_conditions.fixes(a)) level.wall[4 * a + k] = 0;
}

/// Schemes in time, the midpoint rule with a shift that is no trifle.
const std::vector<std::string> all_schemes{"euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2"};

/// Steps whose balances solve nothing.
template <class Element>
class ArbitrarySteps {
 public:
  explicit ArbitrarySteps(const Case& setup) : scene_(build_scene<Element>(setup, box<Element>(4 - Element::order))) {
    state_ = scene_->at_rest();
    state_.now = around();
    state_.before = {state_.now, state_.now, state_.now};
    scene_->integrator->prepare(state_);
    if (!state_.load_rates.empty()) state_.load_rates = {0.5, -0.2, 0};
    const auto& y = scene_->wall->nodes().nodes;
    state_.wall_velocity = state_.wall_velocity_before = random_field(y, 3, 0.5, 0.1, 7);
    state_.wall_acceleration = random_field(y, 3, 0.5, 0.1, 8);
    energy_.emplace(*scene_, state_);
  }

  /// The balance of energy of a step of this length, ms.
  EnergyRecord advance(double step, bool ends_at_jump = false) {
    const TimeIntegrator& integrator = *scene_->integrator;
    StepReport report;
    tested_residual_ = 0;
    std::vector<double> wall_before = state_.last_balance().wall;
    const int stages = integrator.stages(state_);
    for (int stage = 0; stage < stages; ++stage) {
      StepData data;
      data.time = state_.time + step;
      data.ends_at_jump = ends_at_jump;
      data.rates = integrator.rates(state_, step, stage);
      data.opening_pressures = {1.3 + 0.1 * seed_, -0.4};
      const Solution near = around(&state_.before[0]);
      state_.now = near;
      scene_->impose_interface(state_, data.rates);
      if (data.rates.previous_weight != 0) test(last_, data.rates.previous_weight * step, nullptr);
      last_ = {state_.now, data};
      test(last_, data.rates.weight * step, &wall_before);
      wall_before = state_.now.wall;
      report.balances.push_back(last_);
      integrator.accept(state_, data);
    }
    report.level = level_energy(*scene_, state_);
    return energy_->step_to(state_, report);
  }

  /// The last step's residuals tested with what the balance is made by.
  double tested_residual() const { return tested_residual_; }
  const Scene<3>& scene() const { return *scene_; }
  State& state() { return state_; }
  const Balance& last_balance() const { return last_; }

 private:
  /// Fields that keep the boundary conditions: always the same ones, a little changed towards those of a level.
  Solution around(const Solution* level = nullptr) {
    const auto& x = scene_->fluid->nodes().nodes;
    const auto& y = scene_->wall->nodes().nodes;
    const auto fields_of = [&](double scale, unsigned seed) {
      Solution fields{random_field(x, 3, 0.06 * scale, 0.01 * scale, seed),
                      random_field(x, 4, 3 * scale, 0.5 * scale, seed + 1),
                      random_field(y, 4, 0.06 * scale, 0.005 * scale, seed + 2)};
      for (std::size_t i = 3; i < fields.wall.size(); i += 4) fields.wall[i] *= 20;  // kPa
      return fields;
    };
    const Solution base = fields_of(1, 1), change = fields_of(0.15, 4 + 3 * seed_++);
    Solution fields{moved(base.mesh, 1, change.mesh), moved(base.fluid, 1, change.fluid),
                    moved(base.wall, 1, change.wall)};
    if (level)  // so that levels far from the balance do not run away
      for (auto field : {&Solution::mesh, &Solution::fluid, &Solution::wall})
        for (std::size_t i = 0; i < (fields.*field).size(); ++i)
          (fields.*field)[i] = 0.5 * ((fields.*field)[i] + (level->*field)[i]);
    impose_boundary(*scene_, fields);
    for (const auto& node : scene_->interface)
      for (int k = 0; k < 3; ++k) fields.mesh[3 * node.fluid + k] = fields.wall[4 * node.wall + k];
    return fields;
  }

  /// Adds the residual of a balance tested for a duration; volume as the difference to the balance before, if given.
  void test(const Balance& balance, double duration, const std::vector<double>* wall_before) {
    const StepRates& rates = balance.data.rates;
    const Solution& at = balance.at;
    std::vector<double> fluid, wall, before(at.wall.size(), 0.0);
    scene_->assemble_fluid(at, balance.data, fluid);
    const WallInput in = scene_->wall_input(at, rates);
    scene_->wall->assemble(in, 0, at.wall, wall);
    if (wall_before) {
      WallInput old = in;
      old.wall = wall_before->data();
      scene_->wall->assemble(old, 0, *wall_before, before);
    }
    for (std::size_t i = 0; i < fluid.size(); ++i)
      tested_residual_ += (i % 4 == 3 ? -duration : duration) * fluid[i] * at.fluid[i];
    for (std::size_t i = 0; i < wall.size(); ++i)
      if (i % 4 != 3)
        tested_residual_ += duration * wall[i] * rates.interface.velocity(at.wall[i], rates.wall_reference[i]);
      else if (wall_before)
        tested_residual_ -= (wall[i] - before[i]) * at.wall[i];
  }

  std::unique_ptr<Scene<3>> scene_;
  State state_;
  std::optional<EnergyBalance<3>> energy_;
  Balance last_;
  double tested_residual_ = 0;
  unsigned seed_ = 0;
};

// The terms are integrals of their own; together they are the weak forms, tested, of any balances: in steps of unequal
// lengths, before and after a jump of the load.
template <class Element>
void check_arbitrary_steps(const std::string& material) {
  for (const std::string& scheme : all_schemes) {
    Case setup = lively_case(material);
    setup.time->scheme = scheme;
    setup.time->scheme_values["damping"] = 0.2;
    ArbitrarySteps<Element> steps(setup);
    std::vector<double> seen;  // of each term the largest
    double off = 0;
    for (const auto& [step, jump] : std::vector<std::pair<double, bool>>{
             {0.5, false}, {0.5, false}, {0.3, false}, {0.6, true}, {0.4, false}, {0.5, false}}) {
      const EnergyRecord e = steps.advance(step, jump);
      std::vector<double> terms{e.fluid_kinetic, e.wall_kinetic,      e.wall_isochoric,   e.wall_volumetric,
                                e.inlet_work,    e.inlet_kinetic,     e.outlet_kinetic,   e.viscous,
                                e.fluid_inertia, e.fluid_mesh_motion, e.fluid_divergence, e.wall_inertia,
                                e.wall_stress};
      if (Element::stabilised)
        terms.insert(terms.end(), {e.fluid_stabilisation, e.wall_stabilisation});
      else
        terms.push_back(e.fluid_quadrature);
      seen.resize(terms.size());
      for (std::size_t i = 0; i < terms.size(); ++i) seen[i] = std::max(seen[i], std::abs(terms[i]));
      EXPECT_GT(std::abs(steps.tested_residual()), 1);
      off = std::max(off, std::abs(e.remainder + steps.tested_residual()));
      if (Element::stabilised) {
        EXPECT_EQ(e.fluid_quadrature, 0);
      }
    }
    const auto [smallest, largest] = std::minmax_element(seen.begin(), seen.end());
    fmt::print("{}, {}: off the residual by {:.1e}; smallest and largest term {:.1e} {:.1e}\n", material, scheme, off,
               *smallest, *largest);
    EXPECT_GT(*smallest, 2e-5);  // seen if it were wrong
    EXPECT_LT(off, 1e-12) << scheme;
  }
}

TEST(EnergyBalance, LeavesOverTheTestedResidualOfArbitraryBalances) {
  for (const auto* material : {"neo-hookean", "mooney-rivlin", "artery"})
    check_arbitrary_steps<P1Tetrahedron>(material);
}

TEST(EnergyBalance, LeavesOverTheTestedResidualOfArbitraryTaylorHoodBalances) {
  for (const auto* material : {"neo-hookean", "artery"}) check_arbitrary_steps<P2P1Tetrahedron>(material);
}

// A term of its own, beside the numerical dissipation.
template <class Element>
void check_arbitrary_backflow() {
  for (const std::string& scheme : all_schemes) {
    Case setup = lively_case("neo-hookean");
    setup.time->scheme = scheme;
    setup.time->scheme_values["damping"] = 0.2;
    ArbitrarySteps<Element> steps(setup);
    EXPECT_FALSE(EnergyBalance<3>::parts_of(steps.scene()).backflow);
    steps.scene().fluid->stabilise_backflow(0, 0.7);
    steps.scene().fluid->stabilise_backflow(1, 0.4);
    EXPECT_TRUE(EnergyBalance<3>::parts_of(steps.scene()).backflow);
    for (double step : {0.5, 0.3}) {
      const EnergyRecord e = steps.advance(step);
      EXPECT_GT(e.backflow, 0.01);
      EXPECT_NEAR(e.remainder, -steps.tested_residual(), 1e-12) << scheme;
    }
  }
}

TEST(EnergyBalance, CountsWhatTheStabilisationOfBackflowTakes) {
  check_arbitrary_backflow<P1Tetrahedron>();
  check_arbitrary_backflow<P2P1Tetrahedron>();
}

// What Newmark's method and the midpoint rule take, in closed form (docs/energy.md): here the velocities at the ends of
// steps count, which the remainder does not see.
TEST(EnergyBalance, InertiaOfTheWallHasTheClosedFormOfItsScheme) {
  for (const std::string scheme : {"euler", "midpoint"}) {
    Case setup = lively_case("neo-hookean");
    setup.time->scheme = scheme;
    setup.time->scheme_values["damping"] = 0.2;
    ArbitrarySteps<P1Tetrahedron> steps(setup);
    const Wall<3>& wall = *steps.scene().wall;
    // (rho x, y) of vectors per node, by way of the residual
    const auto product = [&](const std::vector<double>& x, const std::vector<double>& y) {
      const std::vector<double> zero(x.size(), 0.0), flat(x.size() / 3 * 4, 0.0);
      std::vector<double> with, without;
      steps.scene().wall->assemble({flat.data(), x.data(), 0}, 0, flat, with);
      steps.scene().wall->assemble({flat.data(), zero.data(), 0}, 0, flat, without);
      double sum = 0;
      for (std::size_t i = 0; i < x.size(); ++i) sum += (with[i / 3 * 4 + i % 3] - without[i / 3 * 4 + i % 3]) * y[i];
      return sum;
    };
    for (double step : {0.5, 0.3}) {
      const State before = steps.state();
      const double taken = steps.advance(step).wall_inertia;
      const State& after = steps.state();
      const std::size_t size = 3 * static_cast<std::size_t>(wall.node_count());
      std::vector<double> x(size), y(size);
      for (std::size_t i = 0; i < size; ++i) {
        const double beta = 0.4, gamma = 0.7, theta = 0.5 + 0.2 * step;  // of lively_case()
        const double a0 = before.wall_acceleration[i], a1 = after.wall_acceleration[i];
        const std::size_t w = i / 3 * 4 + i % 3;
        const double moved = after.before[0].wall[w] - after.before[1].wall[w];
        const double faster = after.wall_velocity[i] - before.wall_velocity[i];
        x[i] = scheme == "euler" ? a1 - a0 : (theta - 0.5) * faster;
        y[i] = scheme == "euler"
                   ? (1 - gamma) * moved + (beta - gamma / 2) * step * step * (gamma * a1 + (1 - gamma) * a0)
                   : faster;
      }
      fmt::print("{}: inertia of the wall {:.6e}\n", scheme, taken);
      EXPECT_NEAR(taken, product(x, y), 1e-13) << scheme;
      EXPECT_GT(std::abs(taken), 1e-4);
    }
  }
}

// The balance that the next step's trapezoidal rule counts again, made of the state: on restart there is no other.
TEST(EnergyBalance, MakesTheLastBalanceAgainOfTheState) {
  Case setup = lively_case("neo-hookean");
  setup.time->scheme = "tr-bdf2";
  ArbitrarySteps<P1Tetrahedron> steps(setup);
  const TimeIntegrator& integrator = *steps.scene().integrator;
  EXPECT_FALSE(integrator.balance_again(steps.state())) << "the load may have jumped";
  for (double step : {0.5, 0.3}) {
    steps.advance(step);
    const Balance again = integrator.balance_again(steps.state()).value(), &solved = steps.last_balance();
    EXPECT_EQ(again.at.fluid, solved.at.fluid);
    EXPECT_EQ(again.data.opening_pressures, solved.data.opening_pressures);
    const StepRates &a = again.data.rates, &b = solved.data.rates;
    EXPECT_NEAR(a.fluid_factor, b.fluid_factor, 1e-13);
    EXPECT_NEAR(a.interface.period, b.interface.period, 1e-13);
    for (auto field : {&StepRates::mesh_reference, &StepRates::fluid_reference, &StepRates::wall_reference,
                       &StepRates::acceleration_history}) {
      ASSERT_EQ((a.*field).size(), (b.*field).size());
      for (std::size_t i = 0; i < (a.*field).size(); ++i) ASSERT_NEAR((a.*field)[i], (b.*field)[i], 1e-11);
    }
  }
  steps.advance(0.4, true);
  EXPECT_FALSE(integrator.balance_again(steps.state()));
}

/// A case marched to its end, and its balances. \param measured_as  the case that they are taken for; null: the same
template <class Element = P1Tetrahedron>
std::vector<EnergyRecord> march(const Case& setup, const SimplexMesh<3, Element::order>& mesh,
                                const Case* measured_as = nullptr, bool full = false) {
  const auto scene = build_scene<Element>(setup, mesh),
             other = build_scene<Element>(measured_as ? *measured_as : setup, mesh);
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = full ? 1e-13 : 1e-11;
  options.mode = full ? NewtonMode::full : NewtonMode::kept;
  NewtonStepper<3> stepper(*scene, loads, options, number_scene(*scene));
  stepper.keep_balances(true);
  State state = scene->at_rest();
  EnergyBalance<3> balance(*other, state);
  std::vector<EnergyRecord> records;
  while (state.step < loads.steps()) {
    StepReport report = stepper.advance(state);
    if (measured_as) report.level = level_energy(*other, state);
    records.push_back(balance.step_to(state, report));
  }
  return records;
}

/// A pressure that rises at the inlet of a viscous fluid lifts the wall above it.
Case rising_pressure(const std::string& material, double step) {
  Case setup = coupled_case(material, step);
  setup.fluid->viscosity = 1;
  setup.structure->axis_origin = {0.5, 0.5, -1};
  setup.structure->axis_direction = {0, 1, 0};
  setup.structure->bulk_modulus = 1e3;
  setup.inlet = PressureTable{{{0, 0}, {2, 2}}};
  setup.time->end = 2;
  return setup;
}

TEST(EnergyBalance, OfASolutionLeavesNothingOver) {
  const auto mesh = fluid_and_wall_box(2);
  for (const auto layer_pressure : {LayerPressure::continuous, LayerPressure::separate})
    for (const auto* material : {"neo-hookean", "mooney-rivlin", "artery"}) {
      Case setup = rising_pressure(material, 0.1);
      setup.structure->layer_pressure = layer_pressure;
      double work = 0, left_over = 0;
      for (const auto& record : march(setup, mesh)) {
        work += record.inlet_work;
        left_over = std::max(left_over, std::abs(record.remainder));
      }
      fmt::print("{}, pressure {}: work {:.3e}, left over at most {:.1e}\n", material,
                 layer_pressure == LayerPressure::separate ? "per layer" : "continuous", work, left_over);
      EXPECT_LT(left_over, (std::string(material) == "artery" ? 1e-6 : 1e-12) * work);
    }
}

// Steps of several lengths, some of them after a jump of the load: 0.1, 0.085, 0.03 and 0.1 ms, the last one shorter.
template <class Element>
void check_solutions_of_all_schemes(const SimplexMesh<3, Element::order>& mesh) {
  for (const std::string& scheme : all_schemes) {
    Case setup = rising_pressure("neo-hookean", 0.1);
    setup.inlet = PressureTable{{{0, 1}, {0.2, 1.4}, {0.2, 0.5}, {0.37, 0.8}, {0.37, 1.5}, {0.4, 1.5}, {0.4, 0}}};
    setup.time->end = 0.75;
    setup.time->scheme = scheme;
    double work = 0, left_over = 0;
    for (const auto& record : march<Element>(setup, mesh, nullptr, true)) {
      work += std::abs(record.inlet_work);
      left_over = std::max(left_over, std::abs(record.remainder));
    }
    fmt::print("{}: work {:.3e}, left over at most {:.1e}\n", scheme, work, left_over);
    EXPECT_GT(work, 5e-3);
    EXPECT_LT(left_over, 1e-10 * work) << scheme;  // pressures times what Newton's method leaves of volumes
  }
}

TEST(EnergyBalance, OfASolutionByAnySchemeLeavesNothingOver) {
  check_solutions_of_all_schemes<P1Tetrahedron>(fluid_and_wall_box(2));
}

TEST(EnergyBalance, OfATaylorHoodSolutionByAnySchemeLeavesNothingOver) {
  check_solutions_of_all_schemes<P2P1Tetrahedron>(with_mid_edge_nodes(fluid_and_wall_box(1)));
}

/// A cube of fluid, 1 mm wide, between an inlet, an outlet and four planes along which it slides.
TetrahedralMesh slug() {
  auto mesh = irregular_cube(2);
  for (const auto& [name, axis, value] : std::vector<std::tuple<const char*, int, double>>{{"inlet", 0, 0.0},
                                                                                           {"outlet", 0, 1.0},
                                                                                           {"symmetry_y", 1, 0.0},
                                                                                           {"symmetry_y", 1, 1.0},
                                                                                           {"symmetry_z", 2, 0.0},
                                                                                           {"symmetry_z", 2, 1.0}}) {
    const auto facets =
        facets_where(mesh, "fluid", [a = axis, v = value](const Point& x) { return std::abs(x[a] - v) < 1e-12; });
    if (!mesh.facet_groups.empty() && mesh.facet_groups.back().name == name)
      mesh.facet_groups.back().facets.insert(mesh.facet_groups.back().facets.end(), facets.begin(), facets.end());
    else
      mesh.facet_groups.push_back({name, facets});
  }
  return mesh;
}

// All of the slug has one velocity, u = I(t) / (rho L), whatever the pressure at the inlet does, I being its impulse.
// So the work of the inlet less what the scheme takes is I^2 / (2 rho L) at every step's end, for each scheme. What is
// taken has a closed form for the schemes of one step: half, or theta - 1/2, of the mass times the change of u squared.
TEST(EnergyBalance, WorkOfTheInletIsThatOfTheImpulseOfAnyTable) {
  const PressureTable table{
      {{0, 0.3}, {0.2, 1.4}, {0.2, -0.5}, {0.37, 0.8}, {0.37, 1.5}, {0.4, 1.5}, {0.4, 0}, {0.7, 0}, {1.05, 1}}};
  for (const std::string& scheme : all_schemes) {
    Case setup;
    setup.stabilisation = Stabilisation::paper;
    setup.fluid = FluidData{1.3, 0.5, true, false};
    setup.inlet = table;
    setup.time = TimeData{0.1, 1.25, 1};
    setup.time->scheme = scheme;
    setup.time->scheme_values["damping"] = 0.9;
    const double mass = 1.3;
    double work = 0, taken = 0, last = 0, largest = 0;
    const Loads loads(setup);
    int step = 0;
    for (const auto& record : march(setup, slug())) {
      work += record.inlet_work;
      taken += record.fluid_inertia;
      const double start = loads.time_of(step), end = loads.time_of(++step);
      const double impulse = end * table.mean(0, end), change = (impulse - last) / mass;
      last = impulse;
      largest = std::max(largest, std::abs(impulse));
      EXPECT_NEAR(record.fluid_kinetic, impulse * impulse / (2 * mass), 1e-11) << scheme << " step " << step;
      EXPECT_NEAR(work - taken, impulse * impulse / (2 * mass), 1e-11) << scheme << " step " << step;
      EXPECT_NEAR(record.remainder, 0, 1e-11);
      if (scheme == "euler" || scheme == "midpoint") {
        const double theta = scheme == "euler" ? 1 : 0.5 + 0.9 * (end - start);
        EXPECT_NEAR(record.fluid_inertia, (theta - 0.5) * mass * change * change, 1e-11) << scheme;
      }
    }
    fmt::print("{}: work {:.6f}, the scheme took {:.3e}, largest impulse {:.4f}\n", scheme, work, taken, largest);
    EXPECT_GT(largest, 0.1);
  }
}

// A balance with another viscosity, density or stiffness than the solution's does not close.
TEST(EnergyBalance, ShowsATermThatIsOnePercentOff) {
  const auto mesh = fluid_and_wall_box(2);
  const Case setup = rising_pressure("neo-hookean", 0.1);
  const auto off_by = [&](auto change) {
    Case other = setup;
    change(other);
    double work = 0, left_over = 0;
    for (const auto& record : march(setup, mesh, &other)) {
      work += record.inlet_work;
      left_over += std::abs(record.remainder);
    }
    return left_over / work;
  };
  EXPECT_LT(off_by([](Case&) {}), 1e-9);
  EXPECT_GT(off_by([](Case& c) { c.fluid->viscosity *= 1.01; }), 1e-3);
  EXPECT_GT(off_by([](Case& c) { c.fluid->density *= 1.01; }), 1e-5);
  EXPECT_GT(off_by([](Case& c) { c.structure->density *= 1.01; }), 1e-6);
  EXPECT_GT(off_by([](Case& c) { c.structure->layers["media"].values["c10"] *= 1.01; }), 1e-4);
}

TEST(EnergyBalance, NumericalDissipationInTimeIsOfFirstOrder) {
  const auto mesh = fluid_and_wall_box(2);
  std::vector<double> lost;
  for (double step : {0.1, 0.05, 0.025, 0.0125}) {
    double sum = 0;
    for (const auto& record : march(rising_pressure("neo-hookean", step), mesh))
      sum += record.fluid_inertia + record.fluid_mesh_motion + record.wall_inertia + record.wall_stress;
    lost.push_back(sum);
    fmt::print("dt {:7.4f}: lost to the time schemes {:.4e} uJ\n", step, sum);
    EXPECT_GT(sum, 0);
  }
  for (std::size_t k = 1; k < lost.size(); ++k) EXPECT_NEAR(std::log2(lost[k - 1] / lost[k]), 1, 0.06);
}

// From rest to rest: what histories of rates hold back in between is given back.
TEST(EnergyBalance, InertiaOfTheOtherSchemesTakesLessByAnOrder) {
  const auto mesh = fluid_and_wall_box(2);
  double of_euler = 0;
  for (const std::string& scheme : all_schemes) {
    std::vector<double> lost;
    for (double step : {0.1, 0.05, 0.025}) {
      Case setup = rising_pressure("neo-hookean", step);
      setup.inlet = PressureTable{{{0, 0}, {0.2, 0.4}, {0.6, 1}, {1, 0}}};
      setup.time->end = 3;
      setup.time->scheme = scheme;
      lost.push_back(0);
      for (const auto& record : march(setup, mesh)) lost.back() += record.fluid_inertia + record.wall_inertia;
    }
    fmt::print("{}: lost to inertia {:.4e} {:.4e} {:.4e} uJ\n", scheme, lost[0], lost[1], lost[2]);
    if (scheme == "euler") {
      of_euler = lost[2];
      continue;
    }
    EXPECT_LT(std::abs(lost[2]), 0.05 * of_euler) << scheme;
    if (scheme == "tr-bdf2") continue;  // smaller still, and of either sign
    EXPECT_GT(std::log2(lost[1] / lost[2]), 1.8) << scheme;
  }
}

// Bit for bit, as everything that is assembled.
TEST(EnergyBalance, DoesNotDependOnTheNumberOfThreads) {
  Case setup = lively_case("artery");
  setup.time->scheme = "tr-bdf2";
  std::vector<EnergyRecord> records;
  for (int count : {1, 2, 3, 5}) {
    set_threads(count);
    ArbitrarySteps<P1Tetrahedron> steps(setup);
    steps.advance(0.5);
    records.push_back(steps.advance(0.4));
  }
  set_threads(1);
  for (const auto& record : records) {
    EXPECT_EQ(record.energy(), records[0].energy());
    EXPECT_EQ(record.viscous, records[0].viscous);
    EXPECT_EQ(record.numerical(), records[0].numerical());
    EXPECT_EQ(record.remainder, records[0].remainder);
  }
}

}  // namespace

}  // namespace fsi::test::energy_tests
