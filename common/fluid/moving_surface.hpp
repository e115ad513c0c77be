#pragma once

#include <memory>
#include <vector>

#include "fluid/fluid_input.hpp"
#include "mesh/simplex_mesh.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// An opening that moves with the mesh because the wall's end at its rim slides or is free (docs/theory.md, section
/// 3.8): integrals over its current facets. Mesh arrays are in the vector layout, flow arrays in the mixed one. Of a
/// surface that processes share, nodal arrays are whole at this process's own nodes, and sums are of the facets that it
/// counts: the caller adds them up.
template <int n>
class MovingSurface {
 public:
  using ShapeDerivatives = decltype(FluidJacobian<n>::shape_derivatives);

  virtual ~MovingSurface() = default;

  /// Integrals of N_a n, as a flow array, mm^2; zero at ghosts (nodes of other processes).
  virtual std::vector<double> normals(const double* mesh) const = 0;
  /// Integrals of the scalar fields' shape functions per node, mm^2; zero at ghosts.
  virtual std::vector<double> areas(const double* mesh) const = 0;

  /// Adds to the fluid's residual the term of the traction -pressure n (kPa), +pressure <n, v>, and, unless null, its
  /// derivative by the mesh's displacement.
  virtual void add_pressure(double pressure, const double* mesh, double* residual,
                            ShapeDerivatives* derivatives) const = 0;
  /// Volume flow outward, integral of u . n, mm^3/ms.
  virtual double outflow(const double* mesh, const double* flow) const = 0;
  /// Volume flow outward relative to the moving surface, integral of (u - w) . n, w the mesh's velocity, mm^3/ms; and
  /// its derivative by the mesh's displacement, mm^2/ms, vector layout, zero at ghosts.
  virtual double relative_outflow(const FluidInput& in) const = 0;
  virtual std::vector<double> relative_outflow_slope(const FluidInput& in) const = 0;
  /// Integral of |u|^2/2 (u - w) . n, w the mesh's velocity, mm^5/ms^3.
  virtual double kinetic_outflow(const FluidInput& in) const = 0;

  /// Adds the stabilisation of backflow (fluid/backflow.hpp), beta rho <((u - w) . n)_- u, v>, and the derivatives
  /// asked for. \param jacobian  with storage for these derivatives; may be null where none are asked for
  virtual void add_backflow(double density, double beta, const FluidInput& in, double* residual,
                            FluidJacobian<n>* jacobian, FluidDerivatives derivatives) const = 0;
  /// What that takes from the flow, uJ/ms.
  virtual double backflow_power(double density, double beta, const FluidInput& in) const = 0;
};

/// \param nodes   reference positions of the fluid's nodes, mm
/// \param facets  in their numbers, normals outward; where nodes are shared out, those that touch an own node
/// \param share   of the nodes then; null: they are whole
template <class Element>
std::shared_ptr<const MovingSurface<Element::components>> moving_surface(
    const std::vector<Point>& nodes,
    const std::vector<typename SimplexMesh<Element::dim, Element::order>::Facet>& facets,
    const NodeShare* share = nullptr);

}  // namespace fsi
