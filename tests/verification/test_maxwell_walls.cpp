// Layers with Maxwell branches (docs/theory.md, section 5.11): exact derivatives, the relaxation of a block that is held and
// the creep of one that is pulled against their equations, with every time scheme, both limits of the relaxation time, and
// energy.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scene/build_scene.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/errors.hpp"
#include "support/every_element.hpp"
#include "support/problems.hpp"
#include "support/pulled_block.hpp"
#include "support/random.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test::maxwell_walls_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

const std::vector<MaxwellBranch> two{{4, 0.5}, {2.5, 3}};

template <class Element>
class MaxwellWallOf : public testing::Test {};
TYPED_TEST_SUITE(MaxwellWallOf, Elements, ElementNames);

TYPED_TEST(MaxwellWallOf, JacobianIsTheDerivativeOfTheResidual) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  auto mesh = irregular_mesh<Element>(2, "media");
  curve<Element>(mesh, 0.05);
  WallProblem<Element> wall(whole(mesh), {1.2, 50.0, 0.5}, {{0, Material{NeoHookean{3}}}}, {});
  const auto solution = random_field(mesh.nodes, n + 1, 0.1, 0.02, 1);
  const auto history = random_field(mesh.nodes, n, 1.0, 0.1, 3);
  std::vector<double> reference;
  const auto residual_at = [&](const std::vector<double>& at, WallMatrix<n>* jacobian = nullptr) {
    WallInput in{at.data(), history.data(), 16.0};
    in.velocity_rate = 4;
    if (!reference.empty()) in.branch_reference = reference.data();
    std::vector<double> r;
    EXPECT_FALSE(wall.assemble(in, 0, at, r, jacobian).inverted());
    return r;
  };
  const auto elastic = residual_at(solution);
  EXPECT_FALSE(wall.is_viscous());
  EXPECT_TRUE(wall.relaxed_branches(solution).empty());
  wall.set_branches({two});
  EXPECT_TRUE(wall.is_viscous());

  // At rest its branches bear nothing: A = E, and r = E leaves E - r = 0 to rounding.
  reference = wall.relaxed_branches(solution);
  EXPECT_LT(norm(difference(residual_at(solution), elastic)), 1e-13 * norm(elastic));

  reference = wall.relaxed_branches(random_field(mesh.nodes, n + 1, 0.1, 0.02, 2));
  WallMatrix<n> jacobian(wall.graph());
  const auto at_state = residual_at(solution, &jacobian);
  EXPECT_GT(norm(difference(at_state, elastic)), 0.1 * norm(elastic)) << "branches that can be seen";
  EXPECT_LT(norm(difference(at_state, residual_at(solution))), 1e-14 * norm(at_state)) << "two loops, one residual";
  const auto direction = random_field(mesh.nodes, n + 1, 0.3, 0.1, 4);
  expect_second_order(central_differences(
      "wall with branches", [&](double t) { return residual_at(moved(solution, t, direction)); },
      multiply(jacobian, direction), 0.05, 16));
}

// --- relaxation ------------------------------------------------------------------------------------------------------

constexpr double rate = 0.2, ramp = 1, hold = 2;  // 1/ms, ms, ms

/// A stretch 1 + rate t until `ramp`, then held.
double stretch_at(double t) {
  return 1 + rate * std::min(t, ramp);
}

/// Stress per area at rest of a block that is stretched so, held across, and of its branches alone: l sum 2 G_i (E - A_i) with
/// E = (l^2 - 1)/2. While l grows, dA/dt = (E - A)/tau is solved by A = c_0 (1 - e^(-t/tau)) + c_1 t + rate^2 t^2/2, c_1 = rate -
/// rate^2 tau, c_0 = -c_1 tau; from then on E - A falls as e^(-t/tau).
double exact_stress(double t) {
  double stress = 0;
  for (const auto& [shear, tau] : two) {
    const double s = std::min(t, ramp), c1 = rate - rate * rate * tau;
    const double strain = rate * s + 0.5 * rate * rate * s * s;
    const double kept = -c1 * tau * (1 - std::exp(-s / tau)) + c1 * s + 0.5 * rate * rate * s * s;
    stress += 2 * shear * (strain - kept) * std::exp(-(t - s) / tau);
  }
  return stretch_at(t) * stress;
}

struct Held {
  double largest = 0;  ///< error of the stress at levels
  double last = 0;     ///< stress at the end
};

/// The same computed: the scene's time scheme, and its wall's branches, under displacements that are given.
/// \param uneven  steps from 0.62 to 1.38 of their mean, one of which ends with the ramp
template <class Element>
Held held_block(const std::string& scheme, int steps, bool uneven = false) {
  constexpr int n = Element::components;
  using Mixed = MixedLayout<n>;
  const int axis = Element::axis[n - 1];
  auto mesh = irregular_mesh<Element>(1, "media");
  name_boundary(mesh, "wall_ends", [&](const Point& x) { return std::abs(x[axis]) < 1e-9; });
  Case setup;
  setup.structure = StructureData{};
  setup.structure->density = 1;
  setup.structure->layers["media"] = layer_of("saint-venant-kirchhoff", {{"young", 10}, {"poisson", 0.3}});
  setup.structure->layers["media"].maxwell = two;
  setup.time.emplace();
  setup.time->step = (ramp + hold) / steps;
  setup.time->end = ramp + hold;
  setup.time->scheme = scheme;
  if (scheme == "midpoint") setup.time->scheme_values["damping"] = 0.1;
  const auto scene = build_scene<Element>(setup, mesh);
  const auto& x = scene->wall->nodes().nodes;
  const auto stretch = [&](double by, std::vector<double>& wall) {
    for (std::size_t a = 0; a < x.size(); ++a) wall[Mixed::vector(static_cast<int>(a), n - 1)] = (by - 1) * x[a][axis];
  };
  // Forces on the end, per volume's length 1: what work they do on a stretch. \param k  large: A is its reference
  const auto stress_of = [&](const Solution& level) {
    WallInput in;
    in.wall = level.wall.data();
    std::vector<double> without, with, ones;
    scene->wall->assemble(in, 0, level.wall, without);
    in.velocity_rate = 1e12;
    in.branch_reference = level.branches.data();
    scene->wall->assemble(in, 0, level.wall, with);
    ones.assign(with.size(), 0.0);
    stretch(2, ones);
    double work = 0;
    for (std::size_t i = 0; i < with.size(); ++i) work += (with[i] - without[i]) * ones[i];
    return work / scene->wall->layer_data()[0].volume;
  };
  State state = scene->at_rest();
  Held held;
  for (int k = 1; k <= steps; ++k) {
    const double x_k = static_cast<double>(k) / steps;
    const double to = (ramp + hold) * (uneven ? x_k + 0.02 * std::sin(12 * std::acos(0.0) * x_k) : x_k);
    const double step = to - state.time;
    const int stages = scene->integrator->stages(state);
    for (int stage = 0; stage < stages; ++stage) {
      StepData data;
      data.time = to;
      data.rates = scene->integrator->rates(state, step, stage);
      stretch(stretch_at(data.rates.time), state.now.wall);
      scene->settle_branches(state.now, data.rates);
      scene->integrator->accept(state, data);
    }
    Solution level = state.before[0];
    stretch(stretch_at(to), level.wall);  // the scheme's own is of its order
    held.last = stress_of(level);
    held.largest = std::max(held.largest, std::abs(held.last - exact_stress(to)));
  }
  return held;
}

TYPED_TEST(MaxwellWallOf, BlockThatIsHeldRelaxes) {
  const Held held = held_block<TypeParam>("tr-bdf2", 24);
  EXPECT_NEAR(held.last, exact_stress(ramp + hold), 1e-3 * exact_stress(ramp));
  EXPECT_LT(exact_stress(ramp + hold), 0.5 * exact_stress(ramp)) << "a relaxation that can be seen";
}

TEST(Relaxation, IsOfTheOrderOfTheSchemeInTime) {
  using Element = P1AxisymmetricTriangle;
  for (const auto& [scheme, order] : {std::pair{"euler", 1}, std::pair{"midpoint", 2}, std::pair{"bdf2", 2},
                                      std::pair{"generalised-alpha", 2}, std::pair{"tr-bdf2", 2}}) {
    ConvergenceTable errors(scheme, {"stress"});
    for (const int steps : {48, 96, 192})
      errors.add((ramp + hold) / steps, {held_block<Element>(scheme, steps).largest});
    errors.print();
    EXPECT_NEAR(errors.last_order(0), order, 0.3) << scheme;
    EXPECT_LT(errors.last_error(0), (order == 1 ? 0.02 : 1e-3) * exact_stress(ramp)) << scheme;
  }
}

TEST(Relaxation, KeepsItsOrderWithUnevenSteps) {
  using Element = P1AxisymmetricTriangle;
  for (const std::string scheme : {"midpoint", "bdf2", "generalised-alpha", "tr-bdf2"}) {
    ConvergenceTable errors(scheme, {"stress"});
    for (const int steps : {48, 96, 192})
      errors.add((ramp + hold) / steps, {held_block<Element>(scheme, steps, true).largest});
    errors.print();
    EXPECT_NEAR(errors.last_order(0), 2, 0.4) << scheme;
  }
}

// --- creep -----------------------------------------------------------------------------------------------------------

constexpr double mu = 6, pull = 4, end = 3;  // kPa, kPa/ms, ms

/// A block under a traction `pull` t along one axis, free across, incompressible: with the stretch l, l_t across and Q along
/// and across of the branches,
///   pull t = mu (l - l_t^2/l) + l Q_a - (l_t^2/l) Q_t,   Q = sum 2 G_i (E - A_i),   l_t^2 = 1/l, in plane strain 1/l^2.
class PulledBody {
 public:
  PulledBody(const std::vector<MaxwellBranch>& branches, bool plane) : branches_(branches), plane_(plane) {}

  /// At the end: Runge and Kutta's rule of fourth order for the A_i, l by Newton's method at each of its points.
  double stretch_at_end() const {
    constexpr int steps = 600;
    const double h = end / steps;
    std::vector<double> a(2 * branches_.size(), 0.0);
    const auto along = [&](const std::vector<double>& by, double factor) {
      std::vector<double> at(a);
      for (std::size_t i = 0; i < a.size(); ++i) at[i] += factor * by[i];
      return at;
    };
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      const auto k1 = rates(a, t), k2 = rates(along(k1, h / 2), t + h / 2), k3 = rates(along(k2, h / 2), t + h / 2),
                 k4 = rates(along(k3, h), t + h);
      for (std::size_t j = 0; j < a.size(); ++j) a[j] += h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
    }
    return stretch(a, pull * end);
  }

  /// That bears a traction, with the strains that the branches keep. \param kept  along and across, of each
  double stretch(const std::vector<double>& kept, double traction) const {
    double l = 1;
    for (int i = 0; i < 50; ++i) {
      constexpr double small = 1e-7;
      const double lack = traction_at(l, kept) - traction;
      l -= lack * 2 * small / (traction_at(l + small, kept) - traction_at(l - small, kept));
    }
    return l;
  }

 private:
  std::array<double, 2> strains(double l) const {
    return {0.5 * (l * l - 1), 0.5 * ((plane_ ? 1 / (l * l) : 1 / l) - 1)};
  }
  double traction_at(double l, const std::vector<double>& kept) const {
    const double across = (plane_ ? 1 / (l * l) : 1 / l) / l;
    const auto e = strains(l);
    double traction = mu * (l - across);
    for (std::size_t i = 0; i < branches_.size(); ++i)
      traction += 2 * branches_[i].shear * (l * (e[0] - kept[2 * i]) - across * (e[1] - kept[2 * i + 1]));
    return traction;
  }
  std::vector<double> rates(const std::vector<double>& kept, double t) const {
    const auto e = strains(stretch(kept, pull * t));
    std::vector<double> rates;
    for (std::size_t i = 0; i < branches_.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) rates.push_back((e[k] - kept[2 * i + k]) / branches_[i].time);
    return rates;
  }

  std::vector<MaxwellBranch> branches_;
  bool plane_;
};

template <class Element>
PulledBlock computed_creep(const std::vector<MaxwellBranch>& branches, const std::string& scheme, int steps) {
  MaterialData layer = layer_of("neo-hookean", {{"c10", mu}});
  layer.maxwell = branches;
  return pulled_block<Element>(layer, scheme, steps, end, pull);
}

TYPED_TEST(MaxwellWallOf, BlockCreepsAsItsEquationSays) {
  using Element = TypeParam;
  const double exact = PulledBody(two, Element::dim == 2 && !Element::axisymmetric).stretch_at_end();
  ConvergenceTable errors("creep of a block with two branches, tr-bdf2", {"stretch"});
  for (const int steps : {6, 12}) {
    const PulledBlock block = computed_creep<Element>(two, "tr-bdf2", steps);
    errors.add(end / steps, {std::abs(block.stretch - exact)});
    EXPECT_LT(block.left_over, 1e-7 * block.work);
  }
  errors.print();
  EXPECT_GT(exact, 1.2);
  EXPECT_NEAR(errors.last_order(0), 2, 0.4);
  EXPECT_LT(errors.last_error(0), 1e-3);
}

TEST(MaxwellCreep, IsOfTheOrderOfTheSchemeInTime) {
  using Element = P1AxisymmetricTriangle;
  const double exact = PulledBody(two, false).stretch_at_end();
  for (const auto& [scheme, order] : {std::pair{"euler", 1}, std::pair{"midpoint", 2}, std::pair{"bdf2", 2}}) {
    ConvergenceTable errors(scheme, {"stretch"});
    for (const int steps : {20, 40, 80}) {
      const PulledBlock block = computed_creep<Element>(two, scheme, steps);
      errors.add(end / steps, {std::abs(block.stretch - exact)});
      EXPECT_LT(block.left_over, 1e-7 * block.work) << scheme;
    }
    errors.print();
    EXPECT_NEAR(errors.last_order(0), order, 0.3) << scheme;
  }
}

// A branch that relaxes at once is a dashpot, of Kelvin and Voigt's kind with eta = 2 G tau; one that never does is a spring.
TEST(MaxwellCreep, HasBothLimits) {
  using Element = P1AxisymmetricTriangle;
  constexpr double eta = 9;
  MaterialData voigt = layer_of("neo-hookean", {{"c10", mu}});
  voigt.viscosity = eta;
  const double dashpot = pulled_block<Element>(voigt, "tr-bdf2", 40, end, pull).stretch;
  std::vector<double> differences;
  for (const double tau : {0.02, 0.01})
    differences.push_back(std::abs(computed_creep<Element>({{eta / (2 * tau), tau}}, "tr-bdf2", 40).stretch - dashpot));
  EXPECT_LT(differences[1], 2e-3 * (dashpot - 1));
  EXPECT_NEAR(differences[0] / differences[1], 2, 0.2);

  const PulledBody spring({{4, 1e9}}, false);
  EXPECT_NEAR(computed_creep<Element>({{4, 1e9}}, "bdf2", 10).stretch, spring.stretch({0, 0}, pull * end), 1e-6);
}

// What the traction does goes into the elastic energy, the springs and the dashpots, but for what the scheme takes.
TEST(MaxwellCreep, DissipatesWhatItDoesNotStore) {
  using Element = P1AxisymmetricTriangle;
  const PulledBlock coarse = computed_creep<Element>(two, "bdf2", 40), fine = computed_creep<Element>(two, "bdf2", 80);
  fmt::print("work {:.4f} uJ, stored {:.4f}, dissipated {:.4f}\n", fine.work, fine.stored, fine.dissipated);
  const auto taken = [](const PulledBlock& block) { return block.work - block.stored - block.dissipated; };
  EXPECT_LT(std::abs(taken(fine)), 0.02 * fine.work);
  EXPECT_NEAR(std::log2(taken(coarse) / taken(fine)), 1, 0.2);
  EXPECT_GT(fine.dissipated, 0.1 * fine.work);
}

// --- prestress -------------------------------------------------------------------------------------------------------

TYPED_TEST(MaxwellWallOf, BeginsAtRestUnderPrestress) {
  using Element = TypeParam;
  constexpr int n = Element::components;
  const auto mesh = irregular_mesh<Element>(2, "media");
  WallProblem<Element> wall(whole(mesh), {1.2, 50.0, 0.5}, {{0, Material{NeoHookean{3}}}}, {});
  wall.set_prestress(random_field(mesh.nodes, n, 0.05, 0.02, 7));
  wall.set_branches({two});
  std::vector<double> still(wall.space().mixed_size(), 0.0), history(wall.space().vector_size(), 0.0);
  const auto kept = wall.relaxed_branches(still);
  EXPECT_GT(norm(kept), 0.1);
  WallInput in{still.data(), history.data(), 16.0};
  std::vector<double> elastic, with;
  wall.assemble(in, 0, still, elastic);
  in.velocity_rate = 4;
  in.branch_reference = kept.data();
  wall.assemble(in, 0, still, with);
  EXPECT_LT(norm(difference(with, elastic)), 1e-13 * norm(elastic));
  EXPECT_EQ(wall.energy(still, {}, still, kept).branches, 0);
}

}  // namespace

}  // namespace fsi::test::maxwell_walls_tests
