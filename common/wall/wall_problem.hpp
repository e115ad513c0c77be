#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "fem/assembly_result.hpp"
#include "fem/function_space.hpp"
#include "mesh/submesh.hpp"
#include "wall/fibre_directions.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

/// The wall sub-problem on its part of the mesh: residual and Jacobian without boundary conditions but with the
/// follower pressure on `pressurised` facets.
template <class Element>
class WallProblem {
 public:
  static constexpr int dim = Element::dim, n = Element::components;
  using Part = Submesh<Element::dim, Element::order>;
  using Facets = std::vector<typename Part::Facet>;

  /// \param layers       region of the mesh and material of each layer
  /// \param pressurised  facets in the part's node numbers, normals outward from the wall; may be empty
  WallProblem(Part part, const WallConstants& constants, const std::vector<std::pair<int, Material>>& layers,
              const CylinderAxis& axis, Facets pressurised = {});

  const Part& part() const { return part_; }
  const WallConstants& constants() const { return constants_; }
  const std::vector<WallLayer<Element>>& layers() const { return layers_; }
  const FunctionSpace<Element>& space() const { return space_; }
  const std::shared_ptr<const NodeGraph>& graph() const { return space_.graph(); }
  int node_count() const { return part_.node_count(); }

  /// Overwrites the residual, in the mixed layout, and the Jacobian if asked.
  /// \param pressure  kPa on the pressurised facets
  AssemblyResult assemble(const WallInput& in, double pressure, const std::vector<double>& solution,
                          std::vector<double>& residual, bool derivatives = false);

  WallEnergy energy(const WallStep& in) const;
  /// Work of the pressure on the pressurised facets, as they are at the step's end, in a step from `old` to `now`; uJ.
  double pressure_work(double pressure, const std::vector<double>& old, const std::vector<double>& now) const;

  /// The Jacobian last assembled; storage appears with the first request.
  WallMatrix<Element>& jacobian();

 private:
  Part part_;
  WallConstants constants_;
  Facets pressurised_;
  FunctionSpace<Element> space_;
  std::vector<WallLayer<Element>> layers_;
  WallMatrix<Element> jacobian_;
};

}  // namespace fsi
