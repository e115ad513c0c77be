#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/function_space.hpp"
#include "fluid/ale_fluid.hpp"
#include "fluid/fluid_input.hpp"
#include "fluid/open_boundary.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// The fluid sub-problem as everything above the element loops sees it, vectors with n components: residual and
/// derivatives without boundary conditions, integrals over its domain and its open boundaries.
template <int n>
class Fluid {
 public:
  virtual ~Fluid() = default;

  virtual const PartNodes& nodes() const = 0;
  virtual const FunctionSpace<n>& space() const = 0;
  virtual const AleFluid& form() const = 0;
  /// \param speed  of pressure waves in the scene, mm/ms, for the stabilisation; 0, as at first: not known
  virtual void set_wave_speed(double speed) = 0;
  /// Stabilises the flow at an open boundary against fluid that enters (fluid/backflow.hpp).
  /// \param open         its place in open_boundaries()
  /// \param coefficient  beta; 0, as at first: without
  virtual void stabilise_backflow(std::size_t open, double coefficient) = 0;
  /// Whether this is done anywhere.
  virtual bool stabilises_backflow() const = 0;
  const std::shared_ptr<const NodeGraph>& graph() const { return space().graph(); }
  int node_count() const { return nodes().node_count(); }

  virtual const std::vector<OpenBoundary<n>>& open_boundaries() const = 0;
  /// The open boundary of a name; a null pointer when there is none.
  const OpenBoundary<n>* open_boundary(const std::string& name) const {
    for (const auto& boundary : open_boundaries())
      if (boundary.name() == name) return &boundary;
    return nullptr;
  }

  /// Overwrites the residual, in the mixed layout, with all terms but prescribed values; the tractions of the open
  /// boundaries included: -p N, and those against backflow.
  /// \param pressures  from outside, kPa, of the open boundaries in their order; missing ones are zero
  /// \param jacobian   on the graph(): the derivatives that it has room for are overwritten, for given pressures from
  ///                   outside: how these depend on the flow, dp/dQ w w^T, w the normals of an opening, would fill the
  ///                   matrix (linear/interface/low_rank_solver.hpp). Null: no derivatives
  virtual AssemblyResult assemble(const FluidInput& in, const std::vector<double>& pressures,
                                  std::vector<double>& residual, FluidJacobian<n>* jacobian = nullptr) = 0;

  /// uJ, of a level: mesh displacement (empty where the domain is rigid) and flow (u, p). Of the elements that sums count
  /// here, as work() is of these and of the openings' facets.
  virtual double kinetic_energy(const std::vector<double>& mesh, const std::vector<double>& flow) const = 0;
  /// \param step  its balance as projected() returns it; else the projected term counts with a gradient of zero
  virtual FluidWork work(const FluidStep& step) const = 0;
  /// The input with the projected gradient of the stabilisation, where there is one: made once for several evaluations.
  /// The gradient is overwritten by the next evaluation with another reference level. To be called by all processes
  /// that share the fluid, as assemble() and power_at(), which call it.
  virtual FluidInput projected(const FluidInput& in) = 0;
  /// The residual's momentum rows of some nodes, as assemble() makes them, tested with the velocity, uJ/ms: the power of
  /// the forces that give these nodes their velocity. Of the nodes that this process owns.
  /// \param nodes  the same ones in every call
  virtual double power_at(const std::vector<int>& nodes, const FluidInput& in,
                          const std::vector<double>& pressures) = 0;
  /// Kinetic energy that flows out through an open boundary, uJ/ms, of the flow that an input points to.
  double kinetic_outflow(const OpenBoundary<n>& open, const FluidInput& in, const std::vector<double>& flow) const {
    return form().density * open.kinetic_outflow(nodes().nodes, in, flow);
  }
  /// Of an opening that stays, for flow arrays (u, p).
  double kinetic_outflow(const OpenBoundary<n>& open, const std::vector<double>& flow) const {
    return form().density * open.kinetic_outflow(nodes().nodes, flow);
  }

  virtual std::size_t element_count() const = 0;
  virtual double volume() const = 0;  ///< of the whole fluid at rest, mm^3
  /// The elements as vertices, n + 1 numbers each.
  virtual std::vector<int> cell_vertices() const = 0;
};

}  // namespace fsi
