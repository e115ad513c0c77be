// Jacobians of whole systems of equations: the coupled one with its interface columns and those of the partitioned
// split, as Newton's method sees them.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "fem/gather_blocks.hpp"
#include "fem/held_components.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/differences.hpp"
#include "support/scenes.hpp"
#include "system/medium_system.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test::system_jacobians_tests {

namespace {

using Tet = P1Tetrahedron;

[[maybe_unused]] const int one_thread = set_threads(1);

/// A scene in the middle of a step, every field and history nonzero and nothing in equilibrium. Softer volume, more
/// viscous fluid and longer step than the artery's, so that no term drowns in another.
struct Scenario {
  std::unique_ptr<Scene<3>> scene;
  State state;
  StepData data;

  /// \param across  stretch of the wall across its layers, about their middle: fibres of an artery are stretched
  ///                below 1 and slack above; all of them, because the tangent jumps where a fibre tightens
  explicit Scenario(const std::string& material, double across = 1, bool grad_div = false,
                    LayerPressure layer_pressure = LayerPressure::continuous,
                    const MeshMotionOptions& mesh_motion = {}) {
    Case setup = coupled_case(material, 0.5);
    setup.structure->layer_pressure = layer_pressure;
    setup.mesh_motion = mesh_motion;
    setup.fluid = FluidData{1.3, 0.03, true, grad_div};
    setup.structure->bulk_modulus = 50;
    setup.structure->axis_origin = {0.4, 0.5,
                                    -1.0};  // fibres lie in planes near the layers', turning from element to element
    setup.structure->axis_direction = {0, 1, 0};
    scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3));
    state = scene->at_rest();
    const auto& x = scene->fluid->nodes().nodes;
    const auto& y = scene->wall->nodes().nodes;
    const auto wall_field = [&](double scale, unsigned seed) {
      auto field = random_field(y, 4, scale, 0.1 * scale, seed);
      for (std::size_t i = 3; i < field.size(); i += 4) field[i] *= 20;  // kPa
      return field;
    };
    state.now = {random_field(x, 3, 0.08, 0.01, 1), random_field(x, 4, 3.0, 0.5, 2), wall_field(0.06, 3)};
    state.before[0] = {random_field(x, 3, 0.08, 0.01, 4), random_field(x, 4, 3.0, 0.5, 5), wall_field(0.06, 6)};
    state.wall_velocity = random_field(y, 3, 0.5, 0.1, 7);
    state.wall_acceleration = random_field(y, 3, 0.5, 0.1, 8);
    for (auto* field : {&state.now.wall, &state.before[0].wall})  // one displacement at the copies of a node
      for (int a = 0; a < scene->wall->node_count(); ++a)
        std::copy_n(field->begin() + 4 * scene->wall->nodes().original_of(a), 3, field->begin() + 4 * a);
    const double stretch[3] = {1 / std::sqrt(across), 1 / std::sqrt(across), across}, middle[3] = {0.5, 0.5, 1.2};
    for (std::size_t a = 0; a < y.size(); ++a)
      for (int i = 0; i < 3; ++i) state.now.wall[4 * a + i] += (stretch[i] - 1) * (y[a][i] - middle[i]);
    data.rates = scene->integrator->rates(state, 0.5);
    scene->impose_interface(state, data.rates);
    data.opening_pressures = {1.332};
  }

  /// Gives a third of the nodes a frame of any axes, on both sides of the interface the same, with one or two components
  /// that are held: as at planes of symmetry and where two of them meet.
  void turn_nodes() {
    Random random(9);
    const auto condition = [&](int node, const HeldComponents<3>& held, NodalFrames<3>& frames, auto&... conditions) {
      frames.turn(node, held.axes);
      for (int k = 0; k < 3; ++k)
        if (held.held[k]) (conditions.fix(node, k), ...);
    };
    const auto held_components = [&] {
      std::vector<Direction<3>> normals(random() > 0 ? 2 : 1);
      for (auto& normal : normals) {
        for (double& x : normal) x = random();
        const double length = std::sqrt(fsi::detail::dot<3>(normal, normal));
        for (double& x : normal) x /= length;
      }
      return hold<3>(normals);
    };
    const auto& nodes = scene->wall->nodes();
    const auto turn_wall = [&](int node, const HeldComponents<3>& held) {
      for (int a = 0; a < nodes.node_count(); ++a)
        if (nodes.original_of(a) == node) condition(a, held, scene->wall_frames, scene->wall_conditions);
    };
    std::vector<char> wet_fluid(scene->fluid->node_count(), 0), wet_wall(nodes.node_count(), 0);
    for (const auto& node : scene->interface) {
      wet_fluid[node.fluid] = wet_wall[node.wall] = 1;
      if (random() > -0.3 || node.clamped) continue;
      const auto held = held_components();
      condition(node.fluid, held, scene->fluid_frames, scene->velocity_conditions, scene->mesh_conditions);
      turn_wall(node.wall, held);
    }
    for (int a = 0; a < scene->fluid->node_count(); ++a)
      if (!wet_fluid[a] && random() < -0.3)
        condition(a, held_components(), scene->fluid_frames, scene->velocity_conditions, scene->mesh_conditions);
    for (int a = 0; a < nodes.node_count(); ++a)
      if (nodes.original_of(a) == a && !wet_wall[a] && random() < -0.3) turn_wall(a, held_components());
  }
};

/// x -> R(x + t direction) of a system around a state.
class Line {
 public:
  Line(System<3>& system, const Scenario& from, std::vector<double> direction)
      : system_(system), from_(from), direction_(std::move(direction)) {}

  std::vector<double> operator()(double t) const {
    State there = from_.state;
    system_.work_on(there, from_.data);  // the numbering's factors are the step's
    const auto& numbering = system_.numbering();
    const auto add = [&](auto layout, const UnknownMap& map, const NodalFrames<3>& frames, std::vector<double>& field) {
      using Layout = decltype(layout);
      if (map.empty()) return;
      frames.to_frames<Layout>(field);
      add_to_field(map, direction_, t, field);
      frames.to_space<Layout>(field);
    };
    add(VectorLayout<3>(), numbering.mesh, from_.scene->fluid_frames, there.now.mesh);
    add(MixedLayout<3>(), numbering.fluid, from_.scene->fluid_frames, there.now.fluid);
    add(MixedLayout<3>(), numbering.wall, from_.scene->wall_frames, there.now.wall);
    EXPECT_TRUE(std::isfinite(system_.evaluate()));
    return system_.residual();
  }

 private:
  System<3>& system_;
  const Scenario& from_;
  std::vector<double> direction_;
};

enum class Group { mesh, fluid, fluid_pressure, interface, displacement, wall_pressure };

/// What each equation, and the unknown of its number, stands for.
std::vector<Group> groups_of(const Numbering& numbering, const Scenario& scenario) {
  std::vector<Group> group(static_cast<std::size_t>(numbering.size), Group::mesh);
  const auto set = [&](const UnknownMap& map, int entries, Group vector, Group scalar) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0) group[map[i].index] = static_cast<int>(i) % entries < 3 ? vector : scalar;
  };
  set(numbering.fluid_rows, 4, Group::fluid, Group::fluid_pressure);
  set(numbering.wall_rows, 4, Group::displacement, Group::wall_pressure);
  if (!numbering.fluid.empty() && !numbering.wall.empty())
    for (const auto& node : scenario.scene->interface)
      for (int k = 0; k < 3; ++k) {
        const auto unknown = numbering.wall[4 * node.wall + k].index;
        if (unknown >= 0) group[unknown] = Group::interface;
      }
  return group;
}

std::vector<double> part_of(const std::vector<double>& all, const std::vector<Group>& groups, Group wanted) {
  std::vector<double> part(all);
  for (std::size_t i = 0; i < part.size(); ++i)
    if (groups[i] != wanted) part[i] = 0;
  return part;
}

/// A random change of all unknowns: displacements a tenth of an element, velocities of order 1, pressures of order 5.
std::vector<double> direction_for(const std::vector<Group>& groups, unsigned seed) {
  static const std::map<Group, double> scales{{Group::mesh, 0.1},         {Group::fluid, 2},
                                              {Group::fluid_pressure, 5}, {Group::interface, 0.1},
                                              {Group::displacement, 0.1}, {Group::wall_pressure, 5}};
  Random random(seed);
  std::vector<double> direction(groups.size());
  for (std::size_t i = 0; i < direction.size(); ++i) direction[i] = scales.at(groups[i]) * random();
  return direction;
}

const std::map<Group, const char*> names{
    {Group::mesh, "mesh motion"},           {Group::fluid, "momentum"},
    {Group::fluid_pressure, "continuity"},  {Group::interface, "interface momentum"},
    {Group::displacement, "wall momentum"}, {Group::wall_pressure, "wall volume"}};

constexpr double first_step = 0.05;  // larger ones leave the range of second order

/// The assembled matrix against differences of the assembled residual, whole and group of equations by group: a block
/// of small entries cannot hide behind one of large ones.
void check_system(const Scenario& scenario, System<3>& system, const std::string& name) {
  State state = scenario.state;
  system.work_on(state, scenario.data);
  system.linearise();
  GatheredMatrix gathered = gather_jacobian(system.blocks());
  gathered.update();
  const SparseMatrix matrix = gathered.matrix();
  const auto groups = groups_of(system.numbering(), scenario);
  std::map<Group, int> present;
  for (Group g : groups) ++present[g];

  // All unknowns at once, then the columns of one group alone.
  std::vector<std::pair<std::string, std::vector<double>>> directions;
  for (unsigned seed : {1, 2}) directions.push_back({"all unknowns", direction_for(groups, seed)});
  if (present.count(Group::interface))
    directions.push_back({"interface", part_of(direction_for(groups, 3), groups, Group::interface)});
  for (const auto& [what, direction] : directions) {
    const auto derivative = product(matrix, direction);
    const Line line(system, scenario, direction);
    expect_second_order(central_differences(name + ", whole, by " + what, line, derivative, first_step));
    for (const auto& [group, count] : present) {
      const auto of_group = part_of(derivative, groups, group);
      if (norm(of_group) == 0) continue;  // these equations do not depend on these unknowns
      const auto table = central_differences(
          name + ", " + names.at(group) + ", by " + what,
          [&, wanted = group](double t) { return part_of(line(t), groups, wanted); }, of_group, first_step);
      const bool linear = group == Group::mesh && !scenario.scene->nonlinear_mesh_motion;
      linear ? expect_exact(table) : expect_second_order(table);
    }
  }
}
void check_system(const Scenario& scenario, Numbering numbering, const std::string& name) {
  System<3> system(name, *scenario.scene, std::move(numbering));
  check_system(scenario, system, name);
}

constexpr double stretched = 0.7, slack = 1.4;

/// Stretched and slack fibres of the wall.
std::pair<int, int> fibre_count(const Scenario& scenario) {
  int tight = 0, loose = 0;
  for (const auto& layer : static_cast<const WallProblem<Tet>&>(*scenario.scene->wall).layers())
    for (std::size_t p = 0; !layer.fibres.empty() && p < layer.fibres[0].size(); ++p) {
      const auto& pack = layer.packs.of_thread(0)[p];
      NodalVector<Tet> d{};
      gather<MixedLayout<3>>(d, pack, scenario.state.now.wall.data());
      const auto strain = strain_of(gradient_of(d, Tet::at(pack.geometry, 0)));
      for (const auto& point : layer.fibres[0][p])
        for (const auto& a : point.direction)
          for (int lane = 0; lane < pack_width; ++lane) ++(extension(strain, a)[lane] > 0 ? tight : loose);
    }
  return {tight, loose};
}

TEST(CoupledJacobian, IsTheDerivativeOfTheResidual) {
  for (const auto& [material, across] : {std::pair{"neo-hookean", 1.0}, std::pair{"mooney-rivlin", 1.0},
                                         std::pair{"artery", stretched}, std::pair{"artery", slack}}) {
    const Scenario scenario(material, across);
    const auto [tight, loose] = fibre_count(scenario);
    EXPECT_EQ(across == stretched ? loose : tight, 0);
    EXPECT_EQ(tight + loose > 0, std::string(material) == "artery");
    check_system(scenario, number_scene(*scenario.scene), std::string("coupled, ") + material);
  }
}

TEST(CoupledJacobian, WithGradDivStabilisation) {
  const Scenario scenario("neo-hookean", 1, true);
  check_system(scenario, number_scene(*scenario.scene), "coupled, grad-div");
}

TEST(CoupledJacobian, WithPressuresPerLayer) {
  const Scenario scenario("mooney-rivlin", 1, false, LayerPressure::separate);
  EXPECT_TRUE(scenario.scene->wall->nodes().has_copies());
  check_system(scenario, number_scene(*scenario.scene), "coupled, pressures per layer");
  check_system(scenario, number_wall(*scenario.scene), "wall alone, pressures per layer");
}

TEST(TurnedJacobian, OfAllSystemsWithNodesThatHaveFrames) {
  Scenario scenario("artery", stretched, false, LayerPressure::separate);
  scenario.turn_nodes();
  EXPECT_GT(scenario.scene->fluid_frames.nodes().size(), 15u);
  EXPECT_GT(scenario.scene->wall_frames.nodes().size(), 10u);
  check_system(scenario, number_scene(*scenario.scene), "turned nodes, coupled");
  check_system(scenario, number_fluid(*scenario.scene), "turned nodes, fluid");
  check_system(scenario, number_wall(*scenario.scene), "turned nodes, wall");
  InterfaceImpedance impedance;
  Random random(4);
  for (const auto& node : scenario.scene->interface) {
    impedance.nodes.push_back(node.fluid);
    impedance.impedance.push_back(1 + 0.5 * random());
    for (int k = 0; k < 3; ++k) impedance.velocity.push_back(random());
  }
  MediumSystem<3> system("fluid", *scenario.scene, number_fluid_and_domain(*scenario.scene), {}, SystemNorm::volumes,
                         &impedance);
  check_system(scenario, system, "turned nodes, fluid and domain");
}

constexpr MeshMotionOptions elastic{MeshMotionMethod::nonlinear_elastic, 1, 1, 0.3};

TEST(CoupledJacobian, WithNonlinearMeshMotion) {
  Scenario scenario("neo-hookean", 1, false, LayerPressure::continuous, elastic);
  check_system(scenario, number_scene(*scenario.scene), "coupled, nonlinear mesh motion");
  scenario.turn_nodes();
  check_system(scenario, number_scene(*scenario.scene), "turned nodes, coupled, nonlinear mesh motion");
  check_system(scenario, number_fluid_and_domain(*scenario.scene), "fluid and domain, nonlinear mesh motion");
}

TEST(CoupledJacobian, WithStiffenedMeshMotion) {
  const Scenario scenario("neo-hookean", 1, false, LayerPressure::continuous, {MeshMotionMethod::stiffened});
  check_system(scenario, number_scene(*scenario.scene), "coupled, stiffened mesh motion");
}

/// The product from blocks and that with the gathered matrix agree, and move() takes increments along the frames.
class TurnedProducts : public testing::TestWithParam<MeshMotionMethod> {};
INSTANTIATE_TEST_SUITE_P(MeshMotions, TurnedProducts,
                         testing::Values(MeshMotionMethod::harmonic, MeshMotionMethod::nonlinear_elastic));
TEST_P(TurnedProducts, AndSteps) {
  Scenario scenario("neo-hookean", 1, false, LayerPressure::continuous, {GetParam()});
  scenario.turn_nodes();
  auto& scene = *scenario.scene;
  System<3> system("coupled", scene, number_scene(scene));
  State state = scenario.state;
  system.work_on(state, scenario.data);
  system.evaluate();
  system.linearise();
  GatheredMatrix gathered = gather_jacobian(system.blocks());
  gathered.update();
  const auto x = direction_for(groups_of(system.numbering(), scenario), 5);
  std::vector<double> y;
  JacobianProduct<3>(system.blocks()).multiply(x, y);
  const auto expected = product(gathered.matrix(), x);
  EXPECT_LT(norm(difference(y, expected)), 1e-13 * norm(expected));

  const auto before = state.now;
  ASSERT_TRUE(std::isfinite(system.solve(1e-12)));
  system.move(0.5);
  auto moved = difference(state.now.fluid, before.fluid);
  EXPECT_GT(norm(moved), 0);
  scene.fluid_frames.to_frames<MixedLayout<3>>(moved);
  for (const int node : scene.fluid_frames.nodes())
    for (int k = 0; k < 3; ++k)
      if (scene.velocity_conditions.fixes(node, k)) {
        EXPECT_LT(std::abs(moved[4 * node + k]), 1e-13 * largest(moved));
      }
}

TEST(PartitionedJacobian, OfTheFluidWithTheInterfaceVelocityPrescribed) {
  const Scenario scenario("neo-hookean");
  check_system(scenario, number_fluid(*scenario.scene), "fluid alone");
}

TEST(PartitionedJacobian, OfTheWallFreeOnTheInterface) {
  const Scenario scenario("artery", stretched);
  check_system(scenario, number_wall(*scenario.scene), "wall alone");
}

TEST(WallSystemJacobian, WithFollowerPressureAndWithoutFluid) {
  Case setup = coupled_case("artery", 0.5);
  setup.fluid.reset();
  setup.inlet.reset();
  setup.load = PressureTable{{{0.0, 1.0}}};
  setup.structure->bulk_modulus = 50;
  setup.structure->axis_origin = {0.4, 0.5, -1.0};
  setup.structure->axis_direction = {0, 1, 0};
  Scenario scenario("artery", stretched);
  scenario.scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(3));
  scenario.data.wall_pressure = 40;  // of the size of the stresses of the random state
  check_system(scenario, number_scene(*scenario.scene), "wall under pressure");

  // The load must be seen: without it the residual differs.
  System<3> system("wall", *scenario.scene, number_scene(*scenario.scene));
  State state = scenario.state;
  system.work_on(state, scenario.data);
  system.evaluate();
  const auto loaded = system.residual();
  scenario.data.wall_pressure = 0;
  system.evaluate();
  EXPECT_GT(norm(difference(loaded, system.residual())), 0.01 * norm(loaded));
}

// --- controls: the check above fails when it should ------------------------------------------------------------------

/// The coupled matrix put together by hand from the blocks of the sub-problems, so that one can be spoiled.
template <class Spoil>
SparseMatrix spoiled_matrix(const Scenario& scenario, Spoil spoil) {
  auto numbering = number_scene(*scenario.scene);
  numbering.follow(scenario.data.rates.interface);
  System<3> system("coupled", *scenario.scene, numbering);
  State state = scenario.state;
  system.work_on(state, scenario.data);
  system.linearise();
  const auto blocks = system.blocks();
  FluidJacobian<3> fluid;
  fluid.fluid = *blocks.fluid;
  fluid.shape_derivatives = *blocks.shape_derivatives;
  spoil(numbering, fluid);
  GatheredMatrix::Builder builder(numbering.size);
  gather_blocks(builder, *blocks.wall, numbering.wall_rows, numbering.wall);
  gather_blocks(builder, fluid.fluid, numbering.fluid_rows, numbering.fluid);
  gather_blocks(builder, fluid.shape_derivatives, numbering.fluid_rows, numbering.mesh);
  gather_diagonal_blocks(builder, scenario.scene->mesh_motion, numbering.mesh_rows, numbering.mesh);
  GatheredMatrix gathered(std::move(builder));
  gathered.update();
  return gathered.matrix();
}

TEST(JacobianControl, MissingTermsAreDetected) {
  const Scenario scenario("neo-hookean");
  System<3> system("coupled", *scenario.scene, number_scene(*scenario.scene));
  const auto direction = direction_for(groups_of(system.numbering(), scenario), 1);
  const Line line(system, scenario, direction);
  const auto check = [&](const char* name, auto spoil) {
    return central_differences(name, line, product(spoiled_matrix(scenario, spoil), direction));
  };
  using Fluid = FluidJacobian<3>;
  expect_second_order(check("control, nothing spoiled", [](Numbering&, Fluid&) {}));
  expect_detected(
      check("control, shape derivatives dropped", [](Numbering&, Fluid& fluid) { fluid.shape_derivatives.set_zero(); }),
      1e-2);
  expect_detected(check("control, interface velocity without 1/dt",
                        [&](Numbering& numbering, Fluid&) {
                          for (const auto& node : scenario.scene->interface)
                            for (int k = 0; k < 3; ++k) numbering.fluid[4 * node.fluid + k].factor = 1;
                        }),
                  1e-3);
  expect_detected(check("control, one shape derivative of one node pair off by 1 %",
                        [](Numbering&, Fluid& fluid) {
                          auto& values = fluid.shape_derivatives.values;
                          *std::max_element(values.begin(), values.end()) *= 1.01;
                        }),
                  1e-6);
}

}  // namespace

}  // namespace fsi::test::system_jacobians_tests
