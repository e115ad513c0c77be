#include "scene/fibre_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "mesh/boundary.hpp"
#include "mesh/group_names.hpp"
#include "mesh/symmetry_planes.hpp"

namespace fsi {

namespace {

constexpr const char* key = "structure.fibre_frame";
constexpr const char* other_frame = "set fibre_frame = \"cylinder\"";

/// Sets of nodes that simplices connect.
class ConnectedNodes {
 public:
  explicit ConnectedNodes(std::size_t nodes) : parent_(nodes) { std::iota(parent_.begin(), parent_.end(), 0); }
  template <class Simplex>
  void connect(const Simplex& simplex) {
    for (int node : simplex) {
      const int a = root(simplex[0]), b = root(node);
      parent_[std::max(a, b)] = std::min(a, b);
    }
  }
  /// The smallest node of the set.
  int root(int node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

 private:
  std::vector<int> parent_;
};

template <class Facet>
double area_of(const std::vector<Point>& nodes, const Facet& facet) {
  const Point &a = nodes[facet[0]], &b = nodes[facet[1]], &c = nodes[facet[2]];
  const Vec3<double> u{{b[0] - a[0], b[1] - a[1], b[2] - a[2]}}, v{{c[0] - a[0], c[1] - a[1], c[2] - a[2]}};
  const Vec3<double> normal = cross(u, v);
  return std::sqrt(dot(normal, normal)) / 2;
}

template <class Element>
void mark(const PartOf<Element>& wall, const typename MeshOf<Element>::Facet& facet, std::vector<char>& marks) {
  for (int node : facet) marks[wall.local_node[node]] = 1;
}

template <class Element>
std::array<int, Element::dim> vertices_of(const typename MeshOf<Element>::Facet& facet) {
  std::array<int, Element::dim> vertices;
  std::copy_n(facet.begin(), vertices.size(), vertices.begin());
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Marks start and end among the pieces of `wall_ends`.
/// \param body  sets of nodes of the mesh that the wall's cells make
template <class Element>
void mark_ends(const MeshOf<Element>& mesh, const PartOf<Element>& wall, const FacetsOf<Element>& ends,
               ConnectedNodes& body, const std::vector<int>& bodies, const std::string& case_file,
               FrameBoundary& boundary) {
  ConnectedNodes piece(mesh.nodes.size());
  for (const auto& facet : ends) piece.connect(facet);
  std::map<int, double> area;  // per piece
  for (const auto& facet : ends) area[piece.root(facet[0])] += area_of(mesh.nodes, facet);
  std::map<int, int> start, count;  // per body
  for (const auto& [root, size] : area) {
    const int of = body.root(root);
    ++count[of];
    const auto known = start.find(of);
    // By more than rounding, so that equal faces keep their order
    if (known == start.end() || size > (1 + 1e-9) * area[known->second]) start[of] = root;
  }
  for (int of : bodies)
    if (count[of] < 2)
      throw InputError(
          case_file, key,
          "the frame \"laplace\" runs from one end of the wall to the others, and the surface wall_ends has " +
              std::to_string(count[of]) + (count[of] == 1 ? " connected piece" : " connected pieces") + " on this wall",
          std::string("name two or more end faces of the wall wall_ends in the mesh, or ") + other_frame);
  boundary.start.assign(wall.nodes.size(), 0);
  boundary.end = boundary.start;
  for (const auto& facet : ends) {
    const int root = piece.root(facet[0]);
    mark<Element>(wall, facet, start[body.root(root)] == root ? boundary.start : boundary.end);
  }
  wall.spread_to_copies(boundary.start);
  wall.spread_to_copies(boundary.end);
}

}  // namespace

template <class Element>
FrameBoundary frame_boundary(const MeshOf<Element>& mesh, const PartOf<Element>& wall,
                             const std::vector<int>& wall_regions, const std::string& case_file) {
  const auto inner = inner_surface<Element>(mesh, wall_regions);
  FacetsOf<Element> ends;
  for (const auto& facet : group_facets(mesh, group::wall_ends))
    if (std::all_of(facet.begin(), facet.end(), [&](int node) { return wall.local_node[node] >= 0; }))
      ends.push_back(facet);

  std::vector<std::array<int, Element::dim>> others;
  const auto leave_out = [&](const FacetsOf<Element>& facets) {
    for (const auto& facet : facets) others.push_back(vertices_of<Element>(facet));
  };
  leave_out(inner);
  leave_out(ends);
  for (const auto& plane : symmetry_planes(mesh)) leave_out(plane.group->facets);
  std::sort(others.begin(), others.end());

  ConnectedNodes body(mesh.nodes.size());
  for (const auto& cell : wall.cells) {
    auto nodes = cell;
    for (int& node : nodes) node = wall.mesh_node[node];
    body.connect(nodes);
  }
  std::vector<int> bodies;
  for (int node : wall.mesh_node)
    if (body.root(node) == node && (bodies.empty() || bodies.back() != node)) bodies.push_back(node);

  FrameBoundary boundary;
  boundary.inner.assign(wall.nodes.size(), 0);
  boundary.outer = boundary.inner;
  std::map<int, bool> has_inner, has_outer;
  for (const auto& facet : inner) {
    mark<Element>(wall, facet, boundary.inner);
    has_inner[body.root(facet[0])] = true;
  }
  for (const auto& facet : boundary_facets(mesh, wall_regions))
    if (!std::binary_search(others.begin(), others.end(), vertices_of<Element>(facet.nodes))) {
      mark<Element>(wall, facet.nodes, boundary.outer);
      has_outer[body.root(facet.nodes[0])] = true;
    }
  for (int of : bodies)
    for (const auto& [known, name] : {std::pair{has_inner[of], "inner"}, std::pair{has_outer[of], "outer"}})
      if (!known)
        throw InputError(
            case_file, key,
            std::string("the frame \"laplace\" runs from the inner to the outer face of the wall, and it has "
                        "no ") +
                name + " face",
            std::string(name == std::string("inner") ? "name the inner face inner in the mesh, or "
                                                     : "leave a part of the boundary without a name, or ") +
                other_frame);
  wall.spread_to_copies(boundary.inner);
  wall.spread_to_copies(boundary.outer);
  if constexpr (Element::dim == 3) mark_ends<Element>(mesh, wall, ends, body, bodies, case_file, boundary);
  return boundary;
}

#define FSI_INSTANTIATE(Element)                                                                 \
  template FrameBoundary frame_boundary<Element>(const MeshOf<Element>&, const PartOf<Element>&, \
                                                 const std::vector<int>&, const std::string&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
