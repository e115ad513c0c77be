// Fully developed flow in rigid pipes: the start-up after a step of pressure, and the oscillation that a periodic flow
// rate drives through an inlet with Womersley's profile, against Bessel functions.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "fluid/womersley_inflow.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/boundary_conditions.hpp"
#include "support/bessel_series.hpp"
#include "support/errors.hpp"
#include "support/rigid_pipes.hpp"
#include "support/scene_errors.hpp"
#include "support/scenes.hpp"
#include "support/told_of_stages.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::rigid_pipe_flow_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

constexpr double radius = pipe_radius, density = 1.06;  // mm, mg/mm^3

/// A fluid between rigid walls, marched from an exact start, its velocity across the axis held at the ends.
template <class Element>
class RigidPipe {
 public:
  static constexpr int n = Element::components;
  static constexpr int axial = n - 1;
  using Mixed = MixedLayout<n>;
  using Velocity = std::function<double(double r, double time)>;

  RigidPipe(const Case& setup, const SimplexMesh<Element::dim, Element::order>& mesh, double length, Velocity exact)
      : setup_(setup), scene_(build_scene<Element>(setup, mesh)), exact_(std::move(exact)) {
    const auto& part = problem().part();
    for (int a = 0; a < part.node_count(); ++a)
      if (where(2, 0.0)(part.nodes[a]) || where(2, length)(part.nodes[a]))
        for (int k = 0; k < axial; ++k) scene_->velocity_conditions.fix(a, k);
    opening_.name = group::inlet;
    opening_.nodes = part.nodes;
    opening_.facets = in_part<Element>(part, *mesh.facets(group::inlet));
    for (const Point& x : part.nodes) opening_.sticking.push_back(from_axis(x) > radius - 1e-9);
  }

  const FluidProblem<Element>& problem() const { return dynamic_cast<const FluidProblem<Element>&>(*scene_->fluid); }
  const InflowOpening<Element>& opening() const { return opening_; }

  /// Prescribes the velocity at the inlet, whose flow differs from the rate by less than rounding.
  void let_in(const WomersleyInflow& inflow) {
    inflow_ = &inflow;
    prescribe(0, 0, 1);
    scene_->integrator = std::make_unique<ToldOfStages>(
        std::move(scene_->integrator), [this](const StepRates& r) { prescribe(r.start, r.end, r.carry); });
  }

  /// The relative L2 error of the velocity at the end.
  double error_at_end() {
    State state = scene_->at_rest();
    const auto& part = problem().part();
    for (int a = 0; a < part.node_count(); ++a)
      state.now.fluid[Mixed::vector(a, axial)] =
          from_axis(part.nodes[a]) > radius - 1e-9 ? 0.0 : exact_(from_axis(part.nodes[a]), 0);
    scene_->impose_conditions(state.now);
    state.before[0] = state.now;
    scene_->integrator->prepare(state);
    const Loads loads(setup_);
    NewtonOptions options;
    options.tolerance = 1e-9;
    NewtonStepper<n> stepper(*scene_, loads, options, number_scene(*scene_));
    while (state.step < loads.steps()) stepper.advance(state);
    if (inflow_) {  // the flow asked for at the end of the step; what enters leaves, where continuity holds
      double sum = 0;
      for (const auto& open : scene_->fluid->open_boundaries()) sum += open.outflow(state.last_balance().fluid);
      EXPECT_NEAR(sum, 0, 1e-9);
      const auto& inlet = *scene_->fluid->open_boundary(group::inlet);
      EXPECT_NEAR(-inlet.outflow(state.before[0].fluid), inflow_->flow().at(setup_.time->end), 1e-12);
    }
    RelativeError u, unused;
    add_errors<Element>(
        part, 0, state.before[0].fluid,
        [&](const Point& x) {
          return Point{0, 0, exact_(from_axis(x), setup_.time->end)};
        },
        [](const Point&) { return 0.0; }, u, unused);
    return u.value();
  }

 private:
  static double from_axis(const Point& x) { return Element::dim == 3 ? std::hypot(x[0], x[1]) : x[0]; }

  /// The balance's velocity: carried to the stage's end it is that of the flow there.
  void prescribe(double start, double end, double carry) {
    std::vector<double> from(VectorLayout<n>::size(problem().node_count()), 0.0), to = from;
    inflow_->set(start, from);
    inflow_->set(end, to);
    for (int a = 0; a < problem().node_count(); ++a)
      if (where(2, 0.0)(problem().part().nodes[a]))
        for (int k = 0; k < n; ++k) {
          const std::size_t at = VectorLayout<n>::vector(a, k);
          scene_->velocity_conditions.fix(a, k, from[at] + carry * (to[at] - from[at]));
        }
  }

  Case setup_;
  std::unique_ptr<Scene<n>> scene_;
  Velocity exact_;
  InflowOpening<Element> opening_;
  const WomersleyInflow* inflow_ = nullptr;
};

Case rigid_case(double viscosity, double pressure, const std::string& scheme, double end, int steps) {
  Case setup;
  setup.fluid = FluidData{density, viscosity};
  setup.inlet = PressureTable{{{0.0, pressure}}};
  setup.time.emplace();
  setup.time->step = end / steps;
  setup.time->end = end;
  setup.time->scheme = scheme;
  return setup;
}

// --- Womersley -----------------------------------------------------------------------------------------------------

/// Flow 1 + 3 cos(w t) mm^3/ms with Womersley number 5 [Womersley1955]; through a quarter pipe a quarter of it.
struct Oscillation {
  static constexpr double period = 1, mean = 1, amplitude = 3, alpha = 5;
  static double frequency() { return 2 * pi / period; }
  static double viscosity() { return density * frequency() * radius * radius / (alpha * alpha); }
  static PeriodicFlow flow(double part) {
    PeriodicFlow rate{period, {}};
    constexpr int samples = 2000;  // so many that corners do not count
    for (int i = 0; i < samples; ++i)
      rate.points.emplace_back(period * i / samples, part * (mean + amplitude * std::cos(2 * pi * i / samples)));
    return rate;
  }
  static double velocity(double r, double time) {
    static const Complex l = alpha / radius * std::polar(1.0, 0.75 * pi);
    static const Bessel rim(l * radius);
    static const Complex unit = pi * radius * radius * (1.0 - 2.0 * rim.j1 / (l * radius * rim.j0));
    const Complex profile = (1.0 - Bessel(l * r).j0 / rim.j0) / unit;
    return 2 * mean / (pi * radius * radius) * (1 - r * r / (radius * radius)) +
           amplitude * (profile * std::polar(1.0, frequency() * time)).real();
  }
};

template <class Element>
double womersley_error(int across, int along, const std::string& scheme, double end, int steps) {
  constexpr double length = 1.0;
  const Case setup = rigid_case(Oscillation::viscosity(), 0, scheme, end, steps);
  RigidPipe<Element> pipe(setup, rigid_pipe<Element>(across, along, length), length, Oscillation::velocity);
  const auto inflow = womersley_inflow(pipe.opening(), Oscillation::flow(Element::dim == 3 ? 0.25 : 1), density,
                                       Oscillation::viscosity());
  EXPECT_EQ(inflow.modes(), 1);
  EXPECT_EQ(inflow.instead(), "");
  pipe.let_in(inflow);
  return pipe.error_at_end();
}

TEST(WomersleyFlow, InAPipeOfRevolutionIsOfThirdOrderInSpace) {
  ConvergenceTable errors("Womersley flow, p2p1 axisymmetric", {"u"});
  for (int m : {1, 2, 4})
    errors.add(1.0 / m, {womersley_error<P2P1AxisymmetricTriangle>(3 * m, m, "midpoint", 0.25, 100)});
  errors.print();
  EXPECT_NEAR(errors.last_order(0), 3, 0.25);
  EXPECT_LT(errors.last_error(0), 2e-4);
}

TEST(WomersleyFlow, IsOfTheOrderOfTheSchemeInTime) {
  for (const auto& [scheme, order] : {std::pair{"euler", 1}, std::pair{"midpoint", 2}, std::pair{"tr-bdf2", 2}}) {
    ConvergenceTable errors(scheme, {"u"});
    for (int count : {16, 32})
      errors.add(1.0 / count, {womersley_error<P2P1AxisymmetricTriangle>(16, 1, scheme, 0.75, count)});
    errors.print();
    EXPECT_NEAR(errors.last_order(0), order, 0.2) << scheme;
  }
}

TEST(WomersleyFlow, OfTetrahedraOnACoarseMesh) {
  const double coarse = womersley_error<P2P1Tetrahedron>(2, 1, "midpoint", 0.25, 10);
  const double finer = womersley_error<P2P1Tetrahedron>(4, 1, "midpoint", 0.25, 10);
  fmt::print("Womersley flow, p2p1 tetrahedra: error {:.4f}, {:.4f} with half the size\n", coarse, finer);
  EXPECT_LT(finer, 0.02);
  EXPECT_GT(std::log2(coarse / finer), 2);
}

// --- start-up ------------------------------------------------------------------------------------------------------

/// Flow from rest under a pressure that is switched on [Szymanski1932]; over its velocity on the axis in the end,
///   1 - s^2 - sum over the zeros l of J_0 of 8 J_0(l s) / (l^3 J_1(l)) e^(-l^2 nu t / R^2),   s = r/R.
double startup(double r, double time, double nu) {
  const double s = r / radius;
  if (time == 0) return 0;
  double velocity = 1 - s * s;
  for (int k = 1; k <= 30; ++k) {
    double l = (k - 0.25) * pi;  // McMahon's first guess
    for (int i = 0; i < 6; ++i) l += std::cyl_bessel_j(0, l) / std::cyl_bessel_j(1, l);
    velocity -= 8 * std::cyl_bessel_j(0, l * s) / (l * l * l * std::cyl_bessel_j(1, l)) *
                std::exp(-l * l * nu * time / (radius * radius));
  }
  return velocity;
}

double startup_error(int across, const std::string& scheme, int steps) {
  constexpr double length = 0.5, viscosity = 0.4, end = 0.5;  // nu t / R^2 = 0.13: 47 % of the flow
  const double pressure = 4 * viscosity * length / (radius * radius);
  const Case setup = rigid_case(viscosity, pressure, scheme, end, steps);
  const auto exact = [=](double r, double time) { return startup(r, time, viscosity / density); };
  RigidPipe<P2P1AxisymmetricTriangle> pipe(setup, rigid_pipe<P2P1AxisymmetricTriangle>(across, 1, length), length,
                                           exact);
  return pipe.error_at_end();
}

TEST(StartUpOfPoiseuilleFlow, IsOfThirdOrderInSpace) {
  ConvergenceTable errors("start-up of Poiseuille flow, p2p1 axisymmetric", {"u"});
  for (int m : {1, 2, 4}) errors.add(1.0 / m, {startup_error(2 * m, "tr-bdf2", 100)});
  errors.print();
  EXPECT_NEAR(errors.last_order(0), 3, 0.3);
  EXPECT_LT(errors.last_error(0), 3e-4);
}

TEST(StartUpOfPoiseuilleFlow, IsOfTheOrderOfTheSchemeInTime) {
  for (const auto& [scheme, order] : {std::pair{"euler", 1}, std::pair{"tr-bdf2", 2}}) {
    ConvergenceTable errors(scheme, {"u"});
    for (int count : {10, 20}) errors.add(1.0 / count, {startup_error(16, scheme, count)});
    errors.print();
    EXPECT_NEAR(errors.last_order(0), order, 0.25) << scheme;
  }
}

}  // namespace

}  // namespace fsi::test::rigid_pipe_flow_tests
