// What holds and loads a wall from outside (docs/theory.md, section 4.5), as a case file asks for it: exact derivatives,
// homogeneous states, the bedded ring's closed form, a block on springs and dampers against its ODE.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "diagnostics/energy_balance.hpp"
#include "fem/elements.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/errors.hpp"
#include "support/every_element.hpp"
#include "support/inflated_tube.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::supports_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
using MeshOf = SimplexMesh<Element::dim, Element::order>;

/// A wall of one neo-Hookean layer.
template <class Element>
Case wall_case(double c10, double bulk_modulus) {
  Case setup;
  setup.element = Element::order == 1 ? ElementPair::p1 : ElementPair::p2p1;
  setup.geometry = Element::axisymmetric ? Geometry::axisymmetric
                   : Element::dim == 2   ? Geometry::plane
                                         : Geometry::three_dimensional;
  setup.structure = StructureData{};
  setup.structure->density = 1.2;
  setup.structure->bulk_modulus = bulk_modulus;
  setup.structure->layers["media"] = layer_of("neo-hookean", {{"c10", c10}});
  return setup;
}

/// A cube, a square, or a ring of inner radius 1, with its sides as surfaces `low_x`, `high_x`, ..., y and z likewise.
template <class Element>
MeshOf<Element> block(int boxes, bool curved = false) {
  auto mesh = irregular_mesh<Element>(boxes, "media");
  std::vector<std::pair<std::string, std::vector<int>>> names;
  const double first = Element::axisymmetric ? 1 : 0;
  for (int k = 0; k < Element::components; ++k) {
    const int axis = Element::axis[k];
    const double low = k == 0 ? first : 0;
    for (const bool high : {false, true})
      name_boundary(mesh, std::string(high ? "high_" : "low_") + "xyz"[axis],
                    [&](const Point& x) { return std::abs(x[axis] - (high ? low + 1 : low)) < 1e-9; });
  }
  if (curved) curve<Element>(mesh, 0.1);
  return mesh;
}

TimeData run_of(double step, double end) {
  TimeData time;
  time.step = step;
  time.end = end;
  return time;
}

PressureTable constant(double value) {
  return {{{0.0, value}}};
}

/// Static steps of a case on a mesh, by Newton's method with a direct solver.
template <class Element>
class StaticWall {
 public:
  static constexpr int n = Element::components;

  StaticWall(Case setup, const MeshOf<Element>& mesh) : setup_(std::move(setup)) {
    scene_ = build_scene<Element>(setup_, mesh);
    system_ = std::make_unique<System<n>>("wall", *scene_, number_wall(*scene_));
    state_ = scene_->at_rest();
  }

  /// Raises the loads to these in equal steps. \param supports  in the order of the case's support loads
  void raise_to(const std::vector<double>& supports, double inner, int steps = 4) {
    StepData data;
    data.rates = scene_->integrator->rates(state_, 0);
    NewtonOptions options;
    options.residual_tolerance = 1e-10;
    options.tolerance = 1e-12;
    const double first_inner = inner_;
    const auto first = supports_.empty() ? std::vector<double>(supports.size(), 0.0) : supports_;
    for (int s = 1; s <= steps; ++s) {
      const auto between = [&](double from, double to) { return from + (to - from) * s / steps; };
      data.wall_pressure = between(first_inner, inner);
      data.support_loads.resize(supports.size());
      for (std::size_t i = 0; i < supports.size(); ++i) data.support_loads[i] = between(first[i], supports[i]);
      system_->work_on(state_, data);
      const auto report = newton(*system_, options);
      EXPECT_TRUE(report.converged) << report.failure;
    }
    inner_ = inner;
    supports_ = supports;
  }

  double displacement(int node, int component) const {
    return state_.now.wall[MixedLayout<n>::vector(node, component)];
  }
  const Scene<n>& scene() const { return *scene_; }
  const std::vector<double>& wall() const { return state_.now.wall; }
  const std::vector<Point>& nodes() const { return scene_->wall->nodes().nodes; }

 private:
  Case setup_;
  std::unique_ptr<Scene<n>> scene_;
  std::unique_ptr<System<n>> system_;
  State state_;
  std::vector<double> supports_;
  double inner_ = 0;
};

template <class Element>
class SupportOfElement : public testing::Test {};
TYPED_TEST_SUITE(SupportOfElement, Elements, ElementNames);

/// A wall with every kind of support in the middle of a step.
template <class Element>
struct SupportedState {
  static constexpr int n = Element::components;
  std::unique_ptr<Scene<n>> scene;
  std::vector<double> wall, reference, loads;

  SupportedState() {
    Case setup = wall_case<Element>(3, 50);
    setup.time = run_of(0.5, 1);
    auto& side = setup.supports["high_x"];
    side.spring = 30;
    side.normal_damper = 20;
    side.pressure = constant(40);
    auto& other = setup.supports[Element::axisymmetric || Element::dim == 3 ? "high_z" : "high_y"];
    other.normal_spring = 50;
    other.damper = 10;
    for (int k = 0; k < n; ++k) other.traction.push_back(constant(1 + k));
    const auto mesh = block<Element>(2, /*curved=*/true);
    scene = build_scene<Element>(setup, mesh);
    const auto& x = scene->wall->nodes().nodes;
    wall = random_field(x, n + 1, 0.06, 0.01, 1);
    reference = random_field(x, n + 1, 0.06, 0.01, 2);
    loads.assign(scene->wall->supports()->load_count(), 40.0);
  }
  std::vector<double> residual(const std::vector<double>& at, BlockMatrix<n + 1, n + 1>* jacobian = nullptr) const {
    WallInput in;
    in.wall = at.data();
    in.velocity_reference = reference.data();
    in.velocity_rate = 1.5;
    in.support_loads = loads.data();
    std::vector<double> r(at.size(), 0.0);
    scene->wall->supports()->add(in, r, jacobian);
    return r;
  }
};

TYPED_TEST(SupportOfElement, SupportsAreDifferentiatedExactly) {
  constexpr int n = TypeParam::components;
  const SupportedState<TypeParam> state;
  ASSERT_EQ(state.loads.size(), 1u + n);
  BlockMatrix<n + 1, n + 1> jacobian(state.scene->wall->graph());
  const auto at_state = state.residual(state.wall, &jacobian);
  EXPECT_LT(norm(difference(at_state, state.residual(state.wall))), 1e-14 * norm(at_state));
  const auto direction = random_field(state.scene->wall->nodes().nodes, n + 1, 0.3, 0.1, 3);
  const auto table = central_differences(
      "supports", [&](double t) { return state.residual(moved(state.wall, t, direction)); },
      multiply(jacobian, direction), 0.5, 24);
  // The pressure is of second degree in the displacement, of third in bodies of revolution and on curved faces.
  EXPECT_LT(table.smallest(), 1e-9) << table.text();
  for (const double order : observed_orders(table, 1e-8)) EXPECT_NEAR(order, 2, 0.1) << table.text();
}

// A traction on one face, planes that hold their normals on those opposite: the stretch is the same everywhere and that
// of P = mu (lambda - lambda^-2) in three dimensions, mu (lambda - lambda^-3) in plane strain. Elements hold it exactly.
TYPED_TEST(SupportOfElement, TractionStretchesABlockHomogeneously) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const double mu = 6, stretch = 1.3, rise = Element::dim == 2 && !Element::axisymmetric ? 3 : 2;
  Case setup = wall_case<Element>(mu, 1e9);
  const double load = mu * (stretch - std::pow(stretch, -rise));
  const int axis = Element::axis[n - 1];
  const std::string name(1, "xyz"[axis]);
  auto& pulled = setup.supports["high_" + name];
  for (int k = 0; k < n; ++k) pulled.traction.push_back(constant(k == n - 1 ? load : 0.0));
  for (int k = 0; k < n; ++k) {
    if (Element::axisymmetric && k == 0) continue;  // a solid of revolution would need its axis
    setup.supports[std::string("low_") + "xyz"[Element::axis[k]]].fixed = {"normal"};
  }
  std::vector<double> loads(n, 0.0);
  loads.back() = load;
  StaticWall<Element> wall(setup, block<Element>(2));
  wall.raise_to(loads, 0);
  const double across = std::pow(stretch, Element::dim == 2 && !Element::axisymmetric ? -1.0 : -0.5);
  double largest = 0;
  for (std::size_t a = 0; a < wall.nodes().size(); ++a)
    for (int k = 0; k < n; ++k) {
      const double x = wall.nodes()[a][Element::axis[k]], exact = ((k == n - 1 ? stretch : across) - 1) * x;
      largest = std::max(largest, std::abs(wall.displacement(static_cast<int>(a), k) - exact));
    }
  EXPECT_LT(largest, 3e-8);
}

// The same turned about an oblique axis: planes that are along no axis of space.
TEST(FixedNormal, HoldsObliquePlanes) {
  using Element = P1Tetrahedron;
  auto mesh = block<Element>(2);
  Case setup = wall_case<Element>(6, 1e9);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto turned = [&](const Point& x) {
    const Point y{x[0], c * x[1] - s * x[2], s * x[1] + c * x[2]};
    return Point{c * y[0] - s * y[1], s * y[0] + c * y[1], y[2]};
  };
  for (auto& x : mesh.nodes) x = turned(x);
  for (const char* name : {"low_x", "low_y", "low_z"}) setup.supports[name].fixed = {"normal"};
  const double stretch = 1.3, load = 6 * (stretch - 1 / (stretch * stretch));
  const Point pull = turned({0, 0, 1});
  for (int k = 0; k < 3; ++k) setup.supports["high_z"].traction.push_back(constant(load * pull[k]));
  StaticWall<Element> wall(setup, mesh);
  wall.raise_to({load * pull[0], load * pull[1], load * pull[2]}, 0);
  double largest = 0;
  for (std::size_t a = 0; a < wall.nodes().size(); ++a) {
    const Point& x = wall.nodes()[a];
    const double along = x[0] * pull[0] + x[1] * pull[1] + x[2] * pull[2];
    for (int k = 0; k < 3; ++k) {
      const double across = 1 / std::sqrt(stretch) - 1;
      const double exact = across * x[k] + (stretch - 1 - across) * along * pull[k];
      largest = std::max(largest, std::abs(wall.displacement(static_cast<int>(a), k) - exact));
    }
  }
  EXPECT_LT(largest, 3e-8);
}

// --- the ring ------------------------------------------------------------------------------------------------------

/// The two-layer tube of section 13.1 between planes of symmetry, 3 m quadrilaterals through the wall.
TriangleMesh ring(int m) {
  const double height = 0.13 / m;
  const auto radius = [&](int i) { return inner_radius + (outer_radius - inner_radius) * i / (3.0 * m); };
  auto mesh = triangle_grid(
      {3 * m, 1}, {"media", "adventitia"},
      [&](int i, int j) {
        return Point{radius(i), 0, j * height};
      },
      [&](int i, int) { return i < 2 * m ? 0 : 1; });
  name_boundary(mesh, "inner", [](const Point& x) { return x[0] == inner_radius; });
  name_boundary(mesh, "outer", [](const Point& x) { return std::abs(x[0] - outer_radius) < 1e-9; });
  name_boundary(mesh, "symmetry_z", [](const Point& x) { return x[2] == 0; });
  name_boundary(mesh, "symmetry_z", [&](const Point& x) { return x[2] == height; });
  return mesh;
}

Case ring_case(double bulk_modulus) {
  Case setup = coupled_case("neo-hookean");
  setup.element = ElementPair::p2p1;
  setup.geometry = Geometry::axisymmetric;
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.load = constant(1);
  setup.structure->bulk_modulus = bulk_modulus;
  setup.structure->layer_pressure = LayerPressure::separate;
  return setup;
}

double inner_radius_of(const StaticWall<P2P1AxisymmetricTriangle>& wall) {
  double sum = 0;
  int count = 0;
  for (std::size_t a = 0; a < wall.nodes().size(); ++a)
    if (wall.nodes()[a][0] < inner_radius + 1e-9) {
      sum += wall.nodes()[a][0] + wall.displacement(static_cast<int>(a), 0);
      ++count;
    }
  return sum / count;
}

// At the outer radius b, B at rest, the bedding presses with k (b - B) on the area at rest, k (b - B) B / b on the
// current one: the inner pressure of the free tube at the same radius plus that.
TEST(BeddedRing, MeetsItsClosedForm) {
  const auto tube = tubes()[0];
  for (const bool normal : {true, false}) {
    ConvergenceTable table(normal ? "normal springs" : "springs", {"a/R 1.05", "a/R 1.2", "a/R 1.5"});
    for (int m : {1, 2, 4}) {
      Case setup = ring_case(1e9);
      const double stiffness = 2;  // kPa/mm: as much as the tube itself
      (normal ? setup.supports["outer"].normal_spring : setup.supports["outer"].spring) = stiffness;
      StaticWall<P2P1AxisymmetricTriangle> wall(setup, with_mid_edge_nodes(ring(m)));
      const auto pressure_at = [&](double a) {
        const double b = std::sqrt(outer_radius * outer_radius + a * a - inner_radius * inner_radius);
        return inflation_pressure(tube, a) + stiffness * (b - outer_radius) * outer_radius / b;
      };
      std::vector<double> errors;
      for (const double target : {1.05, 1.2, 1.5}) {
        const double pressure = pressure_at(target * inner_radius);
        wall.raise_to({}, pressure);
        errors.push_back(std::abs(pressure_at(inner_radius_of(wall)) / pressure - 1));
      }
      table.add(1.0 / m, errors);
    }
    table.print();
    for (int column = 0; column < 3; ++column) EXPECT_LT(table.last_error(column), 2e-5);
    EXPECT_GT(table.last_order(0), 2.9);
  }
}

// An incompressible wall cannot tell outer pressure from less inner pressure; its own pressure rises by as much.
TEST(OuterPressure, TakesAwayFromTheInnerOne) {
  Case setup = ring_case(1e9);
  setup.supports["outer"].pressure = constant(1);
  const auto mesh = with_mid_edge_nodes(ring(2));
  StaticWall<P2P1AxisymmetricTriangle> both(setup, mesh), one(setup, mesh);
  both.raise_to({0.7}, 0.9);
  one.raise_to({0}, 0.2);
  const auto& x = both.scene().wall->space();
  for (std::size_t a = 0; a < both.nodes().size(); ++a) {
    const int node = static_cast<int>(a);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(both.displacement(node, k), one.displacement(node, k), 1e-8);
    if (x.carries_scalar(node)) {
      EXPECT_NEAR(both.wall()[3 * a + 2] - one.wall()[3 * a + 2], 0.7, 1e-7);
    }
  }
  EXPECT_GT(std::abs(inner_radius_of(both) / inner_radius - 1), 0.1);
}

// --- what holds a wall at rest -------------------------------------------------------------------------------------

TEST(RigidMotion, OfAStaticWallIsRefused) {
  const auto mesh = block<P1Tetrahedron>(1);
  const auto complaint = [&](auto support) {
    Case setup = wall_case<P1Tetrahedron>(3, 50);
    setup.path = "case.toml";
    support(setup);
    try {
      build_scene<P1Tetrahedron>(setup, mesh);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string end =
      ": the wall could move as a rigid body; fix more components, give springs, or clamp wall_ends";
  EXPECT_EQ(complaint([](Case& c) {
              c.supports["low_x"].fixed = {"normal"};
              c.supports["low_y"].fixed = {"y"};
            }),
            "case.toml: support: nothing resists a displacement along z" + end);
  EXPECT_EQ(complaint([](Case& c) { c.supports["low_x"].fixed = {"x"}; }).find("case.toml: support: nothing resists"),
            0u);
  EXPECT_EQ(complaint([](Case& c) {
              for (const char* side : {"low_x", "low_y", "low_z"}) c.supports[side].fixed = {"normal"};
            }),
            "");
  EXPECT_EQ(complaint([](Case& c) { c.supports["low_x"].spring = 1; }), "");
  EXPECT_EQ(complaint([](Case& c) { c.supports["low_x"].normal_spring = 1; }).find("case.toml: support: nothing"), 0u);
  EXPECT_EQ(complaint([](Case& c) {
              c.supports["low_x"].normal_spring = 1;
              c.supports["high_x"].fixed = {"y", "z"};
            }),
            "");
}

// --- in time -------------------------------------------------------------------------------------------------------

/// A block that moves along y alone, so stiff that it moves as one: rho h y'' + c y' + k y = t.
class Oscillator {
 public:
  static constexpr double stiffness = 3, damping = 0.4, load = 0.2, mass = 1.2, end = 3;

  Oscillator(const std::string& scheme, int steps) : setup_(wall_case<P2P1PlaneTriangle>(1e7, 1e9)) {
    setup_.time = run_of(end / steps, end);
    setup_.time->scheme = scheme;
    setup_.time->scheme_values["damping"] = 0.0;
    setup_.supports["low_y"].spring = stiffness;
    setup_.supports["high_y"].damper = damping;
    setup_.supports["high_y"].traction = {constant(0), constant(load)};
    setup_.supports["low_x"].fixed = setup_.supports["high_x"].fixed = {"x"};
    scene_ = build_scene<P2P1PlaneTriangle>(setup_, block<P2P1PlaneTriangle>(1));
    loads_ = std::make_unique<Loads>(setup_);
    state_ = scene_->at_rest();
    energy_ = std::make_unique<EnergyBalance<2>>(*scene_, state_);
    NewtonOptions options;
    options.residual_tolerance = 0;
    options.tolerance = 1e-11;
    NewtonStepper<2> stepper(*scene_, *loads_, options, number_wall(*scene_), {});
    stepper.keep_balances(true);
    for (int step = 0; step < loads_->steps(); ++step) {
      const auto report = stepper.advance(state_);
      const EnergyRecord record = energy_->step_to(state_, report);
      supply_ += record.support_work;
      dissipated_ += record.damping;
      remainder_ = std::max(remainder_, std::abs(record.remainder));
      stored_ = record.springs;
    }
  }

  double position() const {
    double sum = 0;
    const auto& wall = state_.before[0].wall;
    for (std::size_t i = 1; i < wall.size(); i += 3) sum += wall[i];
    return sum / static_cast<double>(wall.size() / 3);
  }
  /// From rest under a load that is there from the start.
  static double exact_position() {
    const double decay = damping / (2 * mass), w = std::sqrt(stiffness / mass - decay * decay);
    return load / stiffness * (1 - std::exp(-decay * end) * (std::cos(w * end) + decay / w * std::sin(w * end)));
  }
  double error() const { return std::abs(position() / exact_position() - 1); }
  double supply_ = 0, dissipated_ = 0, remainder_ = 0, stored_ = 0;

 private:
  Case setup_;
  std::unique_ptr<Scene<2>> scene_;
  std::unique_ptr<Loads> loads_;
  State state_;
  std::unique_ptr<EnergyBalance<2>> energy_;
};

TEST(BlockOnSpringsAndDampers, FollowsItsEquationInTime) {
  for (const auto& [scheme, order] : {std::pair{"euler", 1}, std::pair{"midpoint", 2}, std::pair{"bdf2", 2},
                                      std::pair{"generalised-alpha", 2}, std::pair{"tr-bdf2", 2}}) {
    SCOPED_TRACE(scheme);
    ConvergenceTable table(scheme, {"position"});
    for (int steps : {40, 80, 160}) {
      const Oscillator block(scheme, steps);
      table.add(1.0 / steps, {block.error()});
      EXPECT_LT(block.remainder_, 1e-9 * block.supply_);
      EXPECT_NEAR(block.stored_, 0.5 * Oscillator::stiffness * std::pow(block.position(), 2), 1e-6 * block.stored_);
      EXPECT_GT(block.dissipated_, 0);
    }
    table.print();
    EXPECT_NEAR(table.last_order(0), order, 0.2);
    EXPECT_LT(table.last_error(0), order == 1 ? 0.02 : 1e-3);
  }
}

}  // namespace

}  // namespace fsi::test::supports_tests
