// The oscillating pipe of docs/theory.md, section 13.3: blood and both layers of the wall in axial shear, time-harmonic
// and exact at finite shear. Computations are held against the oscillation as the same time scheme steps it, so that
// their error is that of space alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/build_scene.hpp"
#include "support/errors.hpp"
#include "support/oscillating_pipe.hpp"
#include "support/ring_meshes.hpp"
#include "support/scene_errors.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"
#include "support/told_of_stages.hpp"
#include "system/newton_stepper.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test::oscillating_pipe_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

/// To the last digit that is given.
void expect_complex(Complex value, Complex expected, double digit) {
  EXPECT_NEAR(value.real(), expected.real(), digit);
  EXPECT_NEAR(value.imag(), expected.imag(), digit);
}

TEST(OscillatingPipe, BesselFunctionsAgreeWithTheStandardLibraryAndTheirWronskian) {
  for (double x : {0.3, 1.0, 2.5, 6.0}) {
    const Bessel b(x);
    expect_complex(b.j0, std::cyl_bessel_j(0, x), 1e-12);
    expect_complex(b.j1, std::cyl_bessel_j(1, x), 1e-12);
    expect_complex(b.y0, std::cyl_neumann(0, x), 1e-12);
    expect_complex(b.y1, std::cyl_neumann(1, x), 1e-12);
  }
  for (Complex z : {Complex(0.5, 0.2), Complex(2, -1), Complex(1, 3)}) {
    const Bessel b(z);
    expect_complex(b.j1 * b.y0 - b.j0 * b.y1, 2.0 / (3.14159265358979323846 * z), 1e-12);
  }
}

TEST(OscillatingPipe, FieldsReproduceTheTable) {
  const OscillatingPipe pipe(tubes()[0], HarmonicRates::continuous(1));
  expect_complex(pipe.velocity(0), {-4.658885784e-8, -0.1000000294}, 1e-10);
  expect_complex(pipe.velocity(1.2), {0.003009433989, -0.1077371894}, 1e-10);
  expect_complex(pipe.displacement(0, 1.43), {0.01873715503, -0.002478210155}, 1e-11);
  for (int layer : {0, 1}) expect_complex(pipe.displacement(layer, 1.69), {0.01704788129, -0.00205619941}, 1e-11);
  expect_complex(pipe.displacement(1, 1.75), {0.009800778175, -0.001096985033}, 1e-11);
  expect_complex(pipe.displacement(1, 1.82), 0.0, 1e-14);
  expect_complex(pipe.shear_stress(1.43), {-0.004867643172, 0.004924458873}, 1e-11);
}

TEST(OscillatingPipe, StepsConvergeToTheOscillationAtFirstOrder) {
  const OscillatingPipe exact(tubes()[0], HarmonicRates::continuous(1));
  ConvergenceTable errors("oscillating pipe", {"d at the inner face, mm", "u at 1.2 mm, mm/ms"});
  for (double step : {0.1, 0.05, 0.025}) {
    const OscillatingPipe stepped(tubes()[0], HarmonicRates::stepped(1, step));
    errors.add(step, {std::abs(stepped.displacement(0, inner_radius) - exact.displacement(0, inner_radius)),
                      std::abs(stepped.velocity(1.2) - exact.velocity(1.2))});
  }
  errors.print();
  EXPECT_NEAR(errors.last_order(0), 1, 0.1);
  EXPECT_NEAR(errors.last_order(1), 1, 0.1);
}

/// The fields of a pipe at one time, real, as functions of reference positions (r, 0, z). The mesh of the fluid moves
/// as a whole, with the wall's inner face.
class PipeAt {
 public:
  PipeAt(const OscillatingPipe& pipe, double time, double length)
      : pipe_(pipe),
        time_(time),
        length_(length),
        velocity_(0, inner_radius, 60, [&](double r) { return pipe.at(time, pipe.velocity(r)); }) {}

  double mesh_displacement() const { return displacement(0, inner_radius); }
  double displacement(int layer, double r) const { return pipe_.at(time_, pipe_.displacement(layer, r)); }
  double velocity(double r) const { return velocity_(r); }
  double fluid_pressure(double z) const { return pipe_.gradient_at(time_) * (length_ - z); }
  /// Radial equilibrium: the radial stress is that of the fluid at the same height, but for sigma_tt - sigma_rr =
  /// c01 d'^2; p is minus a third of the trace of Cauchy's stress.
  double wall_pressure(int layer, double r, double z) const {
    const double height = z + displacement(layer, r) - mesh_displacement();
    double p = fluid_pressure(height) - (c10(layer) + 2 * c01(layer)) * square_of_shear(layer, r) / 3;
    for (int l = 0; l <= layer; ++l) {
      const double from = pipe_.tube().layers[l].inner, to = l == layer ? r : pipe_.tube().layers[l].outer;
      if (c01(l) > 0) p -= gauss_integral(from, to, 3, [&](double at) { return c01(l) * square_of_shear(l, at) / at; });
    }
    return p;
  }

 private:
  double square_of_shear(int layer, double r) const { return std::pow(pipe_.at(time_, pipe_.slope(layer, r)), 2); }
  double c01(int layer) const {
    const auto* m = std::get_if<MooneyRivlin>(&pipe_.tube().layers[layer].material);
    return m ? m->c01 : 0.0;
  }
  double c10(int layer) const { return shear_modulus(pipe_.tube().layers[layer].material) - c01(layer); }

  const OscillatingPipe& pipe_;
  double time_, length_;
  PolynomialFit velocity_;
};

struct PipeSteps {
  std::string scheme;
  double step;  ///< ms
  int count;
};

/// What becomes of the ends of the wall and of the mesh of the fluid.
enum class PipeEnds {
  moved,  ///< exactly
  free    ///< along the axis, under the pressure of the opening beside them; the mesh follows by itself
};

/// Of the pressure that acts there. Free ends feel that of the opening in place of that at their height, which differs
/// by P (d - d_m): of second order in P, where the solution is linear.
/// Viscous layers are linear in it, too.
double gradient_for(PipeEnds ends, double wall_viscosity) {
  return ends == PipeEnds::moved && wall_viscosity == 0 ? 0.1 : 1e-4;
}

/// Pressure at the inlet of a piece of the pipe. Of backward Euler, held against its own oscillation, the value at its
/// end in each step; of the others the cosine itself, with so many points that its corners do not count.
PressureTable pipe_load(const OscillatingPipe& pipe, const PipeSteps& steps, double length) {
  PressureTable table;
  constexpr int points = 64;  // a step
  for (int i = 1; i <= steps.count; ++i) {
    if (steps.scheme == "euler")
      for (double t : {steps.step * (i - 1), steps.step * i})
        table.points.push_back({t, pipe.gradient_at(steps.step * i) * length});
    else
      for (int k = i == 1 ? 0 : 1; k <= points; ++k) {
        const double t = steps.step * (i - 1 + static_cast<double>(k) / points);
        table.points.push_back({t, pipe.gradient_at(t) * length});
      }
  }
  return table;
}

/// Marches a piece of the pipe from the exact state, the wall's ends and outer face moved exactly, the fluid's ends
/// under their pressures and without radial velocity. Returns the relative L2 errors at the end, of pressures at the
/// time of the last balance.
template <class Element>
std::vector<double> pipe_errors(int material, const RingCells& cells, double length, const PipeSteps& in_time,
                                PipeEnds ends = PipeEnds::moved, double wall_viscosity = 0) {
  using Vector = VectorLayout<2>;
  using Mixed = MixedLayout<2>;
  const double step = in_time.step;
  const int steps = in_time.count;
  const OscillatingPipe pipe(tubes()[material],
                             in_time.scheme == "euler" ? HarmonicRates::stepped(1, step) : HarmonicRates::continuous(1),
                             gradient_for(ends, wall_viscosity), wall_viscosity);
  auto mesh = pipe_mesh<Element>(cells, length);
  Case setup = coupled_case(material == 0 ? "neo-hookean" : "mooney-rivlin", step);
  setup.structure->bulk_modulus = 1e9;
  for (auto& [name, layer] : setup.structure->layers) layer.viscosity = wall_viscosity;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.time->scheme = in_time.scheme;
  setup.time->end = step * steps;
  setup.inlet = pipe_load(pipe, in_time, length);
  if (ends == PipeEnds::free) {  // the outer face is left to be clamped
    setup.geometry = Geometry::axisymmetric;
    mesh.facet_groups.back().facets = boundary_where(mesh, where(0, outer_radius));
    for (const auto& [name, z] : {std::pair{"first_end", 0.0}, std::pair{"last_end", length}}) {
      name_boundary(mesh, name, [z = z](const Point& x) { return where(2, z)(x) && x[0] > inner_radius - 1e-9; });
      setup.supports[name].fixed = std::vector<std::string>{"r"};
    }
    setup.supports["first_end"].pressure = setup.inlet;
  }
  const auto scene = build_scene<Element>(setup, mesh);
  const auto& fluid = dynamic_cast<const FluidProblem<Element>&>(*scene->fluid).part();
  const auto& wall = dynamic_cast<const WallProblem<Element>&>(*scene->wall).part();
  const auto layer_of = [&](const Point& x) { return x[0] < middle_radius ? 0 : 1; };
  const auto at_end = [&](const Point& x) { return where(2, 0)(x) || where(2, length)(x); };
  for (int a = 0; a < fluid.node_count(); ++a)
    if (at_end(fluid.nodes[a])) scene->velocity_conditions.fix(a, 0);

  // What the scheme carries to the stage's end is exact there.
  const auto prescribe = [&](const StepRates& rates) {
    const PipeAt from(pipe, rates.start, length), to(pipe, rates.end, length);
    const auto carried = [&](double first, double last) { return first + rates.carry * (last - first); };
    for (int a = 0; a < fluid.node_count(); ++a)
      if (at_end(fluid.nodes[a]) && ends == PipeEnds::moved)
        scene->mesh_conditions.fix(a, 1, carried(from.mesh_displacement(), to.mesh_displacement()));
    for (int a = 0; a < wall.node_count(); ++a) {
      const int layer = layer_of(wall.nodes[a]);
      const double r = wall.nodes[a][0];
      if (scene->wall_conditions.fixes(a))
        scene->wall_conditions.fix(a, 1, carried(from.displacement(layer, r), to.displacement(layer, r)));
    }
  };
  scene->integrator = std::make_unique<ToldOfStages>(std::move(scene->integrator), prescribe);

  State state = scene->at_rest();
  {
    const PipeAt start(pipe, 0, length);
    for (int a = 0; a < fluid.node_count(); ++a) {
      state.now.fluid[Mixed::vector(a, 1)] = start.velocity(fluid.nodes[a][0]);
      state.now.mesh[Vector::vector(a, 1)] = start.mesh_displacement();
    }
    for (int a = 0; a < wall.node_count(); ++a) {
      const Complex d = pipe.displacement(layer_of(wall.nodes[a]), wall.nodes[a][0]);
      state.now.wall[Mixed::vector(a, 1)] = pipe.at(0, d);
      state.wall_velocity[Vector::vector(a, 1)] = pipe.at(0, pipe.rates().wall_velocity * d);
      state.wall_acceleration[Vector::vector(a, 1)] = pipe.at(0, pipe.rates().second * d);
    }
    state.before[0] = state.now;
    scene->integrator->prepare(state);
    if (in_time.scheme == "generalised-alpha") {  // the one that starts from rates
      const auto rate = [&](Complex amplitude) { return pipe.at(0, pipe.rates().first * amplitude); };
      for (int a = 0; a < fluid.node_count(); ++a) {
        state.rate.fluid[Mixed::vector(a, 1)] = rate(pipe.velocity(fluid.nodes[a][0]));
        state.rate.mesh[Vector::vector(a, 1)] = rate(pipe.displacement(0, inner_radius));
      }
      for (int a = 0; a < wall.node_count(); ++a) {
        state.rate.wall[Mixed::vector(a, 1)] = state.wall_velocity[Vector::vector(a, 1)];
        state.velocity_rate[Vector::vector(a, 1)] = state.wall_acceleration[Vector::vector(a, 1)];
      }
      state.load_rates[0] = pipe.gradient_at(0) * length;
    }
  }
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-9;
  NewtonStepper<2> stepper(*scene, loads, options, number_scene(*scene));
  for (int i = 1; i <= steps; ++i) stepper.advance(state);

  const PipeAt exact(pipe, step * steps, length);
  const bool at_balance = state.has_balances();
  const PipeAt balanced(pipe, at_balance ? state.balance_times[0] : step * steps, length);
  // Velocity and displacement of the last level, pressure of the last balance.
  const auto mixed = [](std::vector<double> level, const std::vector<double>& balance, int nodes) {
    for (int a = 0; a < nodes; ++a) level[Mixed::scalar(a)] = balance[Mixed::scalar(a)];
    return level;
  };
  if (at_balance) {
    state.now.fluid = mixed(state.now.fluid, state.last_balance().fluid, fluid.node_count());
    state.now.wall = mixed(state.now.wall, state.last_balance().wall, wall.node_count());
  }
  RelativeError d, wall_p, u, fluid_p;
  add_errors<Element>(
      fluid, mesh.region_index("fluid"), state.now.fluid,
      [&](const Point& x) {
        return Point{0, 0, exact.velocity(x[0])};
      },
      [&](const Point& x) { return balanced.fluid_pressure(x[2]); }, u, fluid_p);
  for (int layer : {0, 1})
    add_errors<Element>(
        wall, mesh.region_index(layer == 0 ? "media" : "adventitia"), state.now.wall,
        [&](const Point& x) {
          return Point{0, 0, exact.displacement(layer, x[0])};
        },
        [&](const Point& x) { return balanced.wall_pressure(layer, x[0], x[2]); }, d, wall_p);
  return {d.value(), wall_p.value(), u.value(), fluid_p.value()};
}

template <class Element>
ConvergenceTable pipe_table(const std::string& title, int material, const std::vector<int>& multiples,
                            const RingCells& cells, double length, double step, int steps) {
  ConvergenceTable errors(title, {"d, wall", "p, wall", "u, fluid", "p, fluid"});
  for (int m : multiples)
    errors.add(1.0 / m,
               pipe_errors<Element>(material, {m * cells.fluid, m * cells.media, m * cells.adventitia, m * cells.along},
                                    length, {"euler", step, steps}));
  errors.print();
  return errors;
}

class OscillatingPipeScene : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Materials, OscillatingPipeScene, testing::Values(0, 1),
                         [](const auto& test) { return std::string(test.param == 0 ? "NeoHookean" : "MooneyRivlin"); });

TEST_P(OscillatingPipeScene, AxisymmetricTaylorHoodIsOfThirdOrder) {
  const auto errors =
      pipe_table<P2P1AxisymmetricTriangle>(tubes()[GetParam()].name, GetParam(), {1, 2, 4}, {6, 1, 1, 2}, 0.5, 0.25, 4);
  EXPECT_NEAR(errors.last_order(0), 3, 0.15);
  EXPECT_GT(errors.last_order(1), 1.9);
  EXPECT_NEAR(errors.last_order(2), 3, 0.15);
  EXPECT_GT(errors.last_order(3), 1.9);
  EXPECT_LT(errors.last_error(0), 1e-5);
}

/// In an infinite pipe nothing depends on z. So a piece of it, whose ends are free along the axis and whose openings are
/// taken along by the wall, moves as the whole does.
TEST(OscillatingPipeWithFreeEnds, AxisymmetricTaylorHoodIsOfThirdOrder) {
  ConvergenceTable errors("free ends", {"d, wall", "p, wall", "u, fluid", "p, fluid"});
  for (int m : {1, 2, 4})
    errors.add(1.0 / m,
               pipe_errors<P2P1AxisymmetricTriangle>(0, {6 * m, m, m, 2 * m}, 0.5, {"euler", 0.25, 4}, PipeEnds::free));
  errors.print();
  EXPECT_NEAR(errors.last_order(0), 3, 0.3);
  EXPECT_GT(errors.last_order(1), 1.8);
  EXPECT_NEAR(errors.last_order(2), 3, 0.15);
  EXPECT_GT(errors.last_order(3), 1.8);
}

/// With layers whose shear modulus is complex, 3 + 0.5 i and 0.3 + 0.5 i kPa at 1 rad/ms, against their complex wave numbers.
TEST(OscillatingPipeOfViscousLayers, AxisymmetricTaylorHoodIsOfThirdOrder) {
  ConvergenceTable errors("viscous layers", {"d, wall", "p, wall", "u, fluid", "p, fluid"});
  for (int m : {1, 2, 4})
    errors.add(1.0 / m, pipe_errors<P2P1AxisymmetricTriangle>(0, {6 * m, m, m, 2 * m}, 0.5, {"euler", 0.25, 4},
                                                              PipeEnds::moved, 1.0));
  errors.print();
  EXPECT_NEAR(errors.last_order(0), 3, 0.15);
  EXPECT_NEAR(errors.last_order(2), 3, 0.15);
  EXPECT_LT(errors.last_error(0), 1e-5);
}

class OscillatingPipeInTime : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Schemes, OscillatingPipeInTime, testing::Values("midpoint", "bdf2", "generalised-alpha"),
                         [](const auto& test) {
                           std::string name = test.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

/// The oscillation itself, not as the scheme steps it: what is left on a fine mesh is the error of the step. The wall
/// follows its ends, which are moved exactly, so that its own error is small from the start and no order can be read off
/// it; neither from pressures of generalised-alpha, which are at the error of the mesh. Not of tr-bdf2: the ends excite
/// waves in the wall that its first stages do not damp.
TEST_P(OscillatingPipeInTime, VelocityAndPressureOfTheFluidAreOfSecondOrder) {
  ConvergenceTable errors(GetParam(), {"d, wall", "p, wall", "u, fluid", "p, fluid"});
  for (const int count : {8, 16, 32})
    errors.add(2.0 / count,
               pipe_errors<P2P1AxisymmetricTriangle>(0, {48, 8, 8, 4}, 0.5, {GetParam(), 2.0 / count, count}));
  errors.print();
  EXPECT_NEAR(errors.last_order(2), 2, 0.1);
  if (GetParam() != "generalised-alpha") {
    EXPECT_GT(errors.last_order(3), 1.8);
  }
  EXPECT_LT(errors.last_error(0), 1e-4);
  EXPECT_LT(errors.last_error(3), 2.5e-3);
}

}  // namespace

}  // namespace fsi::test::oscillating_pipe_tests
