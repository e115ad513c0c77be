// A scene that processes have shared out is the whole scene: equations, derivatives, norms and openings, node by node.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "case/openings.hpp"
#include "fem/elements.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/artery_generator.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "scene/boundary_conditions.hpp"
#include "support/element_meshes.hpp"
#include "support/moving_opening_scenes.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "system/system.hpp"
#include "system/work_unit.hpp"

namespace fsi::test {

namespace {

const Communicator& world() {
  return Communicator::world();
}

/// Stands for a solver: x = b, and what System asks of any.
template <int n>
class Identity : public LinearSolver {
 public:
  explicit Identity(const JacobianBlocks<n>& blocks) : numbering_(blocks.numbering) {}
  void update() override { ready_ = true; }
  bool ready() const override { return ready_; }
  LinearReport solve(const std::vector<double>& b, double, std::vector<double>& x) override {
    x = b;
    x.resize(numbering_.columns(), std::nan(""));  // copies are the caller's
    return {};
  }

 private:
  const Numbering& numbering_;
  bool ready_ = false;
};

template <class Element>
MeshOf<Element> small_mesh() {
  if constexpr (Element::dim == 3) {
    if constexpr (Element::order == 1)
      return fluid_and_wall_box(3);
    else
      return with_mid_edge_nodes(fluid_and_wall_box(3));
  } else {
    ArteryOptions sizes = artery_level("coarse");
    sizes.length = 4;
    TriangleMesh section = generate_artery_section(sizes, artery_cells(sizes));
    if constexpr (!Element::axisymmetric)
      for (Point& x : section.nodes) x = {x[0], x[2], 0};
    if constexpr (Element::order == 1)
      return section;
    else
      return with_mid_edge_nodes(section);
  }
}

Case case_of(const std::string& material, LayerPressure layer_pressure) {
  Case setup = coupled_case(material, 0.1);
  setup.stabilisation = Stabilisation::projected;
  setup.structure->layer_pressure = layer_pressure;
  setup.structure->axis_origin = {0.4, 0.5, -1.0};
  setup.structure->axis_direction = {0, 1, 0};
  return setup;
}

/// One scene twice: whole, as every process has it here, and shared out.
template <class Element>
class Both {
 public:
  static constexpr int n = Element::components;
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  explicit Both(const Case& setup, const MeshOf<Element>& mesh = small_mesh<Element>())
      : share_(share_mesh(mesh, world())), whole(build_scene<Element>(setup, mesh)) {
    if (world().is_alone())
      here = build_scene<Element>(setup, mesh);
    else
      here = build_scene<Element>(setup, mesh, &share_, &parts_);
    whole_state = whole->at_rest();
    const auto& x = whole->fluid->nodes().nodes;
    const auto& y = whole->wall->nodes().nodes;
    const auto random_solution = [&](unsigned seed) {
      Solution s{random_field(x, n, 0.01, 0.002, seed), random_field(x, n + 1, 3.0, 0.5, seed + 1),
                 random_field(y, n + 1, 0.01, 0.002, seed + 2),
                 std::vector<double>(whole_state.now.openings.size(), 0.3)};
      for (int a = 0; a < whole->wall->node_count(); ++a)
        std::copy_n(s.wall.begin() + static_cast<std::ptrdiff_t>(Mixed::vector(whole->wall->nodes().original_of(a))), n,
                    s.wall.begin() + static_cast<std::ptrdiff_t>(Mixed::vector(a)));
      return s;
    };
    whole_state.now = random_solution(1);
    whole_state.before[0] = random_solution(4);
    whole_state.wall_velocity = random_field(y, n, 0.5, 0.1, 7);
    whole_state.wall_acceleration = random_field(y, n, 0.5, 0.1, 8);
    state = here->at_rest();
    state.now = share_of(whole_state.now);
    state.before[0] = share_of(whole_state.before[0]);
    state.wall_velocity = wall_field(whole_state.wall_velocity, n);
    state.wall_acceleration = wall_field(whole_state.wall_acceleration, n);
    whole_data = step_of(*whole, whole_state);
    data = step_of(*here, state);
  }

  std::vector<double> fluid_field(const std::vector<double>& field, int entries) const {
    return parts_.fluid_here ? parts_.fluid_here->field(field, entries) : field;
  }
  std::vector<double> wall_field(const std::vector<double>& field, int entries) const {
    return parts_.wall_here ? parts_.wall_here->field(field, entries) : field;
  }
  Solution share_of(const Solution& s) const {
    return {fluid_field(s.mesh, n), fluid_field(s.fluid, n + 1), wall_field(s.wall, n + 1), s.openings};
  }

  /// Calls visit(map here, its places in the whole map) for the fields of two numberings.
  template <class Visit>
  void for_each_map(const Numbering& mine, const Numbering& all, Visit visit) const {
    const auto places = [&](const NodeShare* share, std::size_t nodes, int entries) {
      std::vector<std::size_t> list;
      for (std::size_t a = 0; a < nodes; ++a)
        for (int k = 0; k < entries; ++k)
          list.push_back(static_cast<std::size_t>(share ? share->whole_node[a] : static_cast<int>(a)) * entries + k);
      return list;
    };
    const auto *fluid = here->fluid->nodes().share.get(), *wall = here->wall->nodes().share.get();
    visit(mine.mesh_rows, mine.mesh, all.mesh_rows, all.mesh, places(fluid, mine.mesh.size() / n, n));
    visit(mine.fluid_rows, mine.fluid, all.fluid_rows, all.fluid,
          places(fluid, mine.fluid.size() / Mixed::entries, Mixed::entries));
    visit(mine.wall_rows, mine.wall, all.wall_rows, all.wall,
          places(wall, mine.wall.size() / Mixed::entries, Mixed::entries));
  }

 private:
  static StepData step_of(Scene<n>& scene, State& at) {
    StepData data;
    data.rates = scene.integrator->rates(at, 0.1);
    scene.impose_conditions(at.now);
    scene.impose_interface(at, data.rates);
    data.opening_pressures = {1.332, 0.2};
    data.opening_flows = {0.7, -0.4};
    return data;
  }

  MeshShare share_;
  WholeParts<Element> parts_;

 public:
  std::unique_ptr<Scene<n>> whole, here;
  State whole_state, state;
  StepData whole_data, data;
};

template <class Element>
void compare(const Case& setup, const MeshOf<Element>& mesh = small_mesh<Element>()) {
  constexpr int n = Element::components;
  Both<Element> both(setup, mesh);
  const auto identity = [](const JacobianBlocks<n>& blocks) { return std::make_unique<Identity<n>>(blocks); };
  System<n> all("coupled", *both.whole, number_scene(*both.whole), identity),
      mine("coupled", *both.here, number_scene(*both.here), identity);
  ASSERT_EQ(mine.numbering().whole_size(), all.numbering().size);
  all.work_on(both.whole_state, both.whole_data);
  mine.work_on(both.state, both.data);

  const double norm = all.evaluate();
  EXPECT_NEAR(mine.evaluate(), norm, 1e-12 * norm);
  EXPECT_NEAR(mine.size(), all.size(), 1e-12 * all.size());
  all.linearise();
  mine.linearise();
  ASSERT_EQ(mine.flow_gaps().size(), all.flow_gaps().size());
  for (std::size_t i = 0; i < all.flow_gaps().size(); ++i)
    EXPECT_NEAR(mine.flow_gaps()[i], all.flow_gaps()[i], 1e-12 * (1 + std::abs(all.flow_gaps()[i])));
  EXPECT_NEAR(mine.rounding(), all.rounding(), 1e-9 * all.rounding());

  // Equations, and products with the Jacobian, row by row.
  std::vector<double> x(mine.numbering().columns()), whole_x(all.numbering().columns()), y, whole_y;
  for (std::size_t i = 0; i < whole_x.size(); ++i) whole_x[i] = std::sin(1.0 + 0.37 * static_cast<double>(i));
  std::size_t rows = 0;
  both.for_each_map(mine.numbering(), all.numbering(),
                    [&](const UnknownMap& my_rows, const UnknownMap& map, const UnknownMap& whole_rows,
                        const UnknownMap& whole_map, const std::vector<std::size_t>& places) {
                      for (std::size_t i = 0; i < map.size(); ++i) {
                        ASSERT_EQ(map[i].index < 0, whole_map[places[i]].index < 0);
                        if (map[i].index >= 0) x[map[i].index] = whole_x[whole_map[places[i]].index];
                        if (my_rows[i].index < 0) continue;
                        ++rows;
                        EXPECT_NEAR(mine.residual()[my_rows[i].index], all.residual()[whole_rows[places[i]].index],
                                    1e-12 * norm);
                      }
                    });
  EXPECT_GE(world().sum(static_cast<std::int64_t>(rows)), all.numbering().size);
  JacobianProduct<n>(mine.blocks()).multiply(x, y);
  JacobianProduct<n>(all.blocks()).multiply(whole_x, whole_y);
  double largest = 0;
  for (const double value : whole_y) largest = std::max(largest, std::abs(value));
  both.for_each_map(mine.numbering(), all.numbering(),
                    [&](const UnknownMap& my_rows, const UnknownMap&, const UnknownMap& whole_rows, const UnknownMap&,
                        const std::vector<std::size_t>& places) {
                      for (std::size_t i = 0; i < my_rows.size(); ++i)
                        if (my_rows[i].index >= 0) {
                          EXPECT_NEAR(y[my_rows[i].index], whole_y[whole_rows[places[i]].index], 1e-12 * largest);
                        }
                    });

  // An increment reaches copies as well.
  const double increment = all.solve(0);
  EXPECT_NEAR(mine.solve(0), increment, 1e-12 * increment);
  EXPECT_NEAR(mine.relative_increment(), all.relative_increment(), 1e-9 * all.relative_increment());
  EXPECT_EQ(mine.negligible(0, 1e-3), all.negligible(0, 1e-3));
  all.move(1e-3);
  mine.move(1e-3);
  const Solution moved = both.share_of(both.whole_state.now);
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-11 * (1 + std::abs(b[i])));
  };
  same(both.state.now.mesh, moved.mesh);
  same(both.state.now.fluid, moved.fluid);
  same(both.state.now.wall, moved.wall);
  same(both.state.now.openings, moved.openings);

  // What belongs to the whole scene.
  EXPECT_NEAR(both.here->fluid->volume(), both.whole->fluid->volume(), 1e-12 * both.whole->fluid->volume());
  EXPECT_NEAR(both.here->interface_area(), both.whole->interface_area(), 1e-12 * both.whole->interface_area());
  const auto in = both.here->fluid_input(both.state, both.data.rates),
             whole_in = both.whole->fluid_input(both.whole_state, both.whole_data.rates);
  for (std::size_t i = 0; i < both.whole->fluid->open_boundaries().size(); ++i) {
    const auto &a = both.here->fluid->open_boundaries()[i], &b = both.whole->fluid->open_boundaries()[i];
    EXPECT_EQ(a.empty(), b.empty());
    EXPECT_EQ(a.moving() == nullptr, setup.supports.empty());
    EXPECT_EQ(b.moving() == nullptr, setup.supports.empty());
    const Solution &now = both.state.now, &whole_now = both.whole_state.now;
    const double outflow = b.outflow(whole_now.mesh, whole_now.fluid);
    EXPECT_NEAR(a.outflow(now.mesh, now.fluid), outflow, 1e-12 + 1e-10 * std::abs(outflow));
    EXPECT_NEAR(a.mean_pressure(now.mesh, now.fluid), b.mean_pressure(whole_now.mesh, whole_now.fluid), 1e-10);
    const double energy = both.whole->fluid->kinetic_outflow(b, whole_in, whole_now.fluid);
    EXPECT_NEAR(both.here->fluid->kinetic_outflow(a, in, now.fluid), energy, 1e-10 * (1 + std::abs(energy)));
  }
  const auto backflow = [](const Scene<n>& scene, const FluidInput& balance) {
    FluidStep step{balance, 0.1};
    step.mesh_start = step.mesh_end = balance.mesh;
    step.fluid_start = step.fluid_end = balance.fluid;
    return world().sum(scene.fluid->work(step).backflow);
  };
  const double taken = backflow(*both.whole, whole_in) / world().size();  // each process has all of it
  EXPECT_EQ(taken > 0, both.whole->fluid->stabilises_backflow());
  EXPECT_NEAR(backflow(*both.here, in), taken, 1e-10 * taken);
}

template <class Element>
class SharedScene : public ::testing::Test {};
using Elements = ::testing::Types<P1Tetrahedron, P2P1Tetrahedron, P1AxisymmetricTriangle, P2P1AxisymmetricTriangle,
                                  P1PlaneTriangle, P2P1PlaneTriangle>;

}  // namespace

TYPED_TEST_SUITE(SharedScene, Elements);

TYPED_TEST(SharedScene, IsTheWholeScene) {
  compare<TypeParam>(case_of("neo-hookean", LayerPressure::separate));
}

TYPED_TEST(SharedScene, WithFibresAndContinuousPressure) {
  compare<TypeParam>(case_of("artery", LayerPressure::continuous));
}

/// Each number of the whole matrix is one process's, and all decide alike how many products there are.
TYPED_TEST(SharedScene, HasTheWholeMatrixOfTheWorkUnit) {
  Both<TypeParam> both(case_of("neo-hookean", LayerPressure::separate));
  EXPECT_EQ(CoupledProduct<TypeParam::components>(*both.here).entries(),
            CoupledProduct<TypeParam::components>(*both.whole).entries());
  const System<TypeParam::components> system("coupled", *both.here, number_scene(*both.here));
  const MatrixValues values{system.fluid_values(), system.wall_values()};
  WorkUnitMeter<TypeParam::components> meter(*both.here);
  for (int step = 0; step < 9; ++step) meter.measure(step == 0 ? 1.0 + world().rank() : 1e9, values);
  EXPECT_EQ(meter.unit().products, WorkUnitMeter<TypeParam::components>::enough);
  EXPECT_EQ(meter.unit().seconds, world().largest(meter.unit().seconds));
}

/// Openings that follow wall ends which slide in an oblique plane beside planes of symmetry, or are free: forces, flows
/// and their derivatives are those of the current face, and nodes in it have axes of their own. At the free ones a flow
/// is given beside a Windkessel.
TYPED_TEST(SharedScene, WithOpeningsThatMove) {
  for (const auto ends : {Ends::slide, Ends::free}) {
    Case setup = case_with(ends, "normal", 0.1);
    if (ends == Ends::free) {
      setup.openings["inlet"] = {};
      setup.openings["inlet"].flow_rate = FlowRateData{PressureTable{{{0.0, 0.7}}}};
    }
    setup.stabilisation = Stabilisation::projected;
    if constexpr (TypeParam::dim == 3) {
      compare<TypeParam>(setup, box<TypeParam>(3, turned, true));
    } else {
      auto mesh = small_mesh<TypeParam>();
      for (auto& group : mesh.facet_groups)
        if (group.name == group::wall_ends) group.name = "ends";
      compare<TypeParam>(setup, mesh);
    }
  }
}

}  // namespace fsi::test
