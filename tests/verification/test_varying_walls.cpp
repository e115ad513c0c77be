// Constants of the wall that vary from point to point (docs/theory.md, section 4.8): exact derivatives, a field that is
// constant against the constant, and a bar whose modulus is linear along it against its exact displacement.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "materials/varying_law.hpp"
#include "scene/build_scene.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/every_element.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::varying_walls_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

const Material laws[] = {NeoHookean{3},
                         MooneyRivlin{3, 0.3},
                         Artery{3, 2.3632, 0.8393, 1, 29},
                         Artery{3, 2.3632, 0.8393, 1, 29, 0.2},
                         Yeoh{3, 0.7, 0.2},
                         HolzapfelGasserOgden{3, 2.3632, 0.8393, 0.9, 1.7, 0.2, 29},
                         CompressibleNeoHookean{{0, 0, 0, 0}, 3, 40},
                         SaintVenantKirchhoff{{9, 0.3}},
                         LinearElastic{{9, 0.3}}};
const char* const law_names[] = {"neo-hookean",  "mooney-rivlin", "artery",
                                 "dispersed",    "yeoh",          "holzapfel-gasser-ogden",
                                 "compressible", "venant",        "linear"};

/// A wall of one layer; of `variation` > 0 its constants and its viscosity change by up to that share across it.
template <class Element>
std::unique_ptr<WallProblem<Element>> wall_of(const Material& material, double variation, double viscosity) {
  auto mesh = irregular_mesh<Element>(2, "media");
  curve<Element>(mesh, 0.05);
  auto wall = std::make_unique<WallProblem<Element>>(whole(mesh), WallConstants{1.2, 50.0, 0.5},
                                                     std::vector<std::pair<int, Material>>{{0, material}},
                                                     CylinderAxis{{{-2, 0.5, 0}}, {{0, 0, 1}}});
  wall->set_viscosity(0, viscosity);
  if (variation < 0) return wall;
  const LawConstants<double> mean = law_constants(material, 50.0);
  const double angle = fibre_angle(material);
  wall->vary(0, false, [=](int, const Point& x, double weight) {
    EXPECT_GT(weight, 0);
    const double s = 1 + variation * std::sin(3 * x[0] + 2 * x[1] + x[2]);
    LawHere here{mean, angle * s};
    double factor = s;
    for (double& constant : here.constants.of_law) {
      constant *= factor;
      factor = 2 - factor;
    }
    here.constants.shear_modulus *= s;
    here.constants.bulk_modulus *= 2 - s;
    here.constants.viscosity = viscosity * s;
    return here;
  });
  return wall;
}

/// What a wall is asked for in a step.
template <class Element>
class Asked {
 public:
  static constexpr int n = Element::components;
  explicit Asked(const std::vector<Point>& nodes)
      : solution(random_field(nodes, n + 1, 0.04, 0.01, 1)),
        reference(random_field(nodes, n + 1, 0.04, 0.01, 2)),
        history(random_field(nodes, n, 1.0, 0.1, 3)),
        direction(random_field(nodes, n + 1, 0.3, 0.1, 4)) {
    // A stretch that keeps fibres taut: where one becomes slack the tangent jumps.
    const double three[] = {0.75, 1.2, 1.2}, plane[] = {0.75, 1.3, 1}, body[] = {1.25, 1, 0.9};
    const double* stretch = Element::dim == 3 ? three : Element::axisymmetric ? body : plane;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (int k = 0; k < n; ++k)
        solution[(n + 1) * a + k] += (stretch[Element::axis[k]] - 1) * nodes[a][Element::axis[k]];
      solution[(n + 1) * a + n] *= 20;  // kPa
    }
  }

  WallInput at(const std::vector<double>& here) const {
    WallInput in{here.data(), history.data(), 16.0};
    in.velocity_reference = reference.data();
    in.velocity_rate = 4;
    return in;
  }
  std::vector<double> residual(WallProblem<Element>& wall, const std::vector<double>& here,
                               WallMatrix<n>* jacobian = nullptr) const {
    std::vector<double> r;
    EXPECT_FALSE(wall.assemble(at(here), 0, here, r, jacobian).inverted());
    return r;
  }

  std::vector<double> solution, reference, history, direction;
};

template <class Element>
class VaryingWallOf : public testing::Test {};
TYPED_TEST_SUITE(VaryingWallOf, Elements, ElementNames);

TYPED_TEST(VaryingWallOf, JacobianIsTheDerivativeOfTheResidualOfEveryLaw) {
  using Element = TypeParam;
  for (std::size_t i = 0; i < std::size(laws); ++i) {
    SCOPED_TRACE(law_names[i]);
    const auto made = wall_of<Element>(laws[i], 0.4, 2.5);
    auto& wall = *made;
    const Asked<Element> ask(wall.nodes().nodes);
    WallMatrix<Element::components> jacobian(wall.graph());
    const auto at_state = ask.residual(wall, ask.solution, &jacobian);
    const auto product = multiply(jacobian, ask.direction);
    EXPECT_LT(norm(difference(at_state, ask.residual(wall, ask.solution))), 1e-14 * norm(at_state));
    expect_second_order(central_differences(
        law_names[i], [&](double t) { return ask.residual(wall, moved(ask.solution, t, ask.direction)); }, product,
        0.05, 16));
    const auto constant = wall_of<Element>(laws[i], -1, 2.5);
    EXPECT_GT(norm(difference(at_state, ask.residual(*constant, ask.solution))), 0.02 * norm(at_state))
        << "a variation that can be seen";
  }
}

TYPED_TEST(VaryingWallOf, FieldThatIsConstantIsTheConstant) {
  using Element = TypeParam;
  for (std::size_t i = 0; i < std::size(laws); ++i) {
    SCOPED_TRACE(law_names[i]);
    const auto made = wall_of<Element>(laws[i], -1, 2.5), made_varying = wall_of<Element>(laws[i], 0, 2.5);
    auto &constant = *made, &varying = *made_varying;
    const Asked<Element> ask(constant.nodes().nodes);
    WallMatrix<Element::components> of_field(constant.graph()), jacobian(varying.graph());
    const auto expected = ask.residual(constant, ask.solution, &jacobian);
    const auto found = ask.residual(varying, ask.solution, &of_field);
    EXPECT_LT(norm(difference(found, expected)), 1e-13 * norm(expected));
    const auto product = multiply(jacobian, ask.direction);
    EXPECT_LT(norm(difference(multiply(of_field, ask.direction), product)), 1e-13 * norm(product));

    const auto one = constant.energy(ask.solution, ask.history, ask.reference, {});
    const auto two = varying.energy(ask.solution, ask.history, ask.reference, {});
    EXPECT_NEAR(two.isochoric, one.isochoric, 1e-12 * std::abs(one.isochoric));
    EXPECT_NEAR(two.volumetric, one.volumetric, 1e-12 * std::abs(one.volumetric));
    WallStep step;
    step.balance = ask.at(ask.solution);
    step.reference = step.start = step.wall_before = ask.reference.data();
    step.end = ask.solution.data();
    step.rate = 4;
    step.duration = 0.25;
    step.velocity_start = step.velocity_end = ask.history.data();
    const WallWork works[] = {constant.work(step), varying.work(step)};
    for (const auto member : {&WallWork::inertia, &WallWork::stress, &WallWork::stabilisation, &WallWork::viscous})
      EXPECT_NEAR(works[1].*member, works[0].*member, 1e-11 * (std::abs(works[0].*member) + one.isochoric));

    std::vector<double> unloaded, of_constant;
    constant.find_unloaded_shape(true);
    varying.find_unloaded_shape(true);
    const WallInput in{ask.solution.data()};
    constant.assemble(in, 0, ask.solution, of_constant, &jacobian);
    varying.assemble(in, 0, ask.solution, unloaded, &of_field);
    EXPECT_LT(norm(difference(unloaded, of_constant)), 1e-12 * norm(of_constant));
  }
}

// --- a bar -----------------------------------------------------------------------------------------------------------

constexpr double low_modulus = 100, slope = 300, pull = 5;  // kPa, kPa/mm, kPa

/// Values of E = low + slope z along the bar's axis at points about it, as a file has them.
std::shared_ptr<const FieldSamples> modulus_along(int axis) {
  FieldSamples samples;
  for (int i = -1; i <= 5; ++i)
    for (int j = -1; j <= 9; ++j)
      for (int k = -1; k <= 5; ++k) {
        samples.places.push_back({0.25 * j, 0.25 * i, 0.25 * k});
        samples.values.push_back(low_modulus + slope * samples.places.back()[axis]);
      }
  return std::make_shared<const FieldSamples>(std::move(samples));
}

/// Root mean square of the error of the displacement of a bar that is pulled at its end, of nu = 0: sections stay plane,
///   u(z) = pull / slope ln(1 + slope z / low).
template <class Element>
double error_of_bar(int boxes) {
  constexpr int n = Element::components;
  const int axis = Element::axis[n - 1];
  auto mesh = irregular_mesh<Element>(boxes, "media");
  Case setup;
  setup.structure = StructureData{};
  setup.structure->density = 1;
  MaterialData layer = layer_of("linear-elastic", {{"young", 400.0}, {"poisson", 0.0}});
  for (auto& [key, value] : ParameterValues{{"young", 400.0}, {"poisson", 0.0}}) layer.values[key] = value;
  layer.fields["young"] = {"modulus.csv", "young", 0, modulus_along(axis), ""};
  setup.structure->layers["media"] = layer;
  name_boundary(mesh, "low", [&](const Point& x) { return std::abs(x[axis]) < 1e-9; });
  setup.supports["low"].fixed = {"normal"};
  const double first = Element::axisymmetric ? 1 : 0;
  for (int k = 0; k < n - 1; ++k) {
    if (Element::axisymmetric) continue;
    const std::string name = std::string("side_") + "xyz"[Element::axis[k]];
    name_boundary(mesh, name, [&](const Point& x) { return std::abs(x[Element::axis[k]] - first) < 1e-9; });
    setup.supports[name].fixed = {"normal"};
  }
  name_boundary(mesh, "high", [&](const Point& x) { return std::abs(x[axis] - 1) < 1e-9; });
  for (int k = 0; k < n; ++k)
    setup.supports["high"].traction.push_back(PressureTable{{{0.0, k == n - 1 ? pull : 0.0}}});
  setup.static_load = StaticData{1};
  const auto scene = build_scene<Element>(setup, mesh);
  const auto& material = scene->wall->layer_data()[0].material;
  EXPECT_NEAR(2 * shear_modulus(material), low_modulus + slope / 2, 2.5) << "what stands for the layer is the mean";
  const Loads loads(setup);
  NewtonOptions options;
  options.tolerance = 1e-11;
  NewtonStepper<n> stepper(*scene, loads, options, number_wall(*scene));
  State state = scene->at_rest();
  stepper.advance(state);

  const auto& wall = static_cast<const WallProblem<Element>&>(*scene->wall);
  std::vector<double> places;
  for (const Point& x : wall.nodes().nodes)
    for (int k = 0; k < n; ++k) places.push_back(x[Element::axis[k]]);
  double squares = 0, volume = 0;
  for (const auto& pack : wall.layers()[0].packs.of_thread(0)) {
    NodalVector<Element> d{}, x{};
    gather<MixedLayout<n>>(d, pack, state.now.wall.data());
    gather<VectorLayout<n>>(x, pack, places.data());
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(pack.geometry, q);
      const auto u = value_of(d, g), at = value_of(x, g);
      for (int lane = 0; lane < pack.filled; ++lane) {
        const double exact = pull / slope * std::log(1 + slope * at[axis][lane] / low_modulus);
        for (int i = 0; i < 3; ++i) squares += g.weight[lane] * std::pow(u[i][lane] - (i == axis ? exact : 0.0), 2);
        volume += g.weight[lane];
      }
    }
  }
  return std::sqrt(squares / volume);
}

TYPED_TEST(VaryingWallOf, BarOfLinearModulusStretchesAsItsLogarithmSays) {
  using Element = TypeParam;
  // Irregular meshes, none a refinement of another: the order from the first to the last.
  constexpr bool solid = Element::dim == 3;
  const int first = solid && Element::order == 2 ? 2 : 4, last = solid ? 2 * first : 16;
  std::vector<double> errors;
  for (int boxes = first; boxes <= last; boxes *= 2) errors.push_back(error_of_bar<Element>(boxes));
  const double order = std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
  fmt::print("error {:.3g} mm, order {:.2f}\n", errors.back(), order);
  EXPECT_GT(order, Element::order == 1 ? 1.7 : 2.6);
  EXPECT_LT(errors.back(), (Element::order == 1 ? 1e-2 : 2e-3) * pull / slope * std::log(1 + slope / low_modulus));
}

// A hole in a field, and a field that makes no material, are told with the place.
TEST(VaryingConstants, AreRefusedWhereThereAreNone) {
  using Element = P1PlaneTriangle;
  const auto mesh = irregular_mesh<Element>(2, "media");
  Case setup;
  setup.path = "case.toml";
  setup.structure = StructureData{};
  setup.structure->density = 1;
  MaterialData layer{"linear-elastic", {{"young", 400.0}, {"poisson", 0.3}}};
  FieldSamples samples{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {1, 2, 3}, {}, {}, {}};
  layer.fields["young"] = {"modulus.csv", "young", 0, std::make_shared<const FieldSamples>(samples), ""};
  setup.structure->layers["media"] = layer;
  setup.static_load = StaticData{1};
  try {
    build_scene<Element>(setup, mesh);
    FAIL() << "a hole";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("modulus.csv: structure.layers.media.young: has a hole at ("), std::string::npos) << said;
    EXPECT_NE(said.find("within"), std::string::npos) << said;
  }
}

}  // namespace

}  // namespace fsi::test::varying_walls_tests
