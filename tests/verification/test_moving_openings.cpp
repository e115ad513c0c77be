// Openings that move with wall ends that slide or are free (docs/theory.md, section 3.8): exact derivatives, closed-form
// inflation of a tube whose ends slide, the same answer in any orientation, energy.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algebra/block_products.hpp"
#include "base/error.hpp"
#include "diagnostics/energy_balance.hpp"
#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "linear/choice/general_solvers.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/moving_openings.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/moving_opening_scenes.hpp"
#include "support/random.hpp"
#include "support/ring_meshes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::moving_openings_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
class SurfaceOfElement : public testing::Test {};
using Elements = testing::Types<P1Tetrahedron, P1AxisymmetricTriangle, P1PlaneTriangle, P2P1Tetrahedron,
                                P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(SurfaceOfElement, Elements);

/// The upper side of a block of fluid, deformed and flowing, in both senses through it.
template <class Element>
struct Surface {
  static constexpr int n = Element::components;
  SimplexMesh<Element::dim, Element::order> mesh = irregular_mesh<Element>(1 + (Element::dim == 2));
  Submesh<Element::dim, Element::order> part;
  std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet> facets;
  std::shared_ptr<const MovingSurface<n>> moving;
  FluidJacobian<n> jacobian;
  std::vector<double> displacement, reference, flow;

  Surface() {
    const int axis = Element::axis[n - 1];
    facets = boundary_where(mesh, where(axis, 1));
    part = submesh(mesh, {0});
    for (auto& facet : facets) facet = part.local(facet);
    moving = moving_surface<Element>(part.nodes, facets);
    const auto space = function_space<Element>(part);
    jacobian.fluid = decltype(jacobian.fluid)(space.graph());
    jacobian.shape_derivatives = decltype(jacobian.shape_derivatives)(space.graph());
    displacement = random_field(part.nodes, n, 0.2, 0.02, 1);
    reference = random_field(part.nodes, n, 0.2, 0.02, 2);
    flow = random_field(part.nodes, n + 1, 0.5, 0.2, 3);
    const double middle = Element::axisymmetric ? 1.5 : 0.5;
    for (int a = 0; a < part.node_count(); ++a)
      flow[MixedLayout<n>::vector(a, n - 1)] += part.nodes[a][0] < middle ? 1.5 : -1.5;
  }
  FluidInput input(const std::vector<double>& mesh_now, const std::vector<double>& flow_now) const {
    FluidInput in;
    in.mesh = mesh_now.data();
    in.mesh_reference = reference.data();
    in.fluid = flow_now.data();
    in.mesh_factor = 3;
    return in;
  }
};

std::vector<double> moved(std::vector<double> x, double t, const std::vector<double>& direction) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += t * direction[i];
  return x;
}

TYPED_TEST(SurfaceOfElement, PressureAndFlowHaveTheirDerivatives) {
  constexpr int n = TypeParam::components;
  Surface<TypeParam> s;
  ASSERT_FALSE(s.facets.empty());
  const auto way = random_field(s.part.nodes, n, 0.3, 0.1, 5);
  std::vector<double> rows(s.flow.size(), 0.0);
  s.moving->add_pressure(1.7, s.displacement.data(), rows.data(), &s.jacobian.shape_derivatives);
  std::vector<double> derivative(rows.size());
  multiply(s.jacobian.shape_derivatives, way, derivative);
  const auto residual = [&](double t) {
    std::vector<double> r(rows.size(), 0.0);
    s.moving->add_pressure(1.7, moved(s.displacement, t, way).data(), r.data(), nullptr);
    return r;
  };
  EXPECT_EQ(residual(0), rows);
  const auto slope = s.moving->relative_outflow_slope(s.input(s.displacement, s.flow));
  double along = 0;
  for (std::size_t i = 0; i < slope.size(); ++i) along += slope[i] * way[i];
  const auto flow = [&](double t) {
    const auto mesh = moved(s.displacement, t, way);
    return std::vector<double>{s.moving->relative_outflow(s.input(mesh, s.flow))};
  };
  EXPECT_LT(central_differences("pressure", residual, derivative, 0.01, 2).smallest(),
            TypeParam::axisymmetric ? 1e-4 : 1e-10);  // cubic about the axis, else quadratic
  EXPECT_LT(central_differences("pressure", residual, derivative, 1e-3, 4).smallest(), 1e-8);
  EXPECT_LT(central_differences("flow", flow, {along}, 1e-3, 4).smallest(), 1e-8);
  // The flow's weights are the pressure's load; what the surface sweeps itself is taken off the flow.
  const double whole = s.moving->outflow(s.displacement.data(), s.flow.data());
  double through = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) through += rows[i] * s.flow[i] / 1.7;
  EXPECT_NEAR(through, whole, 1e-13);
  EXPECT_GT(std::abs(flow(0)[0] - whole), 1e-3);
}

TYPED_TEST(SurfaceOfElement, BackflowHasItsDerivativesByFlowAndMesh) {
  constexpr int n = TypeParam::components;
  Surface<TypeParam> s;
  std::vector<double> rows(s.flow.size(), 0.0);
  s.moving->add_backflow(1.3, 0.5, s.input(s.displacement, s.flow), rows.data(), &s.jacobian,
                         FluidDerivatives::fluid_and_domain);
  const auto by_flow = random_field(s.part.nodes, n + 1, 0.5, 0.1, 6),
             by_mesh = random_field(s.part.nodes, n, 0.2, 0.1, 7);
  for (const bool mesh_moves : {false, true}) {
    std::vector<double> derivative(rows.size());
    if (mesh_moves)
      multiply(s.jacobian.shape_derivatives, by_mesh, derivative);
    else
      multiply(s.jacobian.fluid, by_flow, derivative);
    const auto residual = [&](double t) {
      std::vector<double> r(rows.size(), 0.0);
      const auto mesh = mesh_moves ? moved(s.displacement, t, by_mesh) : s.displacement;
      const auto flow = mesh_moves ? s.flow : moved(s.flow, t, by_flow);
      s.moving->add_backflow(1.3, 0.5, s.input(mesh, flow), r.data(), nullptr, FluidDerivatives::none);
      return r;
    };
    EXPECT_GT(norm(rows), 1e-3);
    EXPECT_LT(norm(difference(residual(0), rows)), 1e-15);
    EXPECT_LT(central_differences("backflow", residual, derivative, 1e-3, 6).smallest(), 1e-7) << mesh_moves;
  }
  // What it takes is the product of its rows with the velocity.
  double power = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) power += rows[i] * s.flow[i];
  EXPECT_NEAR(s.moving->backflow_power(1.3, 0.5, s.input(s.displacement, s.flow)), power, 1e-13);
}

/// A surface that has not moved is the opening that stays.
TYPED_TEST(SurfaceOfElement, AtRestItIsTheOneThatStays) {
  constexpr int n = TypeParam::components;
  Surface<TypeParam> s;
  const auto open = open_boundary<TypeParam>("open", s.part.nodes, s.facets);
  const std::vector<double> rest(s.displacement.size(), 0.0);
  EXPECT_LT(norm(difference(s.moving->normals(rest.data()), open.normals())), 1e-14);
  auto moving = open;
  moving.move_by(s.moving);
  EXPECT_NEAR(moving.mean_pressure(rest, s.flow), open.mean_pressure(s.flow), 1e-14);
  FluidInput in = s.input(rest, s.flow);
  in.mesh_reference = rest.data();
  EXPECT_NEAR(s.moving->kinetic_outflow(in), open.kinetic_outflow(s.part.nodes, s.flow), 1e-13);
  BackflowFacets<TypeParam> facets(0.5, s.part, open.facets(), *s.jacobian.fluid.graph);
  std::vector<double> staying(s.flow.size(), 0.0), rows = staying;
  facets.add(1.3, s.flow.data(), staying.data(), nullptr);
  s.moving->add_backflow(1.3, 0.5, in, rows.data(), nullptr, FluidDerivatives::none);
  EXPECT_LT(norm(difference(rows, staying)), 1e-13);
  static_assert(n >= 2);
}

/// Newton's correction against differences of the residual along it: of the coupled system, of the fluid with a given
/// mesh, and of the fluid with its domain.
template <class Element>
void check_corrections(Case setup, const SimplexMesh<Element::dim, Element::order>& mesh, const std::string& solver,
                       double tolerance) {
  constexpr int n = Element::components;
  const auto scene = build_scene<Element>(setup, mesh);
  for (const auto& open : scene->fluid->open_boundaries()) ASSERT_NE(open.moving(), nullptr);
  State state = scene->at_rest();
  const auto &x = scene->fluid->nodes().nodes, &y = scene->wall->nodes().nodes;
  state.now.mesh = random_field(x, n, 0.04, 0.005, 1);
  state.now.fluid = random_field(x, n + 1, 1.0, 0.1, 2);
  state.now.wall = random_field(y, n + 1, 0.03, 0.005, 3);
  state.before[0].mesh = random_field(x, n, 0.04, 0.005, 4);
  state.before[0].fluid = random_field(x, n + 1, 1.0, 0.1, 5);
  state.before[0].wall = random_field(y, n + 1, 0.03, 0.005, 6);
  StepData data;
  data.rates = scene->integrator->rates(state, 0.5);
  data.opening_pressures = {0.9, 0.2};
  data.opening_flows = {0.7, -0.4};
  state.now.openings.assign(state.now.openings.size(), 0.3);
  data.support_loads.assign(state.support_loads, 0.1);
  scene->impose_interface(state, data.rates);
  for (const int which : {0, 1, 2}) {
    const auto make = [&] {
      return which == 0 ? number_scene(*scene) : which == 1 ? number_fluid(*scene) : number_fluid_and_domain(*scene);
    };
    FastOptions iterative;
    iterative.direct_below = 0;
    System<n> system("tested", *scene, make(), general_solver_factory<n>(solver, iterative));
    system.work_on(state, data);
    const auto equations = [&] {  // those of given flows behind the others
      std::vector<double> rows = system.residual();
      for (const double gap : system.flow_gaps()) rows.push_back(gap);
      return rows;
    };
    ASSERT_TRUE(std::isfinite(system.evaluate()));
    const std::vector<double> residual = equations();
    system.linearise();
    ASSERT_TRUE(std::isfinite(system.solve(1e-10)));
    double smallest = 1;
    for (const double step : {1e-3, 1e-4, 1e-5}) {
      system.move(step);
      system.evaluate();
      std::vector<double> ahead = equations();
      system.move(-2 * step);
      system.evaluate();
      const std::vector<double> behind = equations();
      system.move(step);
      for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = (ahead[i] - behind[i]) / (2 * step) + residual[i];
      smallest = std::min(smallest, norm(ahead) / norm(residual));
    }
    fmt::print("{}, system {}: {:.1e}\n", solver, which, smallest);
    EXPECT_LT(smallest, tolerance) << solver << ", system " << which;
  }
}

TEST(MovingOpenings, CorrectionsAreExact) {
  for (const auto ends : {Ends::slide, Ends::free}) {
    for (const bool mirrored : {false, true})
      check_corrections<P1Tetrahedron>(case_with(ends, "normal", 0.5), box<P1Tetrahedron>(2, turned, mirrored),
                                       "direct", 1e-6);
    auto setup = case_with(ends, "z", 0.5);
    setup.geometry = Geometry::axisymmetric;
    check_corrections<P2P1AxisymmetricTriangle>(setup, pipe<P2P1AxisymmetricTriangle>({2, 1, 1, 2}, 1), "direct", 1e-6);
    check_corrections<P1AxisymmetricTriangle>(setup, pipe<P1AxisymmetricTriangle>({3, 1, 1, 3}, 1), "direct", 1e-6);
    MeshMotionOptions elastic;
    elastic.method = MeshMotionMethod::nonlinear_elastic;
    setup.mesh_motion = elastic;
    check_corrections<P1AxisymmetricTriangle>(setup, pipe<P1AxisymmetricTriangle>({3, 1, 1, 3}, 1), "direct", 1e-6);
  }
  check_corrections<P1Tetrahedron>(case_with(Ends::slide, "normal", 0.5), box<P1Tetrahedron>(2, turned, true), "fast",
                                   1e-6);
}

/// The case with a flow that is given at the inlet, and perhaps at the outlet.
Case with_flows(Case setup, bool both) {
  for (auto& [name, conditions] : setup.openings)
    if (both || name == "inlet") {
      conditions = {};
      conditions.flow_rate = FlowRateData{PressureTable{{{0.0, 0.0}, {1.0, name == "inlet" ? 0.5 : 0.3}}}};
    }
  return setup;
}

TEST(MovingOpenings, CorrectionsWithAGivenFlowAreExact) {
  for (const auto ends : {Ends::slide, Ends::free})
    for (const bool both : {false, true}) {
      auto setup = with_flows(case_with(ends, "z", 0.5), both);
      setup.geometry = Geometry::axisymmetric;
      if (both) {  // of a fluid whose velocity is given on the wall, pressure is determined by one opening at least
        EXPECT_TRUE(
            build_scene<P1AxisymmetricTriangle>(setup, pipe<P1AxisymmetricTriangle>({3, 1, 1, 3}, 1))->has_flow_only());
        continue;
      }
      check_corrections<P2P1AxisymmetricTriangle>(setup, pipe<P2P1AxisymmetricTriangle>({2, 1, 1, 2}, 1), "direct",
                                                  1e-6);
      check_corrections<P1Tetrahedron>(with_flows(case_with(ends, "normal", 0.5), false),
                                       box<P1Tetrahedron>(2, turned, true), ends == Ends::free ? "direct" : "fast",
                                       1e-6);
    }
}

/// Marches `count` steps; calls see(state, record) after each.
template <class Element, class See>
std::unique_ptr<Scene<Element::components>> march(const Case& setup,
                                                  const SimplexMesh<Element::dim, Element::order>& mesh, int count,
                                                  See see) {
  constexpr int n = Element::components;
  auto scene = build_scene<Element>(setup, mesh);
  State state = scene->at_rest();
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-11;
  NewtonStepper<n> stepper(*scene, loads, options, number_scene(*scene));
  stepper.keep_balances(true);
  EnergyBalance<n> energy(*scene, state);
  for (int i = 0; i < count; ++i) {
    const StepReport report = stepper.advance(state);
    see(state, energy.step_to(state, report));
  }
  return scene;
}

TEST(MovingOpenings, EnergyBalances) {
  const auto check = [](auto element, Case setup, const auto& mesh) {
    using Element = decltype(element);
    for (const std::string scheme : {"euler", "midpoint", "generalised-alpha"}) {
      setup.time->scheme = scheme;
      double work = 0, largest = 0, backflow = 0;
      march<Element>(setup, mesh, 6, [&](const State&, const EnergyRecord& record) {
        work += std::abs(record.inlet_work);
        backflow += record.backflow;
        largest = std::max(largest, std::abs(record.remainder));
      });
      fmt::print("{}: work {:.3e} uJ, left over {:.1e}, backflow {:.1e}\n", scheme, work, largest, backflow);
      EXPECT_GT(work, 1e-4);
      EXPECT_GT(backflow, 0);
      EXPECT_LT(largest, 1e-8 * work);
    }
  };
  for (const auto ends : {Ends::slide, Ends::free}) {
    check(P1Tetrahedron(), case_with(ends, "normal", 0.3), box<P1Tetrahedron>(2, turned, false));
    auto setup = case_with(ends, "z", 0.3);
    setup.geometry = Geometry::axisymmetric;
    check(P2P1AxisymmetricTriangle(), setup, pipe<P2P1AxisymmetricTriangle>({2, 1, 1, 2}, 1));
  }
}

/// The scene turned in space gives the answer turned in space: at nodes in openings and on planes of symmetry, axes of
/// their own count what along the axes of space is one component.
TEST(MovingOpenings, AnyOrientationGivesOneAnswer) {
  for (const bool mirrored : {false, true}) {
    std::vector<Solution> solutions;
    std::vector<double> energies;
    for (const auto& rotation : {unturned, turned}) {
      auto setup = case_with(Ends::slide, "normal", 0.3);
      march<P1Tetrahedron>(setup, box<P1Tetrahedron>(2, rotation, mirrored), 3,
                           [&](const State& state, const auto& record) {
                             if (state.step == 3) {
                               solutions.push_back(state.now);
                               energies.push_back(record.energy());
                             }
                           });
    }
    double apart = 0, size = 0;
    for (std::size_t a = 0; a < solutions[0].wall.size(); a += 4)
      for (int i = 0; i < 3; ++i) {
        double expected = 0;
        for (int k = 0; k < 3; ++k) expected += turned[i][k] * solutions[0].wall[a + k];
        apart = std::max(apart, std::abs(solutions[1].wall[a + i] - expected));
        size = std::max(size, std::abs(expected));
      }
    EXPECT_GT(size, 1e-3);
    EXPECT_LT(apart, 1e-8 * size);
    EXPECT_NEAR(energies[1] / energies[0], 1, 1e-9);
  }
}

/// A tube whose ends slide is a piece of an infinite one: it inflates as in docs/theory.md, section 13.1, and the openings
/// widen with it. Backward Euler in long steps leads to rest.
template <class Element>
void check_inflation(const RingCells& cells, double tolerance) {
  const Tube tube = tubes()[0];
  const double radius = 1.1 * inner_radius, pressure = isotropic_inflation_pressure(tube, radius);
  Case setup = coupled_case("neo-hookean", 100);
  setup.geometry = Geometry::axisymmetric;
  setup.structure->bulk_modulus = 1e6;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.inlet.reset();
  for (const auto* name : {"inlet", "outlet"}) setup.openings[name].pressure = PressureTable{{{0, 0}, {300, pressure}}};
  setup.supports["ends"].fixed = std::vector<std::string>{"z"};
  State last;
  const auto scene =
      march<Element>(setup, pipe<Element>(cells, 1), 10, [&](const State& state, const auto&) { last = state; });
  for (const auto& node : scene->interface)
    EXPECT_NEAR(last.now.wall[MixedLayout<2>::vector(node.wall, 0)], radius - inner_radius, tolerance * inner_radius);
  for (const auto& open : scene->fluid->open_boundaries()) {
    double area = 0;
    for (const double share : open.moving()->areas(last.now.mesh.data())) area += share;
    EXPECT_NEAR(area / (std::acos(-1.0) * radius * radius), 1, 2 * tolerance);
    EXPECT_NEAR(open.mean_pressure(last.now.mesh, last.now.fluid), pressure, 1e-6 * pressure);
    EXPECT_NEAR(open.outflow(last.now.mesh, last.now.fluid), 0, 1e-5);  // it was filled at 5e-3 mm^3/ms
  }
}

TEST(MovingOpenings, TubeWithSlidingEndsInflatesAsAnInfiniteOne) {
  check_inflation<P2P1AxisymmetricTriangle>({3, 2, 1, 2}, 2e-4);
  check_inflation<P1AxisymmetricTriangle>({6, 6, 3, 3}, 5e-3);
}

TEST(MovingOpenings, StayWhereTheWallIsClamped) {
  const auto clamped = build_scene<P1Tetrahedron>(coupled_case("neo-hookean"), fluid_and_wall_box(2));
  EXPECT_EQ(clamped->fluid->open_boundaries()[0].moving(), nullptr);
}

/// Volume of a body of revolution of straight cells whose nodes have moved, by Pappus's theorem.
double moved_volume(const Submesh<2>& fluid, const std::vector<double>& displacement) {
  double volume = 0;
  for (const auto& cell : fluid.cells) {
    double r[3], z[3];
    for (int a = 0; a < 3; ++a) {
      r[a] = fluid.nodes[cell[a]][0] + displacement[VectorLayout<2>::vector(cell[a], 0)];
      z[a] = fluid.nodes[cell[a]][2] + displacement[VectorLayout<2>::vector(cell[a], 1)];
    }
    const double area = 0.5 * ((r[1] - r[0]) * (z[2] - z[0]) - (r[2] - r[0]) * (z[1] - z[0]));
    volume += 2 * std::acos(-1.0) * area * (r[0] + r[1] + r[2]) / 3;
  }
  return volume;
}

/// What flows in through openings as they move is what the fluid's domain gains, and a Windkessel without outlet behind
/// one of them keeps: also where they sweep along the flow. To second order: the midpoint rule's levels are not those that
/// its velocities lead to (docs/theory.md, section 8).
TEST(MovingOpenings, TheDomainGainsWhatIsGiven) {
  constexpr double compliance = 0.4, sealed = 1e12;
  const auto mesh = pipe<P1AxisymmetricTriangle>({3, 1, 1, 3}, 1);
  const auto fluid = submesh(mesh, {mesh.region_index(group::fluid)});
  const double before = moved_volume(fluid, std::vector<double>(2 * fluid.nodes.size(), 0.0));
  for (const auto ends : {Ends::slide, Ends::free})
    for (const auto& [scheme, stores] : {std::pair{"midpoint", false}, std::pair{"generalised-alpha", false},
                                         std::pair{"midpoint", true}, std::pair{"generalised-alpha", true}}) {
      double missed = 0.01;
      for (const int steps : {8, 16}) {
        auto setup = with_flows(case_with(ends, "z", 0.4 / steps), !stores);
        if (stores) setup.openings["outlet"].law = windkessel(0.3, compliance, sealed, 0, 0);
        setup.geometry = Geometry::axisymmetric;
        setup.time->scheme = scheme;
        double time = 0, gained = 0, swept = 0, left_over = 0, work = 0;
        march<P1AxisymmetricTriangle>(
            setup, mesh, steps, [&, stores = stores](const State& state, const EnergyRecord& record) {
              time = state.time;
              gained = moved_volume(fluid, state.now.mesh) - before;
              if (stores) gained += compliance * state.now.openings[0];
              for (std::size_t a = 0; a < fluid.nodes.size(); ++a)
                if (fluid.nodes[a][2] == 1)
                  swept = std::max(swept, std::abs(state.now.mesh[VectorLayout<2>::vector(static_cast<int>(a), 1)]));
              left_over = std::max(left_over, std::abs(record.remainder));
              work += std::abs(record.inlet_work);
            });
        const double given = 0.5 * (0.5 + (stores ? 0 : 0.3)) * time * time, error = std::abs(gained / given - 1);
        fmt::print("{}{}, {} steps: gained {:.6e} of {:.6e} mm^3, ends swept {:.1e} mm\n", scheme,
                   stores ? ", Windkessel" : "", steps, gained, given, swept);
        EXPECT_LT(error, missed / 3);
        missed = error;
        EXPECT_EQ(swept > 1e-4, ends == Ends::free);
        EXPECT_LT(left_over, 1e-8 * work);
      }
    }
}

/// A tube whose ends slide, filled through both of them: its radius is that of the volume, and the pressure that drives
/// the flow, once it has come to rest, that of docs/theory.md, section 13.1. The steps' error of the volume, of second
/// order, is less than that of the elements.
TEST(MovingOpenings, AGivenFlowWidensTheTubeAsItsVolumeSays) {
  const Tube tube = tubes()[0];
  const double radius = 1.1 * inner_radius, length = 1;
  const double volume = std::acos(-1.0) * length * (radius * radius - inner_radius * inner_radius);
  Case setup = coupled_case("neo-hookean", 20);
  setup.time->scheme = "bdf2";
  setup.geometry = Geometry::axisymmetric;
  setup.structure->bulk_modulus = 1e6;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.inlet.reset();
  for (const auto* name : {"inlet", "outlet"})
    setup.openings[name].flow_rate = FlowRateData{PressureTable{{{0, 0}, {200, volume / 400}, {400, 0}}}};
  setup.supports["ends"].fixed = std::vector<std::string>{"z"};
  State last;
  const auto scene = march<P2P1AxisymmetricTriangle>(setup, pipe<P2P1AxisymmetricTriangle>({3, 2, 1, 2}, length), 24,
                                                     [&](const State& state, const auto&) { last = state; });
  for (const auto& node : scene->interface)
    EXPECT_NEAR(last.now.wall[MixedLayout<2>::vector(node.wall, 0)], radius - inner_radius, 2e-4 * inner_radius);
  ASSERT_EQ(scene->openings.driven().size(), 2u);
  for (const auto& opening : scene->openings.driven()) {
    EXPECT_NEAR(Openings<2>::pressure(opening, last.last_balance().openings),
                isotropic_inflation_pressure(tube, radius), 1e-4);
    EXPECT_NEAR(opening.surface->outflow(last.now.mesh, last.now.fluid), 0, 1e-8);
  }
}

TEST(MovingOpenings, AGivenFlowHasNoProfile) {
  auto setup = with_flows(case_with(Ends::slide, "normal", 0.3), false);
  setup.openings["inlet"].flow_rate->profile = InflowProfile::plug;
  try {
    build_scene<P1Tetrahedron>(setup, box<P1Tetrahedron>(2, unturned, false));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("opening.inlet.profile: the wall's end at this opening is not clamped"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace

}  // namespace fsi::test::moving_openings_tests
