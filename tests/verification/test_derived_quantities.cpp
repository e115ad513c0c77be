// What is made of solutions, against closed forms: wall shear stress of Poiseuille's and Womersley's flow, forces on
// surfaces against the pressures that they balance, stresses of the inflated tube.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "derived/stress_invariants.hpp"
#include "derived/surface_forces.hpp"
#include "derived/wall_shear_stress.hpp"
#include "derived/wall_stress.hpp"
#include "fem/elements.hpp"
#include "mesh/group_names.hpp"
#include "support/channels.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/inflated_tube.hpp"
#include "support/orthogonal.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "support/vessels.hpp"
#include "system/system.hpp"

namespace fsi::test::derived_quantities_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

/// A flow along the channel, u(x) at the coordinate across.
template <class Element, class Profile>
Solution flow_along(const Scene<Element::components>& scene, Profile profile) {
  constexpr int n = Element::components;
  Solution level = scene.at_rest().now;
  for (int a = 0; a < scene.fluid->node_count(); ++a)
    for (int k = 0; k < n; ++k)
      if (Element::axis[k] == along_axis<Element>)
        level.fluid[MixedLayout<n>::vector(a, k)] = profile(scene.fluid->nodes().nodes[a][across_axis<Element>]);
  return level;
}

/// Largest difference of the wall shear stress at inner nodes of the surface `upper` from `along`, in the flow's
/// direction.
template <class Element>
double shear_error(const WallShearStress<Element::components>& shear, const Scene<Element::components>& scene,
                   const Solution& level, double upper, double along) {
  const auto values = shear.at_nodes(level);
  double largest = 0;
  int count = 0;
  for (std::size_t i = 0; i < shear.nodes().size(); ++i) {
    const Point& x = scene.fluid->nodes().nodes[shear.nodes()[i]];
    if (std::abs(x[across_axis<Element>] - upper) > 1e-12) continue;
    if (Element::dim == 3 && (x[2] < 1e-12 || x[2] > 1 - 1e-12)) continue;  // on the edge of another wall
    ++count;
    for (int k = 0; k < 3; ++k)
      largest = std::max(largest, std::abs(values[3 * i + k] - (k == along_axis<Element> ? along : 0)));
  }
  EXPECT_GT(count, 2);
  return largest;
}

template <class Element>
class WallShear : public testing::Test {};
TYPED_TEST_SUITE(WallShear, Elements);

// u = U (1 - r^2), which recovered gradients see exactly: tau = 2 mu U at r = 1, with the flow.
TYPED_TEST(WallShear, OfAParabolaIsExact) {
  const auto mesh = channel<TypeParam>(TypeParam::dim == 3 ? 3 : 4, 0);
  const Case setup = fluid_case(1, 0.4);
  const auto scene = build_scene<TypeParam>(setup, mesh);
  const auto shear = make_wall_shear_stress<TypeParam>(setup, mesh, *scene);
  const auto level = flow_along<TypeParam>(*scene, [](double r) { return 3 * (1 - r * r); });
  EXPECT_LT(shear_error<TypeParam>(*shear, *scene, level, 1, 2 * 0.4 * 3), 1e-11);
}

// The viscosity is that of the shear rate at the wall, 6 1/ms, on a channel that has widened 4.8 1/ms: by hand
// 0.4 / sqrt(6) and 0.4 / sqrt(4.8).
TYPED_TEST(WallShear, OfALawIsThatOfTheShearRateAtTheWall) {
  constexpr int n = TypeParam::components;
  const auto mesh = channel<TypeParam>(TypeParam::dim == 3 ? 3 : 4, 0);
  Case setup = fluid_case(1, 123);
  setup.fluid->viscosity_model = ViscosityData{
      "power-law", {{"consistency", 0.4}, {"exponent", 0.5}, {"lowest_viscosity", 1e-6}, {"highest_viscosity", 1e6}}};
  const auto scene = build_scene<TypeParam>(setup, mesh);
  const auto shear = make_wall_shear_stress<TypeParam>(setup, mesh, *scene);
  auto level = flow_along<TypeParam>(*scene, [](double r) { return 3 * (1 - r * r); });
  EXPECT_LT(shear_error<TypeParam>(*shear, *scene, level, 1, 0.4 * std::sqrt(6.0)), 1e-11);
  level.mesh.assign(VectorLayout<n>::size(scene->fluid->node_count()), 0.0);
  for (int a = 0; a < scene->fluid->node_count(); ++a)
    for (int k = 0; k < n; ++k)
      if (TypeParam::axis[k] == across_axis<TypeParam>)
        level.mesh[VectorLayout<n>::vector(a, k)] = 0.25 * scene->fluid->nodes().nodes[a][across_axis<TypeParam>];
  EXPECT_LT(shear_error<TypeParam>(*shear, *scene, level, 1, 0.4 * std::sqrt(6.0 / 1.25)), 1e-11);
}

/// Womersley's flow [Womersley1955] in a pipe of radius 1 at the time when the pressure gradient is `phase` of its
/// period old: u(r) = Re[(1 - J_0(b r) / J_0(b)) e^(i phase)], b = i^(3/2) alpha.
class Womersley {
 public:
  Womersley(double alpha, double phase) : b_(alpha * std::exp(i * (3 * pi / 4))), turn_(std::exp(i * phase)) {}
  double velocity(double r) const { return (turn_ * (1.0 - bessel(0, b_ * r) / bessel(0, b_))).real(); }
  double slope(double r) const { return (turn_ * b_ * bessel(1, b_ * r) / bessel(0, b_)).real(); }

 private:
  using Complex = std::complex<double>;
  static constexpr Complex i{0, 1};
  static inline const double pi = std::acos(-1.0);
  /// J_order by its power series.
  static Complex bessel(int order, Complex z) {
    Complex term = order == 0 ? 1.0 : 0.5 * z, sum = 0;
    for (int k = 0; k < 60; ++k) {
      sum += term;
      term *= -0.25 * z * z / static_cast<double>((k + 1) * (k + 1 + order));
    }
    return sum;
  }
  Complex b_, turn_;
};

TYPED_TEST(WallShear, OfWomersleysFlowHasItsOrder) {
  const double alpha = 3;
  const Womersley flow(alpha, 0.8);
  constexpr int coarsest = TypeParam::dim == 3 ? 4 : 8, levels = TypeParam::dim == 3 ? 2 : 3;
  double errors[3] = {};
  for (int l = 0; l < levels; ++l) {
    const auto mesh = channel<TypeParam>(coarsest << l, 0);
    const Case setup = fluid_case(1, 0.4);
    const auto scene = build_scene<TypeParam>(setup, mesh);
    const auto shear = make_wall_shear_stress<TypeParam>(setup, mesh, *scene);
    // In flat channels the profile serves as any other smooth one.
    const auto level = flow_along<TypeParam>(*scene, [&](double r) { return flow.velocity(r); });
    const double exact = -0.4 * flow.slope(1);
    errors[l] = shear_error<TypeParam>(*shear, *scene, level, 1, exact) / (0.4 * alpha);  // about its amplitude
  }
  const double order = std::log2(errors[levels - 2] / errors[levels - 1]);
  std::printf("wall shear stress, error over amplitude %.2e %.2e %.2e: order %.2f\n", errors[0], errors[1], errors[2],
              order);
  EXPECT_GT(order, TypeParam::order + 1 - 0.3);
  EXPECT_LT(errors[levels - 1], TypeParam::dim == 3 ? 0.06 : 0.006);
}

// On a domain that has been stretched across by a factor 1.25: the slope falls by it, and directions stay.
TYPED_TEST(WallShear, SeesTheCurrentConfiguration) {
  constexpr int n = TypeParam::components;
  const auto mesh = channel<TypeParam>(TypeParam::dim == 3 ? 3 : 4, 0);
  const Case setup = fluid_case(1, 0.4);
  const auto scene = build_scene<TypeParam>(setup, mesh);
  const auto shear = make_wall_shear_stress<TypeParam>(setup, mesh, *scene);
  auto level = flow_along<TypeParam>(*scene, [](double r) { return 3 * (1 - r * r); });
  level.mesh.assign(VectorLayout<n>::size(scene->fluid->node_count()), 0.0);
  for (int a = 0; a < scene->fluid->node_count(); ++a)
    for (int k = 0; k < n; ++k)
      if (TypeParam::axis[k] == across_axis<TypeParam>)
        level.mesh[VectorLayout<n>::vector(a, k)] = 0.25 * scene->fluid->nodes().nodes[a][across_axis<TypeParam>];
  EXPECT_LT(shear_error<TypeParam>(*shear, *scene, level, 1, 2 * 0.4 * 3 / 1.25), 1e-11);
}

/// The fluid after one long step of backward Euler from rest.
template <class Element>
Balance flow_under_pressure(Scene<Element::components>& scene, double pressure, double step) {
  constexpr int n = Element::components;
  System<n> system("fluid", scene, number_fluid(scene));
  State state = scene.at_rest();
  StepData data;
  data.time = step;
  data.rates = scene.integrator->rates(state, step);
  data.opening_pressures = {pressure};
  system.work_on(state, data);
  NewtonOptions options;
  options.tolerance = 1e-12;
  const auto report = newton(system, options);
  EXPECT_TRUE(report.converged) << report.failure;
  return {state.now, data};
}

template <class Element>
class Forces : public testing::Test {};
TYPED_TEST_SUITE(Forces, Elements);

// Without inertia the walls hold what the pressure pushes: F = p A along the channel, to the tolerance of the solver, on
// any mesh, though the flow is resolved by three elements. The pressure's part on walls along the flow is zero.
TYPED_TEST(Forces, OnAllWallsBalanceThePressureAtTheInlet) {
  const auto mesh = channel<TypeParam>(3);
  Case setup = fluid_case(1e-9, 0.4);
  setup.output.derived.surfaces = {"walls", "lower", group::inlet};
  const auto scene = build_scene<TypeParam>(setup, mesh);
  const auto forces = make_surface_forces<TypeParam>(setup, mesh, *scene);
  const double pressure = 0.7;
  const auto found = forces->at(flow_under_pressure<TypeParam>(*scene, pressure, 1.0));
  const double pi = std::acos(-1.0), area = TypeParam::axisymmetric ? 3 * pi : 1;
  constexpr int z = along_axis<TypeParam>;
  EXPECT_NEAR(found[2].area, area, 1e-12);
  EXPECT_NEAR(found[0].force[z], pressure * area, 1e-8 * pressure * area);
  EXPECT_NEAR(found[0].pressure[z], 0, 1e-12);
  EXPECT_GT(found[1].force[z], 0.05 * pressure * area);
  EXPECT_LT(found[1].force[z], 0.6 * pressure * area);
  if (TypeParam::axisymmetric) {
    EXPECT_NEAR(found[1].area, 2 * pi, 1e-12);
    EXPECT_EQ(found[0].force[0], 0);
  }
  // The inlet is pushed back by the pressure that is prescribed there, as far as the mesh resolves it.
  EXPECT_NEAR(found[2].force[z], -pressure * area, 0.25 * pressure * area);
}

// A fluid at rest under one pressure, in a box that is open at one end: each wall bears p A along its normal and nothing
// across, also where walls meet at edges. There rows hold a share of both.
TYPED_TEST(Forces, OfAFluidAtRestAreThePressureTimesTheArea) {
  auto mesh = channel<TypeParam>(3);
  Case setup = fluid_case(1, 0.4);
  setup.fluid->outlet = false;
  setup.output.derived.surfaces = {"upper"};
  setup.output.derived.forces["corner"] = {"upper", "outlet"};
  const auto scene = build_scene<TypeParam>(setup, mesh);
  const auto forces = make_surface_forces<TypeParam>(setup, mesh, *scene);
  Balance balance;
  State state = scene->at_rest();
  balance.data.rates = scene->integrator->rates(state, 1.0);
  balance.data.opening_pressures = {2.0};
  balance.at = state.now;
  for (int a = 0; a < scene->fluid->node_count(); ++a)
    balance.at.fluid[MixedLayout<TypeParam::components>::scalar(a)] = 2.0;
  const auto found = forces->at(balance);
  const double pi = std::acos(-1.0), end = TypeParam::axisymmetric ? 3 * pi : 1;
  ASSERT_EQ(forces->names(), (std::vector<std::string>{"upper", "corner"}));
  for (int k = 0; k < 3; ++k) {
    const double up = k == across_axis<TypeParam> && !TypeParam::axisymmetric ? 2 : 0;
    EXPECT_NEAR(found[0].force[k], up, 1e-12) << k;
    EXPECT_NEAR(found[1].force[k], up + (k == along_axis<TypeParam> ? 2 * end : 0), 1e-12) << k;
    EXPECT_NEAR(found[1].pressure[k], found[1].force[k], 1e-12) << k;
  }
}

TEST(ForcesOnSurfaces, RefuseWhatIsNoneOfTheFluids) {
  auto mesh = channel<P1PlaneTriangle>(3);
  Case setup = fluid_case(1, 0.4);
  setup.path = "case.toml";
  const auto scene = build_scene<P1PlaneTriangle>(setup, mesh);
  const auto message = [&] {
    try {
      make_surface_forces<P1PlaneTriangle>(setup, mesh, *scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  setup.output.derived.surfaces = {"uper"};
  EXPECT_NE(message().find("output.surfaces"), std::string::npos) << message();
  EXPECT_NE(message().find("\"uper\" is no surface of the mesh"), std::string::npos) << message();
  EXPECT_NE(message().find("walls, inlet, outlet, lower or upper"), std::string::npos) << message();
  setup.output.derived.surfaces = {};
  setup.output.derived.forces["both"] = {"upper", "outlet"};
  EXPECT_NE(message().find("output.forces.both.surfaces"), std::string::npos) << message();
  EXPECT_NE(message().find("joins openings"), std::string::npos) << message();
}

/// A piece of the tube of docs/theory.md, section 13.1, inflated to inner radius a: its exact displacement at the nodes,
/// r^2 = R^2 + a^2 - R_i^2, and pressures that make sigma_r a given function.
template <class Element>
struct ExactTube {
  static constexpr int n = Element::components;
  Case setup;
  MeshOf<Element> mesh;
  std::unique_ptr<Scene<n>> scene;
  std::vector<double> wall;

  ExactTube(const Tube& tube, int m, double a) {
    const int along = 4;
    const double height = 0.4;
    auto grid = triangle_grid(
        {3 * m, along}, {"media", "adventitia"},
        [&](int i, int j) {
          return Point{inner_radius + (outer_radius - inner_radius) * i / (3.0 * m), 0, j * height / along};
        },
        [&](int i, int) { return i < 2 * m ? 0 : 1; });
    if constexpr (Element::order == 1)
      mesh = grid;
    else
      mesh = with_mid_edge_nodes(grid);
    name_surface<Element>(mesh, group::inner, 0, inner_radius);
    name_surface<Element>(mesh, group::wall_ends, 2, 0);
    std::string material = tube.name;
    std::transform(material.begin(), material.end(), material.begin(), [](char c) { return std::tolower(c); });
    setup = coupled_case(material);
    setup.geometry = Geometry::axisymmetric;
    setup.fluid.reset();
    setup.inlet.reset();
    setup.time.reset();
    setup.load = PressureTable{{{0.0, 1.0}}};
    setup.structure->layer_pressure = LayerPressure::separate;
    scene = build_scene<Element>(setup, mesh);
    wall.assign(scene->wall->space().mixed_size(), 0.0);
    for (int node = 0; node < scene->wall->node_count(); ++node) {
      const double radius = scene->wall->nodes().nodes[node][0];
      wall[MixedLayout<n>::vector(node, 0)] = std::sqrt(radius * radius + a * a - inner_radius * inner_radius) - radius;
      wall[MixedLayout<n>::scalar(node)] = 0.1 * radius;
    }
  }
};

struct StressErrors {
  double hoop = 0, axial = 0, mean = 0, fibre = 0;  ///< kPa, largest at any vertex of any layer
};

template <class Element>
StressErrors stress_errors(const Tube& tube, int m) {
  const double a = 1.15 * inner_radius;
  const ExactTube<Element> exact(tube, m, a);
  const auto stress = make_wall_stress<Element>(exact.setup, exact.mesh, *exact.scene);
  const auto found = stress->of(exact.wall);
  StressErrors errors;
  for (std::size_t l = 0; l < 2; ++l) {
    const auto& layer = tube.layers[l];
    const auto& data = exact.scene->wall->layer_data();  // by name: adventitia before media
    for (const int node : data[1 - l].nodes) {
      if (!exact.scene->wall->space().carries_scalar(node)) continue;
      const double big_r = exact.scene->wall->nodes().nodes[node][0];
      const double s = std::sqrt(big_r * big_r + a * a - inner_radius * inner_radius) / big_r;
      const auto& sigma = found.cauchy[node];
      // Invariants of section 5: axial against radial as hoop against radial, with stretch 1 and sin^2 alpha.
      double axial = 0;
      std::visit([&](const auto& law) { axial = law.shear_modulus() * (1 - 1 / (s * s)); }, layer.material);
      double fibres = 0, cosine = 0;
      if (const auto* artery = std::get_if<Artery>(&layer.material)) {
        cosine = std::cos(artery->fibre_angle());
        const double e = s * s * cosine * cosine - cosine * cosine;
        fibres = 4 * artery->k1 * std::exp(artery->k2 * e * e) * e;
        axial += fibres * (1 - cosine * cosine);
        const double f = s * s * cosine * cosine, z = 1 - cosine * cosine;
        const double along = (f * sigma(1, 1) + z * sigma(2, 2)) / (f + z);
        for (const auto& family : found.of_fibres)
          errors.fibre = std::max(errors.fibre, std::abs(family[node] - along));
      } else {
        EXPECT_TRUE(found.of_fibres[0].empty());
        errors.mean = std::max(errors.mean, std::abs(trace(sigma) / 3 + 0.1 * big_r));
      }
      errors.hoop =
          std::max(errors.hoop, std::abs(sigma(1, 1) - sigma(0, 0) - hoop_stress_difference(layer.material, s)));
      if (tube.name != std::string("Mooney-Rivlin"))
        errors.axial = std::max(errors.axial, std::abs(sigma(2, 2) - sigma(0, 0) - axial));
    }
  }
  return errors;
}

template <class Element>
void expect_stress_order(const Tube& tube, double order, double error) {
  StressErrors errors[3];
  for (int l = 0; l < 3; ++l) {
    errors[l] = stress_errors<Element>(tube, 2 << l);
    std::printf("%s, %d elements through the wall: hoop %.2e, axial %.2e, mean %.2e, fibre %.2e\n", tube.name, 6 << l,
                errors[l].hoop, errors[l].axial, errors[l].mean, errors[l].fibre);
  }
  EXPECT_GT(std::log2(errors[1].hoop / errors[2].hoop), order);
  EXPECT_LT(errors[2].hoop, error);
  EXPECT_LE(errors[2].axial, error);
  EXPECT_LT(errors[2].mean, 1e-12);  // S' is deviatoric, whatever the gradient
  EXPECT_LT(errors[2].fibre, 1e-10);
}

// sigma_theta - sigma_r of section 13.1 on both sides of the layers' boundary, where it jumps by a factor of ten.
TEST(StressOfTheTube, LinearElementsAreOfSecondOrder) {
  for (const auto& tube : tubes()) expect_stress_order<P1AxisymmetricTriangle>(tube, 1.7, 0.01);
}
TEST(StressOfTheTube, QuadraticElementsAreOfThirdOrder) {
  for (const auto& tube : tubes()) expect_stress_order<P2P1AxisymmetricTriangle>(tube, 2.6, 1e-4);
}

/// A random field of vectors as `size` numbers a node, of which the vectors are the first, turned.
template <class Element>
std::vector<double> random_vectors(const MeshOf<Element>& mesh, const Mat3<double>& q, int entries, double size,
                                   bool of_revolution) {
  constexpr int n = Element::components;
  Random random(5);
  std::vector<double> field(mesh.nodes.size() * static_cast<std::size_t>(entries), 0.0);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    Vec3<double> u{};
    for (int k = 0; k < n; ++k) u[Element::axis[k]] = size * random();
    if (of_revolution && mesh.nodes[a][0] == 0) u[0] = 0;
    u = q * u;
    for (int k = 0; k < n; ++k)
      field[a * static_cast<std::size_t>(entries) + static_cast<std::size_t>(k)] = u[Element::axis[k]];
  }
  return field;
}

template <class Element>
class TurnedBodies : public testing::Test {};
TYPED_TEST_SUITE(TurnedBodies, Elements);

// Of any velocity, on a domain that has been deformed: 20 rotations and reflections, at every node.
TYPED_TEST(TurnedBodies, HaveTheTurnedWallShearStress) {
  constexpr int n = TypeParam::components;
  const auto mesh = channel<TypeParam>(TypeParam::dim == 3 ? 3 : 5);
  const Case setup = fluid_case(1, 0.4);
  const auto shear_on = [&](const MeshOf<TypeParam>& body, const Mat3<double>& q) {
    const auto scene = build_scene<TypeParam>(setup, body);
    Solution level = scene->at_rest().now;
    level.fluid = random_vectors<TypeParam>(mesh, q, MixedLayout<n>::entries, 1, TypeParam::axisymmetric);
    level.mesh = random_vectors<TypeParam>(mesh, q, n, 0.01, TypeParam::axisymmetric);
    return make_wall_shear_stress<TypeParam>(setup, body, *scene)->at_nodes(level);
  };
  const auto at_rest = shear_on(mesh, orthogonal<P1AxisymmetricTriangle>(0));
  double size = 0, difference = 0;
  for (const double number : at_rest) size = std::max(size, std::abs(number));
  for (unsigned i = 0; i < 20; ++i) {
    const auto q = orthogonal<TypeParam>(i);
    const auto found = shear_on(turned<TypeParam>(mesh, q, i % 2 == 1), q);
    ASSERT_EQ(found.size(), at_rest.size());
    for (std::size_t a = 0; a < found.size(); a += 3) {
      const auto expected = q * Vec3<double>{{at_rest[a], at_rest[a + 1], at_rest[a + 2]}};
      for (int k = 0; k < 3; ++k)
        difference = std::max(difference, std::abs(found[a + static_cast<std::size_t>(k)] - expected[k]));
    }
  }
  EXPECT_LT(difference, 1e-10 * size);
}

TYPED_TEST(TurnedBodies, HaveTheTurnedWallStress) {
  constexpr int n = TypeParam::components;
  auto mesh = irregular_mesh<TypeParam>(TypeParam::dim == 3 ? 3 : 5, "wall");
  name_surface<TypeParam>(mesh, group::inner, across_axis<TypeParam>, TypeParam::axisymmetric ? 1 : 0);
  name_surface<TypeParam>(mesh, group::wall_ends, along_axis<TypeParam>, 0);
  Case setup = coupled_case("neo-hookean");
  const auto layer = setup.structure->layers.begin()->second;
  setup.structure->layers.clear();
  setup.structure->layers.emplace("wall", layer);
  setup.fluid.reset();
  setup.inlet.reset();
  setup.load = PressureTable{{{0.0, 1.0}}};
  const auto stress_on = [&](const MeshOf<TypeParam>& body, const Mat3<double>& q) {
    const auto scene = build_scene<TypeParam>(setup, body);
    return make_wall_stress<TypeParam>(setup, body, *scene)
        ->of(random_vectors<TypeParam>(mesh, q, MixedLayout<n>::entries, 0.01, TypeParam::axisymmetric))
        .cauchy;
  };
  const auto at_rest = stress_on(mesh, orthogonal<P1AxisymmetricTriangle>(0));
  double size = 0, difference = 0;
  for (const auto& sigma : at_rest) size = std::max(size, std::sqrt(contract(sigma, sigma)));
  for (unsigned i = 0; i < 20; ++i) {
    const auto q = orthogonal<TypeParam>(i);
    const auto found = stress_on(turned<TypeParam>(mesh, q, i % 2 == 1), q);
    for (std::size_t a = 0; a < found.size(); ++a) {
      const auto apart = found[a] - times_transposed(q * at_rest[a], q);
      difference = std::max(difference, std::sqrt(contract(apart, apart)));
    }
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(difference, 1e-10 * size);
}

// Poiseuille's flow at the nodes of a pipe of linear elements, however it lies: the same shear stress at every node, and
// 2 mu U / R as far as its facets are those of a circle.
TEST(WallShearOfAPipe, DoesNotDependOnHowItLies) {
  using Element = P1Tetrahedron;
  const int around = 24;
  ArteryShape shape;
  shape.inner_radius = 1;
  shape.media = 0.2;
  shape.adventitia = 0;
  shape.length = 1.5;
  ArteryCells cells;
  cells.lumen = 6;
  cells.media = 1;
  cells.around = around;
  cells.axial = 8;
  auto artery = generate_artery(shape, cells);
  const int fluid = artery.region_index(group::fluid);
  TetrahedralMesh pipe;
  const auto part = submesh(artery, {fluid});
  pipe.nodes = part.nodes;
  pipe.cells = part.cells;
  pipe.regions = {group::fluid};
  pipe.cell_region.assign(pipe.cells.size(), 0);
  for (const auto* name : {group::inlet, group::outlet}) {
    pipe.facet_groups.push_back({name, {}});
    for (const auto& facet : *artery.facets(name)) pipe.facet_groups.back().facets.push_back(part.local(facet));
  }
  const Case setup = fluid_case(1, 0.4);
  const auto shear_on = [&](const Mat3<double>& q, bool mirrors) {
    const auto body = turned<Element>(pipe, q, mirrors);
    const auto scene = build_scene<Element>(setup, body);
    Solution level = scene->at_rest().now;
    for (std::size_t a = 0; a < pipe.nodes.size(); ++a) {
      const Point& x = pipe.nodes[a];
      const auto u = q * Vec3<double>{{0, 0, 3 * (1 - x[0] * x[0] - x[1] * x[1])}};
      for (int k = 0; k < 3; ++k) level.fluid[MixedLayout<3>::vector(static_cast<int>(a), k)] = u[k];
    }
    const auto shear = make_wall_shear_stress<Element>(setup, body, *scene);
    const auto values = shear->at_nodes(level);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < shear->nodes().size(); ++i) {
      const double z = pipe.nodes[static_cast<std::size_t>(shear->nodes()[i])][2];
      if (z > 0.2 && z < 1.3) sizes.push_back(std::hypot(values[3 * i], values[3 * i + 1], values[3 * i + 2]));
    }
    return sizes;
  };
  const auto at_rest = shear_on(orthogonal<Element>(0), false);
  const double exact = 2 * 0.4 * 3;
  ASSERT_GT(at_rest.size(), 100u);
  for (const double tau : at_rest) EXPECT_NEAR(tau, exact, 1e-10 * exact);  // a quadratic field
  for (unsigned i = 1; i < 20; ++i) {
    const auto found = shear_on(orthogonal<Element>(i), i % 2 == 1);
    for (std::size_t a = 0; a < found.size(); ++a) EXPECT_NEAR(found[a], at_rest[a], 1e-10 * exact);
  }
}

}  // namespace

}  // namespace fsi::test::derived_quantities_tests
