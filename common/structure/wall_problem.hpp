#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "fem/facet_load.hpp"
#include "mesh/submesh.hpp"
#include "structure/fibre_directions.hpp"
#include "structure/structure_assembly.hpp"
#include "structure/wall_energy.hpp"

namespace fsi {

/// A material with the angle of its fibres, if it has any.
struct LayerMaterial {
  Material material;
  double fibre_angle = 0;  ///< radians from the circumference
};

/// The wall sub-problem on its part of the mesh: residual and Jacobian without boundary conditions but with the
/// follower pressure on `pressurised` facets.
template <class Element>
class WallProblem {
 public:
  static constexpr int dim = Element::dim, n = Element::components;
  using Facets = std::vector<typename SimplexMesh<dim>::Facet>;

  /// \param layers       region of the mesh and material of each layer
  /// \param pressurised  facets in the part's node numbers, normals outward from the wall; may be empty
  WallProblem(Submesh<dim> part, const WallConstants& constants,
              const std::vector<std::pair<int, LayerMaterial>>& layers, const CylinderAxis& axis,
              Facets pressurised = {})
      : part_(std::move(part)), constants_(constants), pressurised_(std::move(pressurised)) {
    std::vector<int> cell_nodes;
    for (const auto& cell : part_.cells) cell_nodes.insert(cell_nodes.end(), cell.begin(), cell.end());
    graph_ = std::make_shared<NodeGraph>(graph_of_cells(part_.node_count(), cell_nodes, Element::nodes));
    for (const auto& [region, layer] : layers) {
      std::vector<int> cells;
      for (std::size_t c = 0; c < part_.cells.size(); ++c)
        if (part_.cell_region[c] == region) cells.push_back(static_cast<int>(c));
      layers_.push_back({ElementPacks<Element>(part_.nodes, part_.cells, cells, *graph_), layer.material, {}});
      if (std::holds_alternative<Artery>(layer.material))
        layers_.back().fibres =
            fibre_directions(layers_.back().packs, part_.nodes, part_.cells, axis, layer.fibre_angle);
    }
  }

  const Submesh<dim>& part() const { return part_; }
  const WallConstants& constants() const { return constants_; }
  const std::vector<WallLayer<Element>>& layers() const { return layers_; }
  const std::shared_ptr<const NodeGraph>& graph() const { return graph_; }
  int node_count() const { return part_.node_count(); }

  /// Overwrites the residual, n + 1 rows per node, and the Jacobian if asked.
  /// \param pressure  kPa on the pressurised facets
  AssemblyResult assemble(const StructureInput& in, double pressure, const std::vector<double>& solution,
                          std::vector<double>& residual, bool derivatives = false) {
    residual.assign(static_cast<std::size_t>(node_count()) * (n + 1), 0.0);
    if (derivatives && jacobian_.values.empty()) jacobian_ = StructureMatrix<Element>(graph_);
    const auto result = assemble_structure(constants_, layers_, in, residual, derivatives ? &jacobian_ : nullptr);
    if (pressure != 0)
      add_follower_pressure<Element>(part_.nodes, pressurised_, pressure, solution, residual,
                                     derivatives ? &jacobian_ : nullptr);
    return result;
  }

  WallEnergy energy(const WallStep& in) const { return wall_energy(constants_, layers_, in); }
  /// Work of the pressure on the pressurised facets, as they are at the step's end, in a step from `old` to `now`; uJ.
  double pressure_work(double pressure, const std::vector<double>& old, const std::vector<double>& now) const {
    if (pressure == 0) return 0;
    std::vector<double> load(now.size(), 0.0);
    add_follower_pressure<Element>(part_.nodes, pressurised_, pressure, now, load, nullptr);
    double work = 0;
    for (std::size_t i = 0; i < load.size(); ++i) work -= load[i] * (now[i] - old[i]);
    return work;
  }

  /// The Jacobian last assembled; storage appears with the first request.
  StructureMatrix<Element>& jacobian() {
    if (jacobian_.values.empty()) jacobian_ = StructureMatrix<Element>(graph_);
    return jacobian_;
  }

 private:
  Submesh<dim> part_;
  WallConstants constants_;
  Facets pressurised_;
  std::shared_ptr<const NodeGraph> graph_;
  std::vector<WallLayer<Element>> layers_;
  StructureMatrix<Element> jacobian_;
};

}  // namespace fsi
