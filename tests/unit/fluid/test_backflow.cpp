// The stabilisation of backflow: its term, its power and its derivative, for every element.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fem/elements.hpp"
#include "fluid/fluid_problem.hpp"
#include "mesh/boundary.hpp"
#include "support/differences.hpp"
#include "support/element_meshes.hpp"
#include "support/nodal_arrays.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

constexpr double density = 1.3, beta = 0.7;

/// An irregular piece of fluid whose first side is open.
template <class Element>
class OpenPiece {
 public:
  static constexpr int n = Element::components;

  explicit OpenPiece(bool curved = false)
      : mesh_(make(curved)),
        fluid_(part(), {density, 0.1, false, 0.5}, {open_boundary<Element>("a", mesh_.nodes, open_)}) {}

  FluidProblem<Element>& fluid() { return fluid_; }
  const std::vector<Point>& nodes() const { return mesh_.nodes; }

  /// A flow array: what `u` gives for the components at a node, and any pressure.
  template <class Velocity>
  std::vector<double> flow(Velocity u) const {
    std::vector<double> array = random_field(mesh_.nodes, n + 1, 1, 0.3, 3);
    for (std::size_t a = 0; a < mesh_.nodes.size(); ++a)
      for (int k = 0; k < n; ++k) array[MixedLayout<n>::vector(static_cast<int>(a), k)] = u(mesh_.nodes[a], k);
    return array;
  }
  /// The opening faces the negative side of the first axis: a positive first component enters.
  std::vector<double> entering() const {
    return flow(
        [](const Point& x, int k) { return k == 0 ? 2 + 0.3 * x[0] : 0.5 * std::sin(3 * x[0] + 2 * x[1] + x[2]); });
  }
  /// Enters here and leaves there.
  std::vector<double> mixed() const {
    return flow([](const Point& x, int k) { return std::sin(1.3 + 5 * x[0] + 4 * x[1] - 6 * x[2] + 2 * k); });
  }

  std::vector<double> residual(const std::vector<double>& flow, double coefficient,
                               FluidJacobian<n>* jacobian = nullptr) {
    fluid_.stabilise_backflow(0, coefficient);
    FluidInput in;
    in.fluid = in.fluid_reference = flow.data();
    in.step = 0.5;
    std::vector<double> r;
    fluid_.assemble(in, {}, r, jacobian);
    return r;
  }
  /// What the stabilisation adds.
  std::vector<double> term(const std::vector<double>& flow) {
    return difference(residual(flow, beta), residual(flow, 0));
  }
  double power(const std::vector<double>& flow) {
    fluid_.stabilise_backflow(0, beta);
    FluidStep step;
    step.balance.fluid = step.balance.fluid_reference = step.fluid_start = step.fluid_end = flow.data();
    step.balance.step = 0.5;
    step.duration = 2;
    return fluid_.work(step).backflow / 2;
  }

 private:
  SimplexMesh<Element::dim, Element::order> make(bool curved) {
    auto mesh = irregular_mesh<Element>(2);
    const double first = Element::axisymmetric ? 1 : 0;
    for (const auto& facet : boundary_facets(mesh))
      if (std::all_of(facet.nodes.begin(), facet.nodes.end(),
                      [&](int a) { return std::abs(mesh.nodes[a][0] - first) < 1e-9; }))
        open_.push_back(facet.nodes);
    if (curved) curve<Element>(mesh, 0.1);
    return mesh;
  }
  Submesh<Element::dim, Element::order> part() const { return submesh(mesh_, {0}); }

  std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet> open_;
  SimplexMesh<Element::dim, Element::order> mesh_;
  FluidProblem<Element> fluid_;
};

template <class Element>
class Backflow : public testing::Test {};
using Elements = testing::Types<P1Tetrahedron, P1AxisymmetricTriangle, P1PlaneTriangle, P2P1Tetrahedron,
                                P2P1AxisymmetricTriangle, P2P1PlaneTriangle>;
TYPED_TEST_SUITE(Backflow, Elements);

TYPED_TEST(Backflow, IsNothingWhereFluidLeaves) {
  OpenPiece<TypeParam> piece;
  auto flow = piece.entering();
  for (double& x : flow) x = -x;
  EXPECT_EQ(piece.residual(flow, beta), piece.residual(flow, 0));
  EXPECT_EQ(piece.power(flow), 0);
}

// Where all enters, the term is the polynomial that the flow of kinetic energy is: 2 beta times it.
TYPED_TEST(Backflow, TakesTwoBetaOfTheEnergyThatEnters) {
  OpenPiece<TypeParam> piece;
  const auto flow = piece.entering();
  const double entering = -piece.fluid().kinetic_outflow(piece.fluid().open_boundaries()[0], flow);
  EXPECT_GT(entering, 1);
  EXPECT_NEAR(piece.power(flow), 2 * beta * entering, 1e-13 * entering);
}

TYPED_TEST(Backflow, PowerIsTheTermTestedWithTheVelocity) {
  OpenPiece<TypeParam> piece(true);
  const auto flow = piece.mixed();
  const auto term = piece.term(flow);
  double power = 0;
  for (std::size_t i = 0; i < flow.size(); ++i) power += term[i] * flow[i];
  EXPECT_GT(power, 0.05);
  EXPECT_NEAR(piece.power(flow), power, 1e-12);
  EXPECT_EQ(only(term, TypeParam::components + 1, TypeParam::components, 1), std::vector<double>(term.size(), 0.0));
}

// Where its sign stays, the term is quadratic: differences of any step are exact. Where it changes, a step that is
// small enough changes it at no point.
TYPED_TEST(Backflow, JacobianIsTheDerivativeOfTheTerm) {
  constexpr int entries = TypeParam::components + 1;
  OpenPiece<TypeParam> piece(true);
  for (const bool both : {false, true}) {
    const auto flow = both ? piece.mixed() : piece.entering();
    const auto direction = random_field(piece.nodes(), entries, 1, 0.3, 17);
    FluidJacobian<TypeParam::components> jacobian(piece.fluid().graph(), FluidDerivatives::fluid), without = jacobian;
    const auto with = piece.residual(flow, beta, &jacobian);
    const auto derivative = multiply(jacobian.fluid, direction);
    piece.residual(flow, 0, &without);
    const auto table = central_differences(
        both ? "backflow here, outflow there" : "backflow",
        [&](double t) { return piece.term(moved(flow, t, direction)); },
        difference(derivative, multiply(without.fluid, direction)), both ? 1e-4 : 0.05, both ? 2 : 8);
    EXPECT_LT(table.smallest(), both ? 1e-9 : 1e-11) << table.text();
    EXPECT_GT(norm(derivative), 0.1);
    EXPECT_LT(norm(difference(with, piece.residual(flow, beta))), 1e-13) << "two loops, one residual";
  }
}

TEST(BackflowOfOneOpening, IsInNoOtherRows) {
  OpenPiece<P1Tetrahedron> piece;
  const auto term = piece.term(piece.entering());
  for (std::size_t a = 0; a < piece.nodes().size(); ++a)
    if (piece.nodes()[a][0] > 1e-9) {
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(term[4 * a + k], 0);
    }
}

}  // namespace

}  // namespace fsi::test
