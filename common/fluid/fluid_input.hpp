#pragma once

#include <memory>

#include "algebra/block_matrix.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

/// What the fluid's residual depends on. Flow arrays hold (u, p) in the mixed layout, in mm/ms and kPa; mesh arrays the
/// displacement d_m in the vector layout, in mm. The latter are null where the domain is rigid. Rates are a factor
/// times what the field has moved from a reference, as the time integrator says:
///   du/dt = fluid_factor (u - fluid_reference),   w = mesh_factor (d_m - mesh_reference).
struct FluidInput {
  const double* mesh = nullptr;
  const double* mesh_reference = nullptr;
  const double* fluid = nullptr;
  const double* fluid_reference = nullptr;
  double fluid_factor = 0;  ///< 1/ms
  double mesh_factor = 0;   ///< 1/ms
  /// ms, the dt of tau (docs/theory.md, section 3.2): theta dt where a rule balances within the step
  double step = 0;
  /// The projected pressure gradient of the stabilisation, vector layout, kPa/mm. The sub-problem finds it itself.
  const double* projected_gradient = nullptr;
};

/// Which derivatives an element loop is asked for.
enum class FluidDerivatives { none, fluid, fluid_and_domain };

/// Derivatives of the fluid's residual with respect to its own unknowns (u, p) and to the mesh displacement.
/// Owned by the System that solves with it; the element loops fill it.
template <int n>
struct FluidJacobian {
  static constexpr int own = MixedLayout<n>::entries;
  BlockMatrix<own, own> fluid;            ///< columns (u, p)
  BlockMatrix<own, n> shape_derivatives;  ///< columns d_m; empty where not asked for

  FluidJacobian() = default;
  /// Zeros on the fluid's graph, for these derivatives.
  FluidJacobian(const std::shared_ptr<const NodeGraph>& graph, FluidDerivatives derivatives) {
    if (derivatives != FluidDerivatives::none) fluid = BlockMatrix<own, own>(graph);
    if (derivatives == FluidDerivatives::fluid_and_domain) shape_derivatives = BlockMatrix<own, n>(graph);
  }

  /// Those that it has room for.
  FluidDerivatives derivatives() const {
    if (!fluid.graph) return FluidDerivatives::none;
    return shape_derivatives.graph ? FluidDerivatives::fluid_and_domain : FluidDerivatives::fluid;
  }
};

/// One balance of a step: where its equations hold, with what weight, and the levels between which the step leads.
struct FluidStep {
  FluidInput balance;
  double duration = 0;                 ///< ms, of the balance in the step: its weight times the step
  double weight = 1;                   ///< those of a step add up to one
  const double* mesh_start = nullptr;  ///< levels, as in FluidInput; null where the domain is rigid
  const double* mesh_end = nullptr;
  const double* fluid_start = nullptr;
  const double* fluid_end = nullptr;
};

/// What the discrete equations of one balance, tested with its (u, -p) for its duration W, do besides changing the kinetic
/// energy (docs/energy.md); all in uJ = mm^3 kPa. With levels 0 and 1, values without index those of the balance, weight
/// omega and D = W cof F : grad w, summed over the balances of a step
///   W (rho J (du/dt + grad u F^-1 c), u) = kinetic_1 - kinetic_0 + inertia + mesh_motion + divergence + outflow,
/// where outflow is that of rho/2 |u|^2 through the open faces and the integration rule makes `convection` equal to it:
/// for linear elements. Otherwise convection takes the outflow's place.
struct FluidWork {
  double viscous = 0;        ///< W (mu J (grad u F^-1 + ...^T), grad u F^-1)
  double stabilisation = 0;  ///< W times the power of the SUPG, PSPG and grad-div terms
  double inertia = 0;        ///< rho (W J du/dt, u) - omega rho/2 (J, |u_1|^2 - |u_0|^2): the scheme in time
  /// rho/2 (D, |u|^2) + omega rho/2 [(J - J_1, |u_1|^2) - (J - J_0, |u_0|^2)]: the domain's motion is not conserved
  double mesh_motion = 0;
  double divergence = 0;   ///< -W rho/2 (J div u, |u|^2): convection in convective form
  double backflow = 0;     ///< W beta rho <(u . n)_-, |u|^2> of the openings: stabilisation of backflow
  double convection = 0;   ///< W rho ((J grad u F^-1 c, u) + (J div c, |u|^2)/2), the outflow if integrated exactly
  double kinetic_end = 0;  ///< kinetic_1 = rho/2 (J_1, |u_1|^2), for it costs nothing here

  FluidWork& operator+=(const FluidWork& b) {
    viscous += b.viscous;
    stabilisation += b.stabilisation;
    inertia += b.inertia;
    mesh_motion += b.mesh_motion;
    divergence += b.divergence;
    backflow += b.backflow;
    convection += b.convection;
    kinetic_end += b.kinetic_end;
    return *this;
  }
};

}  // namespace fsi
