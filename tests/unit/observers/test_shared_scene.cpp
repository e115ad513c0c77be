// What is read off a solution on several processes, against the same of the whole scene: each process builds both.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "derived/derived_quantities.hpp"
#include "diagnostics/energy_balance.hpp"
#include "diagnostics/failure_hint.hpp"
#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "observers/observables.hpp"
#include "observers/observation_points.hpp"
#include "observers/requested_samples.hpp"
#include "observers/sample_tables.hpp"
#include "observers/shared_samples.hpp"
#include "sampling/point_sampling.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "support/vessels.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

template <class Element>
MeshOf<Element> box(int n) {
  if constexpr (Element::order == 1)
    return fluid_and_wall_box(n);
  else
    return with_mid_edge_nodes(fluid_and_wall_box(n));
}

/// A case in which nothing is zero: backflow, fibres, supports, and copies of nodes between the layers.
Case lively_case() {
  Case setup = coupled_case("artery", 0.5);
  setup.fluid = FluidData{1.3, 0.5, true, true};
  setup.structure->bulk_modulus = 50;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.structure->axis_origin = {0.4, 0.5, -1.0};
  setup.structure->axis_direction = {0, 1, 0};
  setup.time->scheme = "midpoint";
  SupportData bedding;
  bedding.spring = 3;
  bedding.normal_damper = 2;
  bedding.pressure = PressureTable{{{0.0, 0.7}}};
  setup.supports["outer"] = bedding;
  return setup;
}

/// The scene of a box as a whole, and this process's share of it.
template <class Element>
class Twins {
 public:
  static constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  explicit Twins(Case made_of, int boxes = 4 - Element::order)
      : setup(std::move(made_of)),
        mesh(box<Element>(boxes)),
        whole(build_scene<Element>(setup, mesh)),
        share(share_mesh(mesh, Communicator::world())),
        here(build_scene<Element>(setup, mesh, &share, &parts)) {
    vessel.fluid = &static_cast<FluidProblem<Element>&>(*whole->fluid).part();
    vessel.wall = &static_cast<WallProblem<Element>&>(*whole->wall).part();
  }

  /// A level of no particular kind that moves the box.
  Solution level(unsigned seed, double scale = 1) const {
    const auto &x = whole->fluid->nodes().nodes, &y = whole->wall->nodes().nodes;
    Solution fields{random_field(x, 3, 0.06 * scale, 0.01 * scale, seed),
                    random_field(x, 4, 3 * scale, 0.5 * scale, seed + 1),
                    random_field(y, 4, 0.06 * scale, 0.005 * scale, seed + 2)};
    return fields;
  }
  Solution restricted_level(const Solution& level) const {
    return {parts.fluid_here->field(level.mesh, Vector::entries), parts.fluid_here->field(level.fluid, Mixed::entries),
            parts.wall_here->field(level.wall, Mixed::entries), level.openings};
  }
  std::vector<double> wall_vectors(unsigned seed) const {
    return random_field(whole->wall->nodes().nodes, 3, 0.5, 0.1, seed);
  }

  Case setup;
  MeshOf<Element> mesh;
  std::unique_ptr<Scene<n>> whole;
  MeshShare share;
  WholeParts<Element> parts;
  std::unique_ptr<Scene<n>> here;
  VesselParts<Element> vessel;
};

void expect_near(const std::vector<double>& found, const std::vector<double>& known, double tolerance,
                 const std::string& what) {
  ASSERT_EQ(found.size(), known.size()) << what;
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    largest = std::max(largest, std::abs(known[i]));
    apart = std::max(apart, std::abs(found[i] - known[i]));
  }
  EXPECT_GT(largest, 0) << what;
  EXPECT_LE(apart, tolerance * largest) << what;
}

template <class Element>
class SharedScene : public testing::Test {};
using Tetrahedra = testing::Types<P1Tetrahedron, P2P1Tetrahedron>;
TYPED_TEST_SUITE(SharedScene, Tetrahedra);

std::vector<double> numbers_of(const EnergyRecord& record) {
  std::vector<double> numbers(sizeof record / sizeof(double));
  std::memcpy(numbers.data(), &record, sizeof record);
  return numbers;
}

/// Energies of steps that solve nothing, through levels and balances that `fit` makes fit a scene.
template <class Element, class Fit, class FitVectors>
std::vector<EnergyRecord> energies(const Twins<Element>& twins, Scene<3>& scene, Fit fit, FitVectors fit_vectors) {
  scene.fluid->stabilise_backflow(0, 0.7);
  State state = scene.at_rest();
  state.now = fit(twins.level(1));
  scene.impose_conditions(state.now);
  state.before = {state.now, state.now, state.now};
  scene.integrator->prepare(state);
  state.wall_velocity = state.wall_velocity_before = fit_vectors(twins.wall_vectors(7));
  EnergyBalance<3> energy(scene, state);
  std::vector<EnergyRecord> records;
  for (const double step : {0.5, 0.3}) {
    StepData data;
    data.time = state.time + step;
    data.rates = scene.integrator->rates(state, step, 0);
    data.opening_pressures = {1.3, -0.4};
    data.support_loads = {0.8};
    state.now = fit(twins.level(static_cast<unsigned>(10 + 100 * step)));
    scene.impose_interface(state, data.rates);
    StepReport report;
    report.balances.push_back({state.now, data});
    scene.integrator->accept(state, data);
    report.level = level_energy(scene, state);
    records.push_back(energy.step_to(state, report));
  }
  return records;
}

TYPED_TEST(SharedScene, EnergiesAreSumsOfTheProcessesParts) {
  const Twins<TypeParam> twins(lively_case());
  const auto known = energies(
      twins, *twins.whole, [](Solution level) { return level; }, [](std::vector<double> field) { return field; });
  const auto found = energies(
      twins, *twins.here, [&](const Solution& level) { return twins.restricted_level(level); },
      [&](const std::vector<double>& field) { return twins.parts.wall_here->field(field, 3); });
  for (std::size_t i = 0; i < known.size(); ++i) {
    for (const double part : {known[i].backflow, known[i].springs, known[i].damping, known[i].support_work})
      EXPECT_GT(std::abs(part), 1e-6);
    const auto numbers = numbers_of(found[i]), exact = numbers_of(known[i]);
    for (std::size_t k = 0; k < exact.size(); ++k)
      EXPECT_NEAR(numbers[k], exact[k], 1e-11 * (1 + std::abs(exact[k]))) << "number " << k;
  }
}

// All kinds of samples, where the mesh stands.
TYPED_TEST(SharedScene, SamplesAreThoseOfTheWhole) {
  Case setup = lively_case();
  auto& samples = setup.output.samples;
  samples.points = {{"in the fluid", {0.31, 0.45, 0.52}}, {"in the wall", {0.6, 0.7, 1.3}}};
  samples.lines["up"] = {{0.2, 0.3, 0.01}, {0.8, 0.6, 1.38}, 23, {}};
  samples.planes["across"] = {{0.47, 0.5, 0.5}, {1, 0, 0}};
  samples.planes["oblique"] = {{0.52, 0.5, 0.5}, {1, 0.4, -0.3}};
  samples.planes["at the inlet"] = {{0, 0.5, 0.5}, {1, 0, 0}};
  const Twins<TypeParam> twins(setup);
  ObservationPoints points;
  points.requested = requested_samples<TypeParam>(setup, twins.mesh, twins.vessel, points);
  EXPECT_TRUE(points.warnings.empty());
  for (const double x : {0.1, 0.5, 0.9}) {  // the pressure there stands for that on a centre line
    const auto at = locate_in_cells(*twins.vessel.fluid, {{x, 0.5, 0.4}})[0];
    points.centre_line.push_back({{at->nodes.begin(), at->nodes.begin() + 4}, at->scalar_weights});
  }
  ObservationPoints mine = points;
  restrict_samples(twins.parts.fluid_here.get(), twins.parts.wall_here.get(), mine);
  cut_through(twins.here->fluid->nodes(), mine);
  const SampleTables<3> known_tables(points.requested, *twins.whole), tables(mine.requested, *twins.here);
  State state, state_here;
  state.now = twins.level(3);
  state_here.now = twins.restricted_level(state.now);
  PartialSums none, sums;
  const auto known = known_tables.rows(state, none);
  const auto found = tables.rows(state_here, sums);
  sums.add_up(Communicator::world());
  ASSERT_EQ(known.size(), 3u);
  for (std::size_t table = 0; table < known.size(); ++table) {
    ASSERT_EQ(found[table].size(), known[table].size());
    for (std::size_t row = 0; row < known[table].size(); ++row)
      for (std::size_t k = 0; k < known[table][row].size(); ++k) {
        ASSERT_EQ(found[table][row][k].has_value(), known[table][row][k].has_value());
        if (!known[table][row][k]) continue;
        EXPECT_NEAR(*found[table][row][k], *known[table][row][k], 1e-11 * (1 + std::abs(*known[table][row][k])));
      }
  }
  expect_near(centre_line_pressure<3>(mine, state_here.now.fluid, Communicator::world()),
              centre_line_pressure<3>(points, state.now.fluid, Communicator::alone()), 1e-13, "centre line");
}

TYPED_TEST(SharedScene, DerivedQuantitiesAreThoseOfTheWhole) {
  Case setup = lively_case();
  setup.output.every = 1;
  setup.output.fields = {"wall_shear_stress", "cauchy_stress", "fibre_stress"};
  setup.output.derived.surfaces = {"walls", "interface", "inlet"};
  setup.output.derived.forces["ends"] = {"inlet", "outlet"};
  const Twins<TypeParam> twins(setup);
  const auto known = make_derived_quantities<TypeParam>(setup, twins.mesh, *twins.whole);
  const auto found = make_derived_quantities<TypeParam>(setup, twins.mesh, *twins.here, twins.parts);
  const Solution level = twins.level(5, 0.5), level_here = twins.restricted_level(level);

  const auto shear = known.shear->at_nodes(level), shear_here = found.shear->at_nodes(level_here);
  std::map<int, std::size_t> place;  // by node
  for (std::size_t i = 0; i < known.shear->nodes().size(); ++i) place[known.shear->nodes()[i]] = i;
  std::int64_t own = 0;
  for (std::size_t i = 0; i < found.shear->nodes().size(); ++i) {
    const int node = found.shear->nodes()[i];
    EXPECT_TRUE(twins.here->fluid->nodes().owns(node));
    ++own;
    const std::size_t same = place.at(twins.parts.fluid_here->whole_nodes()[node]);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(shear_here[3 * i + k], shear[3 * same + k], 1e-10);
  }
  EXPECT_EQ(Communicator::world().sum(own), static_cast<std::int64_t>(known.shear->nodes().size()));

  const auto stress = known.stress->of(level.wall), stress_here = found.stress->of(level_here.wall);
  EXPECT_TRUE(found.stress->has_fibres());
  const auto& nodes = twins.parts.wall_here->whole_nodes();
  ASSERT_GE(stress_here.cauchy.size(), nodes.size());  // behind them mid-edge nodes of further layers
  for (std::size_t a = 0; a < nodes.size(); ++a) {     // copies, too
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(stress_here.cauchy[a](i / 3, i % 3), stress.cauchy[nodes[a]](i / 3, i % 3), 1e-9);
    for (std::size_t family = 0; family < 2; ++family)
      EXPECT_NEAR(stress_here.of_fibres[family][a], stress.of_fibres[family][nodes[a]], 1e-9);
  }

  const auto balance_of = [&](const Scene<3>& scene, const Solution& at) {
    State state = scene.at_rest();
    state.now = at;
    Balance balance{at, {}};
    balance.data.rates = scene.integrator->rates(state, 0.5, 0);
    balance.data.opening_pressures = {0.6, -0.2};
    return balance;
  };
  const auto forces = known.forces->at(balance_of(*twins.whole, level));
  const auto forces_here = found.forces->at(balance_of(*twins.here, level_here));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_NEAR(forces_here[i].area, forces[i].area, 1e-12);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(forces_here[i].force[k], forces[i].force[k], 1e-10) << known.forces->names()[i];
      EXPECT_NEAR(forces_here[i].pressure[k], forces[i].pressure[k], 1e-11) << known.forces->names()[i];
    }
  }
}

TYPED_TEST(SharedScene, HintsAreTheSameAtAllProcesses) {
  Case setup = lively_case();
  setup.supports.clear();
  const Twins<TypeParam> twins(setup);
  const Loads loads(setup);
  const auto hint = [&](const Scene<3>& scene, auto fit) {
    State state = scene.at_rest();
    for (int k = 0; k < 3; ++k) state.before[k] = fit(twins.level(20, 12.0 - 3 * k));
    state.step = 3;
    return failure_hint(setup, scene, loads, state);
  };
  const auto known = hint(*twins.whole, [](Solution level) { return level; });
  EXPECT_FALSE(known.empty());
  EXPECT_EQ(hint(*twins.here, [&](const Solution& level) { return twins.restricted_level(level); }), known);
}

// Both legs of a U are cut, each perhaps by several processes: the one near the origin counts, and all of it.
TEST(SharedPlane, IsThePieceNearestToItsOriginOfAllProcesses) {
  constexpr double bend = 5, pi = 3.14159265358979323846;
  auto vessel = straight_vessel<1>(bend * pi, 2, 24);
  bend_about(bend, vessel.part);
  TetrahedralMesh mesh;
  mesh.nodes = vessel.part.nodes;
  mesh.cells = vessel.part.cells;
  mesh.regions = {"fluid"};
  mesh.cell_region.assign(mesh.cells.size(), 0);
  const auto whole = submesh(mesh, {0});
  const MeshShare share = share_mesh(mesh, Communicator::world());
  const PartRestriction restriction(whole, share);
  std::vector<int> cells;
  const auto here = restriction.part(whole, cells);
  const auto flow = random_field(whole.nodes, 4, 1, 0.1, 3);
  std::vector<std::shared_ptr<const PlaneCut>> planes, planes_here;
  for (const Point& origin : {Point{0, 0, 0.5}, Point{2 * bend, 0, 0.5}, Point{bend, 0, bend}})
    for (const Point& normal : {Point{0, 0, 1}, Point{1, 0, 0.2}}) {
      planes.push_back(plane_cut(whole, origin, normal, false));
      ASSERT_TRUE(planes.back());
      planes_here.push_back(planes.back()->through(here));
    }
  std::vector<const PlaneCut*> all;
  for (const auto& plane : planes_here) all.push_back(plane.get());
  const auto rows = look_at(all, {}, restriction.field(flow, 4), Communicator::world());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneRow known = planes[i]->look({}, flow);
    EXPECT_NEAR(rows[i].flow, known.flow, 1e-12) << i;
    EXPECT_NEAR(rows[i].area, known.area, 1e-12) << i;
    EXPECT_NEAR(rows[i].pressure, known.pressure, 1e-12) << i;
  }
  EXPECT_GT(std::abs(rows[0].flow - rows[2].flow), 1e-3);  // another leg
}

}  // namespace

}  // namespace fsi::test
