#pragma once

#include <string>
#include <vector>

#include "case/openings.hpp"
#include "fem/nodal_frames.hpp"
#include "mesh/submesh.hpp"
#include "scene/scene.hpp"

namespace fsi {

template <class Element>
using MeshOf = SimplexMesh<Element::dim, Element::order>;
template <class Element>
using PartOf = Submesh<Element::dim, Element::order>;
template <class Element>
using FacetsOf = std::vector<typename MeshOf<Element>::Facet>;

/// The facets of a group; none when the mesh has no group of that name.
template <class Mesh>
std::vector<typename Mesh::Facet> group_facets(const Mesh& mesh, const std::string& name) {
  const auto* facets = mesh.facets(name);
  return facets ? *facets : std::vector<typename Mesh::Facet>{};
}

/// Facets of the whole mesh in the node numbers of a part, which they bound; where nodes have copies, in those of the
/// cell behind them.
template <class Element>
FacetsOf<Element> in_part(const PartOf<Element>& part, const FacetsOf<Element>& facets);

/// Where pressure acts on a wall without fluid: its interface with the fluid volume if the mesh has one, else the group
/// `inner`; normals out of the wall, nodes of the whole mesh.
template <class Element>
FacetsOf<Element> inner_surface(const MeshOf<Element>& mesh, const std::vector<int>& wall_regions);

/// Nodes of a part that cannot move in one direction.
template <int n>
struct HeldSurface {
  std::vector<char> on;    ///< per node of the part
  Direction<n> direction;  ///< unit vector
};

/// The components normal to symmetry planes at the nodes of a part on them, and of an axisymmetric part the radial ones
/// on the axis. Where the normals, or what is free between two planes, are along no axis of space, nodes get a frame.
/// \param held  surfaces held by something else besides
template <class Element>
VanishingComponents<Element::components> mirrored_components(
    const MeshOf<Element>& mesh, const PartOf<Element>& part,
    const std::vector<HeldSurface<Element::components>>& held = {});

/// The unit normals of the planes of symmetry that a node of a part lies in, of an axisymmetric part the radial direction
/// on the axis, and the directions of other surfaces on which something is held.
template <class Element>
class HeldDirections {
 public:
  static constexpr int n = Element::components;
  /// \param part  must outlive this
  HeldDirections(const MeshOf<Element>& mesh, const PartOf<Element>& part, std::vector<HeldSurface<n>> others = {});
  /// Those of symmetry first.
  std::vector<Direction<n>> at(int node) const;
  /// Without those of other surfaces.
  std::vector<Direction<n>> of_symmetry(int node) const;

 private:
  const PartOf<Element>& part_;
  std::vector<HeldSurface<n>> planes_, others_;
};

/// One flag per node of a part: on these facets of the whole mesh.
template <class Element>
std::vector<char> nodes_on(const PartOf<Element>& part, const FacetsOf<Element>& facets);

/// Where the wall's displacement is held at zero: on clamped ends, and components on symmetry planes, on the axis and
/// where supports hold it.
template <int n>
struct WallConditions {
  DirichletConditions<n> conditions;
  NodalFrames<n> frames;
};
/// \throws InputError as surfaces_held_by_supports() (scene/wall_supports.hpp)
template <class Element>
WallConditions<Element::components> wall_conditions(const Case& setup, const MeshOf<Element>& mesh,
                                                    const PartOf<Element>& wall);

/// Where the velocity of an opening is prescribed by its flow.
struct InflowNodes {
  std::size_t opening;         ///< its number
  std::vector<int> nodes;      ///< of the fluid, but for those where it sticks
  std::vector<char> sticking;  ///< per node of the fluid
};

/// What bounds the fluid.
template <class Element>
struct FluidBoundary {
  DirichletConditions<Element::components> velocity, mesh;
  std::vector<InterfaceNode> interface;
  std::vector<double> interface_areas;  ///< that belongs to each of its nodes, mm^2
  double closed_area = 0;               ///< mm^2, on which it sticks to a rigid wall
  std::vector<OpenBoundary<Element::components>> open;
  std::vector<InflowNodes> inflows;                   ///< of the openings whose flow is given
  VanishingComponents<Element::components> mirrored;  ///< normal to planes of symmetry, radial on the axis
  NodalFrames<Element::components> frames;  ///< of velocity and mesh: those of `mirrored` unless openings move
};

/// The wall as the fluid's boundary meets it.
template <class Element>
struct WallSide {
  const PartOf<Element>& part;
  const WallConditions<Element::components>& held;
  std::vector<HeldSurface<Element::components>> supports;  ///< surfaces_held_by_supports()
};

/// No slip on every facet that is neither open nor interface nor on a symmetry plane or the axis, and on the rims where
/// the wall's clamped ends meet the fluid; a mesh at rest there and on the open boundaries. On symmetry planes and on
/// the axis the normal components are zero, of the velocity and of the mesh. Where the flow through an opening is given,
/// the velocity of its nodes is prescribed, save where the fluid sticks or moves with the interface. Openings whose rim
/// is not clamped move with it (scene/moving_openings.hpp).
/// \param interface   facets between fluid and wall, nodes of the whole mesh
/// \param wall        null without wall
template <class Element>
FluidBoundary<Element> fluid_boundary(const std::vector<OpeningData>& openings, const MeshOf<Element>& mesh,
                                      const PartOf<Element>& fluid, const FacetsOf<Element>& interface,
                                      const WallSide<Element>* wall);

}  // namespace fsi
