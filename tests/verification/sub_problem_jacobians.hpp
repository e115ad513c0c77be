#pragma once

#include <string>
#include <vector>

#include "fluid/fluid_problem.hpp"
#include "mesh_motion/harmonic.hpp"
#include "mesh_motion/mesh_motion.hpp"
#include "support/differences.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test {

/// Deformed, moving, convecting: nothing vanishes and the three terms of tau are of like size.
template <class Element>
struct FluidState {
  std::vector<double> mesh, mesh_old, fluid, fluid_old;

  explicit FluidState(const std::vector<Point>& x) {
    constexpr int n = Element::components;
    mesh = random_field(x, n, 0.15, 0.02, 1);
    mesh_old = random_field(x, n, 0.15, 0.02, 2);
    fluid = random_field(x, n + 1, 3.0, 0.5, 3);
    fluid_old = random_field(x, n + 1, 3.0, 0.5, 4);
  }
  FluidInput input() const { return euler_input(&mesh, &mesh_old, fluid, fluid_old, 0.5); }
};

/// (2/dt)^2 = 16, c . G c about 30 and 36 nu^2 G : G about 10 on a unit box with three elements a side.
inline AleFluid strongly_coupled_fluid(bool grad_div) {
  return {/*density=*/1.3, /*viscosity=*/0.03, grad_div, /*step=*/0.5};
}

enum class Order { second, exact };

/// What the difference of each block of the fluid's Jacobian must look like; exact where the residual is at most
/// quadratic in the unknown.
struct FluidBlock {
  const char* row;
  int first_row, rows;
  const char* column;
  Order order;
};

/// Every block of the fluid's Jacobian against differences of its residual.
/// \param law  whether the viscosity follows one: momentum is not quadratic in the velocity then, and the shear rate,
///             which has a kink at rest, asks for smaller steps
template <class Element>
void check_fluid_blocks(FluidProblem<Element>& fluid, const FluidState<Element>& state, const std::string& name,
                        const std::vector<unsigned>& seeds, bool law = false) {
  constexpr int n = Element::components;
  const auto& x = fluid.part().nodes;
  std::vector<double> at_state;
  FluidJacobian<n> jacobian(fluid.graph(), FluidDerivatives::fluid_and_domain);
  ASSERT_FALSE(fluid.assemble(state.input(), {}, at_state, &jacobian).inverted());

  std::vector<double> without_derivatives;
  fluid.assemble(state.input(), {}, without_derivatives);
  EXPECT_LT(norm(difference(at_state, without_derivatives)), 1e-14 * norm(at_state)) << "two loops, one residual";

  // Without stabilisation the residual is quadratic in the velocity and the continuity equation in cof F.
  const Order by_tau = Element::stabilised ? Order::second : Order::exact;
  std::vector<FluidBlock> blocks = {{"momentum", 0, n, "mesh displacement", Order::second},
                                    {"continuity", n, 1, "mesh displacement", by_tau},
                                    {"momentum", 0, n, "velocity", law ? Order::second : by_tau},
                                    {"continuity", n, 1, "velocity", by_tau},
                                    {"momentum", 0, n, "pressure", Order::exact}};
  if (Element::stabilised) blocks.push_back({"continuity", n, 1, "pressure", Order::exact});
  for (const auto& block : blocks)
    for (unsigned seed : seeds) {
      const bool domain = std::string(block.column) == "mesh displacement";
      std::vector<double> direction;
      std::vector<double> product;
      if (domain) {
        direction = random_field(x, n, 0.3, 0.1, 100 + seed);
        product = multiply(jacobian.shape_derivatives, direction);
      } else {
        const bool velocity = std::string(block.column) == "velocity";
        direction = only(random_field(x, n + 1, 4.0, 1.0, 200 + seed), n + 1, velocity ? 0 : n, velocity ? n : 1);
        product = multiply(jacobian.fluid, direction);
      }
      const auto residual = [&](double t) {
        FluidState<Element> there = state;
        (domain ? there.mesh : there.fluid) = moved(domain ? state.mesh : state.fluid, t, direction);
        std::vector<double> r;
        fluid.assemble(there.input(), {}, r);
        return only(r, n + 1, block.first_row, block.rows);
      };
      const auto table =
          central_differences(name + ": " + block.row + " by " + block.column, residual,
                              only(product, n + 1, block.first_row, block.rows), law ? 0.0125 : 0.05, law ? 14 : 16);
      block.order == Order::second ? expect_second_order(table) : expect_exact(table);
    }
}

/// Every block of the wall's Jacobian, Newmark's inertia and the follower pressure included.
template <class Element>
void check_wall_blocks(WallProblem<Element>& wall, std::vector<double> solution, const std::vector<double>& history,
                       double acceleration_factor, double pressure, const std::string& name,
                       const std::vector<unsigned>& seeds) {
  constexpr int n = Element::components;
  const auto& x = wall.part().nodes;
  const auto residual_at = [&](const std::vector<double>& at, WallMatrix<n>* jacobian = nullptr) {
    std::vector<double> r;
    const auto result = wall.assemble({at.data(), history.data(), acceleration_factor}, pressure, at, r, jacobian);
    EXPECT_FALSE(result.inverted()) << name;
    return r;
  };
  WallMatrix<n> jacobian(wall.graph());
  const auto at_state = residual_at(solution, &jacobian);
  EXPECT_LT(norm(difference(at_state, residual_at(solution))), 1e-14 * norm(at_state)) << "two loops, one residual";

  // In the plane J is quadratic, tr E is everywhere, tr eps even linear as all of its law.
  const ElementLaw law = element_law(wall.layers()[0].material);
  const auto* compressible = std::get_if<CompressibleLaw>(&law);
  const bool linear = compressible && compressible->is<LinearElastic>();
  const bool quadratic_volume = compressible
                                    ? linear || (!Element::stabilised && compressible->is<SaintVenantKirchhoff>())
                                    : !Element::stabilised && Element::dim == 2 && !Element::axisymmetric;
  for (const auto& [row, first_row, rows] : {std::tuple{"momentum", 0, n}, std::tuple{"volume", n, 1}})
    for (const auto& [column, first_column, columns] : {std::tuple{"displacement", 0, n}, std::tuple{"pressure", n, 1}})
      for (unsigned seed : seeds) {
        const bool quadratic = first_column == n || (first_row == n ? quadratic_volume : linear && pressure == 0);
        const auto direction = only(random_field(x, n + 1, 0.3, 0.1, 300 + seed), n + 1, first_column, columns);
        const auto product = only(multiply(jacobian, direction), n + 1, first_row, rows);
        const auto residual = [&, first = first_row, count = rows](double t) {
          return only(residual_at(moved(solution, t, direction)), n + 1, first, count);
        };
        const auto table = central_differences(name + ": " + row + " by " + column, residual, product, 0.05, 16);
        quadratic ? expect_exact(table) : expect_second_order(table);
      }
}

/// The constant operator of the mesh motion is the derivative of its own weak form, (grad d, grad v), and multiplies
/// right. The weak form is evaluated here on its own: integrand and element, no derivatives.
template <class Element>
std::vector<double> mesh_motion_residual(const ElementPacks<Element>& packs, const std::vector<double>& mesh) {
  constexpr int n = Element::components;
  std::vector<double> padded(mesh.size() / n * (n + 1), 0.0);
  for (int t = 0; t < packs.thread_count(); ++t)
    for (const auto& pack : packs.of_thread(t)) {
      NodalVector<Element> d{};
      gather<VectorLayout<n>>(d, pack, mesh.data());
      ElementRows<Element, Pack> rows;
      integrate(
          rows, pack.geometry, [&](const auto& g) { return gradient_of(d, g); },
          [](const auto& grad_d, const auto&, int) { return HarmonicMeshMotion{}.integrand(grad_d); });
      scatter_residual<Element>(rows, pack, padded.data());
    }
  std::vector<double> residual(mesh.size());
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = padded[i / n * (n + 1) + i % n];
  return residual;
}

}  // namespace fsi::test
