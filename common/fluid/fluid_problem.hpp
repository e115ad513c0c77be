#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/element_packs.hpp"
#include "fem/function_space.hpp"
#include "fluid/ale_fluid.hpp"
#include "fluid/fluid_input.hpp"
#include "fluid/open_boundary.hpp"

namespace fsi {

/// The fluid sub-problem on its part of the mesh: residual and derivatives without boundary conditions, and the
/// integrals over its open boundaries.
template <class Element>
class FluidProblem {
 public:
  static constexpr int dim = Element::dim, n = Element::components;
  using Part = Submesh<Element::dim, Element::order>;

  /// \param open  surfaces in the part's node numbers, none of which moves
  FluidProblem(Part part, const AleFluid& form, std::vector<OpenBoundary<Element>> open);

  const Part& part() const { return part_; }
  const AleFluid& form() const { return form_; }
  const FunctionSpace<Element>& space() const { return space_; }
  const std::shared_ptr<const NodeGraph>& graph() const { return space_.graph(); }
  const ElementPacks<Element>& packs() const { return packs_; }
  int node_count() const { return part_.node_count(); }

  const std::vector<OpenBoundary<Element>>& open_boundaries() const { return open_; }
  /// The open boundary of a name; a null pointer when there is none.
  const OpenBoundary<Element>* open_boundary(const std::string& name) const;

  /// Overwrites the residual, in the mixed layout, with all terms but prescribed values; the tractions -p N of the open
  /// boundaries included.
  /// \param pressures  kPa, of the open boundaries in their order; missing ones are zero
  AssemblyResult assemble(const FluidInput& in, const std::vector<double>& pressures, std::vector<double>& residual,
                          FluidDerivatives derivatives = FluidDerivatives::none);

  /// The derivatives last assembled. Storage appears with the first request.
  FluidJacobian<Element>& jacobian(FluidDerivatives derivatives);

  FluidEnergy energy(const FluidInput& in) const;
  /// Kinetic energy that flows out through an open boundary, uJ/ms, for flow arrays (u, p).
  double kinetic_outflow(const OpenBoundary<Element>& open, const std::vector<double>& flow) const {
    return form_.density * open.kinetic_outflow(part_.nodes, flow);
  }

 private:
  Part part_;
  AleFluid form_;
  FunctionSpace<Element> space_;
  ElementPacks<Element> packs_;
  FluidJacobian<Element> jacobian_;
  std::vector<OpenBoundary<Element>> open_;
};

}  // namespace fsi
