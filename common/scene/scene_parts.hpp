#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "mesh/mesh_share.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/fibre_frame.hpp"
#include "scene/inflow.hpp"
#include "scene/wall_supports.hpp"

namespace fsi {

/// What a scene's wall is made of.
template <class Element>
struct WallParts {
  PartOf<Element> part;
  WallConditions<Element::components> held;
  std::vector<std::pair<int, Material>> layers;  ///< region and material
  FacetsOf<Element> pressurised;                 ///< where the case's pressure acts on a wall without fluid
  std::optional<WallFrame> frame;                ///< of fibres; empty: there are none
  SupportFacets<Element> supports;
  std::vector<std::int64_t> whole_cells;  ///< per cell, its number in the whole wall; empty: the part is whole
};

/// What a scene's fluid is made of.
template <class Element>
struct FluidParts {
  int region = -1;  ///< of the mesh
  PartOf<Element> part;
  FluidBoundary<Element> boundary;
  std::size_t interface_ghosts = 0;  ///< how many of its pairs at the end are other processes'
  std::vector<Inflow> inflows;
  std::vector<double> stiffness;  ///< of the mesh motion, per cell; empty: one everywhere
};

/// A scene before element loops and matrices are made: all that takes the whole mesh to find.
template <class Element>
struct SceneParts {
  std::optional<WallParts<Element>> wall;
  std::optional<FluidParts<Element>> fluid;
  std::vector<std::string> remarks{};  ///< for the log
};

/// Of the whole mesh, alike at each process. \throws InputError where the case and its mesh do not go together, and
/// where conditions leave a pressure without an equation (scene/pressure_equations.hpp)
template <class Element>
SceneParts<Element> find_parts(const Case& setup, const MeshOf<Element>& mesh);

/// The whole parts of a mesh that is shared out, and the ways from their numbers to those here: for all that is found on
/// the whole and kept in part. Null where there is no such medium.
template <class Element>
struct WholeParts {
  using Part = Submesh<Element::dim, Element::order>;
  std::unique_ptr<const Part> fluid, wall;
  std::unique_ptr<const PartRestriction> fluid_here, wall_here;
};

/// Restricts the parts of a whole scene to what this process holds. \returns the whole parts
/// \param share  must live as long as these
template <class Element>
WholeParts<Element> restrict_to(const MeshShare& share, SceneParts<Element>& scene);

}  // namespace fsi
