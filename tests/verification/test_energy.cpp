// The energy balance (docs/energy.md): its terms are evaluated one by one, so what is left over of them tells of every
// mistake in any.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnostics/energy_balance.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "fem/p2p1_tetrahedron.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/nodal_arrays.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test {

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
  setup.time->newmark_beta = 0.4;
  setup.time->newmark_gamma = 0.7;
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

/// A step between two states that solve nothing.
template <class Element>
class ArbitraryStep {
 public:
  explicit ArbitraryStep(const Case& setup)
      : loads_(setup), scene_(build_scene<Element>(setup, box<Element>(4 - Element::order))) {
    const auto& x = scene_->fluid->nodes().nodes;
    const auto& y = scene_->wall->nodes().nodes;
    state_ = scene_->at_rest();
    const auto level = [&](double scale, unsigned seed) {
      Solution fields{random_field(x, 3, 0.06 * scale, 0.01 * scale, seed),
                      random_field(x, 4, 3 * scale, 0.5 * scale, seed + 1),
                      random_field(y, 4, 0.06 * scale, 0.005 * scale, seed + 2)};
      for (std::size_t i = 3; i < fields.wall.size(); i += 4) fields.wall[i] *= 20;  // kPa
      return fields;
    };
    const auto add = [](Solution& a, const Solution& b) {
      a = {moved(a.mesh, 1, b.mesh), moved(a.fluid, 1, b.fluid), moved(a.wall, 1, b.wall)};
    };
    Solution& old = state_.before[0];
    old = level(1, 1);
    state_.now = old;
    add(state_.now, level(0.2, 4));
    for (auto* fields : {&old, &state_.now}) {
      impose_boundary(*scene_, *fields);
      for (const auto& node : scene_->interface)
        for (int k = 0; k < 3; ++k) fields->mesh[3 * node.fluid + k] = fields->wall[4 * node.wall + k];
    }
    state_.before[1] = old;
    scene_->impose_interface(state_, scene_->integrator->rates(state_, setup.time->step));
    state_.wall_velocity = random_field(y, 3, 0.5, 0.1, 7);
    state_.wall_acceleration = random_field(y, 3, 0.5, 0.1, 8);
  }

  /// The step's residual tested with what the balance is made by.
  double tested_residual() {
    const StepData data = loads_.next(state_, *scene_->integrator);
    const double step = data.rates.step;
    std::vector<double> fluid, wall, wall_old;
    scene_->fluid->assemble(scene_->fluid_input(state_, data.rates), data.opening_pressures, fluid);
    scene_->wall->assemble(scene_->wall_input(state_, data.rates), 0, state_.now.wall, wall);
    WallInput old = scene_->wall_input(state_, data.rates);
    old.wall = state_.before[0].wall.data();
    scene_->wall->assemble(old, 0, state_.before[0].wall, wall_old);
    double sum = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i) sum += (i % 4 == 3 ? -step : step) * fluid[i] * state_.now.fluid[i];
    for (std::size_t i = 0; i < wall.size(); ++i)
      sum += i % 4 == 3 ? -(wall[i] - wall_old[i]) * state_.now.wall[i]
                        : wall[i] * (state_.now.wall[i] - state_.before[0].wall[i]);
    return sum;
  }

  EnergyRecord balance() {
    EnergyBalance<3> energy(*scene_, loads_, state_);
    State next = state_;
    scene_->integrator->accept(next, loads_.next(state_, *scene_->integrator));
    return energy.step_to(next);
  }

 private:
  Loads loads_;
  std::unique_ptr<Scene<3>> scene_;
  State state_;
};

// The terms are integrals of their own; together they are the weak forms, tested, of any two states.
template <class Element>
void check_arbitrary_states() {
  for (const auto* material : {"neo-hookean", "mooney-rivlin", "artery"}) {
    const Case setup = lively_case(material);
    ArbitraryStep<Element> step(setup);
    const EnergyRecord e = step.balance();
    std::vector<double> terms{e.fluid_kinetic, e.wall_kinetic,      e.wall_isochoric,   e.wall_volumetric,
                              e.inlet_work,    e.inlet_kinetic,     e.outlet_kinetic,   e.viscous,
                              e.fluid_inertia, e.fluid_mesh_motion, e.fluid_divergence, e.wall_inertia,
                              e.wall_stress};
    if (Element::stabilised)
      terms.insert(terms.end(), {e.fluid_stabilisation, e.wall_stabilisation});
    else
      terms.push_back(e.fluid_quadrature);
    double smallest = INFINITY;
    for (double term : terms) smallest = std::min(smallest, std::abs(term));
    const double tested = step.tested_residual();
    fmt::print("{}: left over {:.6e}, off the residual by {:.1e}; smallest term {:.1e}\n", material, e.remainder,
               e.remainder + tested, smallest);
    EXPECT_GT(smallest, 1e-4);  // seen if it were wrong
    EXPECT_GT(std::abs(tested), 1);
    // A fibre that tightens within the step puts a kink into its stress, which no rule of integration sees.
    EXPECT_NEAR(e.remainder, -tested, setup.structure->layers.at("media").material == "artery" ? 1e-6 : 1e-11);
    if (Element::stabilised) {
      EXPECT_EQ(e.fluid_quadrature, 0);
    }
  }
}

TEST(EnergyBalance, LeavesOverTheTestedResidualOfArbitraryStates) {
  check_arbitrary_states<P1Tetrahedron>();
}

TEST(EnergyBalance, LeavesOverTheTestedResidualOfArbitraryTaylorHoodStates) {
  check_arbitrary_states<P2P1Tetrahedron>();
}

/// A case marched to its end, and its balances.
std::vector<EnergyRecord> march(const Case& setup, const TetrahedralMesh& mesh, const Case* measured_as = nullptr) {
  const auto scene = build_scene<P1Tetrahedron>(setup, mesh),
             other = build_scene<P1Tetrahedron>(measured_as ? *measured_as : setup, mesh);
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-11;
  NewtonStepper<3> stepper(*scene, loads, options, number_scene(*scene));
  State state = scene->at_rest();
  EnergyBalance<3> balance(*other, loads, state);
  std::vector<EnergyRecord> records;
  while (state.step < loads.steps()) {
    stepper.advance(state);
    records.push_back(balance.step_to(state));
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

// Bit for bit, as everything that is assembled.
TEST(EnergyBalance, DoesNotDependOnTheNumberOfThreads) {
  const Case setup = lively_case("artery");
  std::vector<EnergyRecord> records;
  for (int count : {1, 2, 3, 5}) {
    set_threads(count);
    ArbitraryStep<P1Tetrahedron> step(setup);
    records.push_back(step.balance());
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

}  // namespace fsi::test
