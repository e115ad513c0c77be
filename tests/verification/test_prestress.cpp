// A wall that carries a load in the shape of its mesh (docs/theory.md, section 4.6): exact derivatives of the equations
// of its unloaded shape, rest under the load, and the answer of a tube whose unloaded shape is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "fem/elements.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/errors.hpp"
#include "support/every_element.hpp"
#include "support/inflated_tube.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"
#include "system/prestress.hpp"
#include "system/system.hpp"

namespace fsi::test::prestress_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
using MeshOf = SimplexMesh<Element::dim, Element::order>;

/// Newton's method on a static wall from its rest.
template <int n>
NewtonReport solve_wall(Scene<n>& scene, State& state, double pressure, const std::vector<double>& support_loads = {},
                        int steps = 1) {
  System<n> system("wall", scene, number_wall(scene));
  StepData data;
  const double first = scene.initial_load ? scene.initial_load->pressure : 0.0;
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.tolerance = options.residual_tolerance = 1e-10;
  NewtonReport report;
  for (int s = 1; s <= steps; ++s) {
    data.wall_pressure = first + (pressure - first) * s / steps;
    data.support_loads = support_loads;
    system.work_on(state, data);
    report = newton(system, options);
    EXPECT_TRUE(report.converged) << report.failure;
  }
  return report;
}

/// A curved block of two boxes a side, clamped on one side, loaded on two others.
template <class Element>
std::unique_ptr<Scene<Element::components>> loaded_block(const std::string& material) {
  constexpr int n = Element::components;
  auto mesh = irregular_mesh<Element>(2, "media");
  const double first = Element::axisymmetric ? 1 : 0;
  const int last = Element::axis[n - 1];
  name_boundary(mesh, "wall_ends", [&](const Point& x) { return std::abs(x[last]) < 1e-9; });
  name_boundary(mesh, "top", [&](const Point& x) { return std::abs(x[last] - 1) < 1e-9; });
  name_boundary(mesh, "side", [&](const Point& x) { return std::abs(x[0] - first - 1) < 1e-9; });
  curve<Element>(mesh, 0.1);
  Case setup = coupled_case(material);
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.structure->layers.erase("adventitia");
  setup.structure->bulk_modulus = 200;
  setup.structure->axis_origin = {-2, 0.5, 0};
  setup.supports["side"].pressure = PressureTable{{{0, 1.0}}};
  for (int k = 0; k < n; ++k) setup.supports["top"].traction.push_back(PressureTable{{{0, 1.0}}});
  setup.supports["top"].spring = 5;
  return build_scene<Element>(setup, mesh);
}

template <class Element>
class PrestressOfElement : public testing::Test {};
TYPED_TEST_SUITE(PrestressOfElement, Elements, ElementNames);

TYPED_TEST(PrestressOfElement, EquationsOfTheUnloadedShapeAreDifferentiatedExactly) {
  constexpr int n = TypeParam::components;
  const auto scene = loaded_block<TypeParam>("neo-hookean");
  const auto& x = scene->wall->nodes().nodes;
  scene->wall->find_unloaded_shape(true);
  const std::vector<double> loads(scene->wall->supports()->load_count(), 1.0);
  const auto residual = [&](const std::vector<double>& at, WallMatrix<n>* jacobian = nullptr) {
    WallInput in;
    in.wall = at.data();
    in.support_loads = loads.data();
    std::vector<double> r;
    EXPECT_FALSE(scene->wall->assemble(in, 0, at, r, jacobian).inverted());
    return r;
  };
  auto state = random_field(x, n + 1, 0.05, 0.01, 21);
  for (std::size_t i = n; i < state.size(); i += n + 1) state[i] *= 20;  // kPa
  WallMatrix<n> jacobian(scene->wall->graph());
  const auto at_state = residual(state, &jacobian);
  EXPECT_LT(norm(difference(at_state, residual(state))), 1e-14 * norm(at_state));
  for (const auto& [name, first, count] : {std::tuple{"displacement", 0, n}, std::tuple{"pressure", n, 1}}) {
    const auto direction = only(random_field(x, n + 1, 0.2, 0.05, 22), n + 1, first, count);
    const auto table = central_differences(
        std::string("unloaded shape by ") + name, [&](double t) { return residual(moved(state, t, direction)); },
        multiply(jacobian, direction), 0.05, 16);
    first == 0 ? expect_second_order(table) : expect_exact(table);
  }
}

// det F from the unloaded shape to the mesh is looked at where the search ends.
TYPED_TEST(PrestressOfElement, AnUnloadedShapeFarFromTheVolumeIsNone) {
  const auto scene = loaded_block<TypeParam>("neo-hookean");
  const std::vector<double> loads(scene->wall->supports()->load_count(), 0.4);
  EXPECT_NO_THROW(find_prestress(*scene, 0, loads));
  scene->volume_factor = 1 + 1e-6;
  std::string said;
  try {
    find_prestress(*scene, 0, loads);
  } catch (const ConvergenceError& failure) {
    said = failure.what();
  }
  EXPECT_NE(said.find("prestress: no unloaded shape found"), std::string::npos) << said;
  EXPECT_NE(said.find("det F is "), std::string::npos) << said;
  EXPECT_NE(said.find("in layer media"), std::string::npos) << said;
}

// What the unloaded shape is found from balances to rounding, whatever the element: no step moves anything.
TYPED_TEST(PrestressOfElement, IsAtRestUnderItsLoad) {
  constexpr int n = TypeParam::components;
  for (const char* material : {"neo-hookean", "artery"}) {
    SCOPED_TRACE(material);
    const auto scene = loaded_block<TypeParam>(material);
    std::vector<double> loads(scene->wall->supports()->load_count(), 0.4);
    loads.back() = -0.3;
    const auto prestress = find_prestress(*scene, 0, loads);
    EXPECT_GT(largest(prestress.displacement), 0.02) << "a load that is no trifle";
    start_from(prestress, 0, loads, *scene);
    State state = scene->at_rest();
    solve_wall<n>(*scene, state, 0, loads);
    double moved = 0;
    for (std::size_t i = 0; i < state.now.wall.size(); ++i)
      if (i % (n + 1) < n) moved = std::max(moved, std::abs(state.now.wall[i]));
    EXPECT_LT(moved, 1e-10);
  }
}

/// The tube of section 13.1 as a body of revolution, its inner radius `a` now, 3 m quadrilaterals through the wall.
TriangleMesh inflated_ring(int m, double a) {
  const double height = 0.13 / m;
  const auto radius = [&](int i) {
    const double at_rest = inner_radius + (outer_radius - inner_radius) * i / (3.0 * m);
    return std::sqrt(at_rest * at_rest + a * a - inner_radius * inner_radius);
  };
  auto mesh = triangle_grid(
      {3 * m, 1}, {"media", "adventitia"},
      [&](int i, int j) {
        return Point{radius(i), 0, j * height};
      },
      [&](int i, int) { return i < 2 * m ? 0 : 1; });
  name_boundary(mesh, "inner", [&](const Point& x) { return x[0] == radius(0); });
  name_boundary(mesh, "symmetry_z", [](const Point& x) { return x[2] == 0; });
  name_boundary(mesh, "symmetry_z", [&](const Point& x) { return x[2] == height; });
  return mesh;
}

template <class Element>
MeshOf<Element> mesh_for(const TriangleMesh& mesh) {
  if constexpr (Element::order == 1)
    return mesh;
  else
    return with_mid_edge_nodes(mesh);
}

/// Of a mesh at a / R_i = 1.2 under the pressure that belongs to it: how far the unloaded inner radius is from R_i, and
/// how far, at more pressure, that of a / R_i = 1.3 and 1.1 from the pressure applied, relative to it.
template <class Element>
std::vector<double> errors_of_imaged_tube(const Tube& tube, int m, double bulk_modulus) {
  const double a = 1.2 * inner_radius;
  std::string material = tube.name;
  std::transform(material.begin(), material.end(), material.begin(), [](char c) { return std::tolower(c); });
  Case setup = coupled_case(material);
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.load = PressureTable{{{0.0, 1.0}}};
  setup.structure->bulk_modulus = bulk_modulus;
  setup.structure->stabilisation = 0.5;
  setup.structure->layer_pressure = LayerPressure::separate;
  auto scene = build_scene<Element>(setup, mesh_for<Element>(inflated_ring(m, a)));
  const double pressure = inflation_pressure(tube, a);
  const WallPrestress prestress = find_prestress(*scene, pressure, {});
  start_from(prestress, pressure, {}, *scene);
  const auto& nodes = scene->wall->nodes().nodes;
  const auto mean_inner = [&](auto value) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i][0] < a + 1e-9) {
        sum += value(static_cast<int>(i));
        ++count;
      }
    return sum / count;
  };
  std::vector<double> errors = {
      std::abs(a - mean_inner([&](int i) { return prestress.displacement[2 * i]; }) - inner_radius) / inner_radius};
  for (const double stretch : {1.3, 1.1}) {
    State state = scene->at_rest();
    const double load = inflation_pressure(tube, stretch * inner_radius);
    solve_wall<2>(*scene, state, load, {}, 3);
    const double now = a + mean_inner([&](int i) { return state.now.wall[3 * i]; });
    errors.push_back(std::abs(inflation_pressure(tube, now) / load - 1));
  }
  return errors;
}

// The exact unloaded shape is that of the closed form, and from then on the wall answers as the tube that was inflated
// from there: the mesh in its loaded shape and the material's law in the unloaded one.
TEST(ImagedTube, AnswersAsTheTubeInflatedFromItsUnloadedShape) {
  for (const Tube& tube : {tubes()[0], tubes()[2]}) {
    ConvergenceTable quadratic(std::string(tube.name) + ", Taylor-Hood", {"unloaded radius", "a/R 1.3", "a/R 1.1"});
    for (int m : {1, 2}) quadratic.add(1.0 / m, errors_of_imaged_tube<P2P1AxisymmetricTriangle>(tube, m, 1e9));
    quadratic.print();
    ConvergenceTable linear(std::string(tube.name) + ", linear", {"unloaded radius", "a/R 1.3", "a/R 1.1"});
    for (int m : {4, 8, 16}) linear.add(1.0 / m, errors_of_imaged_tube<P1AxisymmetricTriangle>(tube, m, 1e7));
    linear.print();
    for (int column = 0; column < 3; ++column) {
      EXPECT_LT(quadratic.last_error(column), 2e-5);
      EXPECT_LT(linear.last_error(column), 2e-4);
      EXPECT_GT(linear.last_order(column), 1.7) << "second, not yet in full where fibres stiffen";
    }
    EXPECT_GT(quadratic.last_order(0), 2.8);
  }
}

TEST(ImagedTube, TooSoftForItsLoadIsRefused) {
  Case setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  setup.time.reset();
  setup.load = PressureTable{{{0.0, 1.0}}};
  auto scene = build_scene<P1AxisymmetricTriangle>(setup, inflated_ring(1, 1.2 * inner_radius));
  try {
    find_prestress(*scene, 500.0, {});
    FAIL() << "found one";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("prestress: no unloaded shape found"), std::string::npos) << error.what();
  }
}

}  // namespace

}  // namespace fsi::test::prestress_tests
