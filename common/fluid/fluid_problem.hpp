#pragma once

#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "fem/facet_load.hpp"
#include "fluid/fluid_assembly.hpp"
#include "fluid/fluid_energy.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// The fluid sub-problem on its part of the mesh: residual and derivatives without boundary conditions, and the
/// integrals over its inlet and outlet. Neither face moves.
template <class Element>
class FluidProblem {
 public:
  static constexpr int dim = Element::dim, n = Element::components;
  using Facets = std::vector<typename SimplexMesh<dim>::Facet>;

  /// \param inlet, outlet  facets in the part's node numbers, normals outward
  FluidProblem(Submesh<dim> part, const AleFluid& form, Facets inlet, Facets outlet)
      : part_(std::move(part)),
        form_(form),
        graph_(make_graph(part_)),
        packs_(part_.nodes, part_.cells, all_cells(part_), *graph_),
        inlet_normals_(normal_weights<Element>(part_.nodes, inlet, n + 1)),
        outlet_normals_(normal_weights<Element>(part_.nodes, outlet, n + 1)),
        inlet_areas_(area_weights<Element>(part_.nodes, inlet)),
        outlet_areas_(area_weights<Element>(part_.nodes, outlet)),
        inlet_(std::move(inlet)),
        outlet_(std::move(outlet)) {}

  const Submesh<dim>& part() const { return part_; }
  const AleFluid& form() const { return form_; }
  const std::shared_ptr<const NodeGraph>& graph() const { return graph_; }
  const ElementPacks<Element>& packs() const { return packs_; }
  int node_count() const { return part_.node_count(); }

  /// Overwrites the residual, n + 1 rows per node, with all terms but boundary conditions; the inlet's traction
  /// J sigma F^-T N = -p_in N included.
  AssemblyResult assemble(const FluidInput& in, double inlet_pressure, std::vector<double>& residual,
                          FluidDerivatives derivatives = FluidDerivatives::none) {
    allocate(derivatives);
    residual.assign(static_cast<std::size_t>(node_count()) * (n + 1), 0.0);
    const auto result = assemble_fluid(form_, packs_, in, residual, derivatives, &jacobian_);
    if (inlet_pressure != 0)
      for (std::size_t i = 0; i < residual.size(); ++i) residual[i] += inlet_pressure * inlet_normals_[i];
    return result;
  }

  /// The derivatives last assembled. Storage appears with the first request.
  FluidJacobian<Element>& jacobian(FluidDerivatives derivatives) {
    allocate(derivatives);
    return jacobian_;
  }

  /// Volume flow in (mm^3/ms) and mean pressure (kPa) of inlet and outlet, for flow arrays (u, p).
  double inlet_flow(const std::vector<double>& flow) const { return -dot(inlet_normals_, flow); }
  double outlet_flow(const std::vector<double>& flow) const { return dot(outlet_normals_, flow); }
  double inlet_pressure(const std::vector<double>& flow) const { return mean_pressure(inlet_areas_, flow); }
  double outlet_pressure(const std::vector<double>& flow) const { return mean_pressure(outlet_areas_, flow); }

  FluidEnergy energy(const FluidInput& in) const { return fluid_energy(form_, packs_, in); }
  /// Kinetic energy that flows in through the inlet and out through the outlet, uJ/ms, for flow arrays (u, p).
  double inlet_kinetic_flow(const std::vector<double>& flow) const {
    return -form_.density * kinetic_flux<Element>(part_.nodes, inlet_, flow);
  }
  double outlet_kinetic_flow(const std::vector<double>& flow) const {
    return form_.density * kinetic_flux<Element>(part_.nodes, outlet_, flow);
  }

 private:
  static std::shared_ptr<const NodeGraph> make_graph(const Submesh<dim>& part) {
    std::vector<int> cell_nodes;
    for (const auto& cell : part.cells) cell_nodes.insert(cell_nodes.end(), cell.begin(), cell.end());
    return std::make_shared<NodeGraph>(graph_of_cells(part.node_count(), cell_nodes, Element::nodes));
  }
  static std::vector<int> all_cells(const Submesh<dim>& part) {
    std::vector<int> all(part.cells.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  }
  static double mean_pressure(const std::vector<double>& areas, const std::vector<double>& flow) {
    double integral = 0, area = 0;
    for (std::size_t a = 0; a < areas.size(); ++a) {
      integral += areas[a] * flow[a * (n + 1) + n];
      area += areas[a];
    }
    return area > 0 ? integral / area : 0;
  }
  void allocate(FluidDerivatives derivatives) {
    if (derivatives != FluidDerivatives::none && jacobian_.flow.values.empty())
      jacobian_.flow = decltype(jacobian_.flow)(graph_);
    if (derivatives == FluidDerivatives::flow_and_domain && jacobian_.mesh_motion.values.empty())
      jacobian_.mesh_motion = decltype(jacobian_.mesh_motion)(graph_);
  }

  Submesh<dim> part_;
  AleFluid form_;
  std::shared_ptr<const NodeGraph> graph_;
  ElementPacks<Element> packs_;
  FluidJacobian<Element> jacobian_;
  std::vector<double> inlet_normals_, outlet_normals_;  ///< n + 1 entries per node, as flow arrays
  std::vector<double> inlet_areas_, outlet_areas_;
  Facets inlet_, outlet_;
};

}  // namespace fsi
