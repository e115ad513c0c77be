#include "scene/fibre_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "fem/elements.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "scene/cylindrical_wall.hpp"
#include "scene/vessel_ends.hpp"

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

/// Marks start and end among the connected pieces of the ends.
/// \param body     sets of nodes of the mesh that the wall's cells make
/// \param subject  what needs ends, for messages
template <class Element>
void mark_ends(const MeshOf<Element>& mesh, const PartOf<Element>& wall, const VesselFaces<Element>& faces,
               ConnectedNodes& body, const std::vector<int>& bodies, const std::string& case_file,
               const std::string& subject, FrameBoundary& boundary) {
  ConnectedNodes piece(mesh.nodes.size());
  for (const auto& facet : faces.ends) piece.connect(facet);
  std::map<int, double> area;  // per piece
  std::map<int, Point> moment;
  for (const auto& facet : faces.ends) {
    const int root = piece.root(facet[0]);
    const double size = area_of(mesh.nodes, facet);
    area[root] += size;
    for (int i = 0; i < 3; ++i) moment[root] = moment[root] + (size / 3) * mesh.nodes[facet[i]];
  }
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
          fmt::format("{} runs from one end of the wall to the others, and {} found on this wall: pieces of the "
                      "surface wall_ends, faces without a name that meet the inner face at an edge, planes of "
                      "symmetry across the vessel{}",
                      subject, count[of] == 1 ? "1 end is" : "0 ends are",
                      faces.unclear.empty() ? "" : "; " + faces.unclear),
          fmt::format("name two or more end faces of the wall wall_ends in the mesh{}, or {}",
                      faces.unclear.empty() ? "" : " and planes of symmetry symmetry", other_frame));
  for (const auto& [root, size] : area)
    (start[body.root(root)] == root ? boundary.from : boundary.to).push_back((1 / size) * moment[root]);
  boundary.start.assign(wall.nodes.size(), 0);
  boundary.end = boundary.start;
  for (const auto& facet : faces.ends) {
    const int root = piece.root(facet[0]);
    mark<Element>(wall, facet, start[body.root(root)] == root ? boundary.start : boundary.end);
  }
  wall.spread_to_copies(boundary.start);
  wall.spread_to_copies(boundary.end);
}

std::string text_of(const std::vector<Point>& places) {
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i)
    text += (i == 0 ? "" : i + 1 < places.size() ? ", " : " and ") + place_of(places[i]);
  return text;
}

/// "the axis through (0, 0, 0) mm along (0, 0, 1)"
template <class Element>
std::string text_of_axis(const StructureData& data) {
  if (Element::axisymmetric) return "the axis of the body of revolution";
  const auto& d = Element::dim == 3 ? data.axis_direction : Point{0, 0, 1};
  return fmt::format("the axis through {} along ({:g}, {:g}, {:g})", place_of(data.axis_origin), d[0], d[1], d[2]);
}

}  // namespace

template <class Element>
FrameBoundary frame_boundary(const MeshOf<Element>& mesh, const PartOf<Element>& wall,
                             const WallFacets<Element>& facets, const std::string& case_file,
                             const std::string& subject) {
  const VesselFaces<Element> faces = vessel_faces<Element>(mesh, facets);
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
  for (const auto& facet : faces.inner) {
    mark<Element>(wall, facet, boundary.inner);
    has_inner[body.root(facet[0])] = true;
  }
  for (const auto& facet : faces.outer) {
    mark<Element>(wall, facet, boundary.outer);
    has_outer[body.root(facet[0])] = true;
  }
  for (int of : bodies)
    for (const auto& [known, name] : {std::pair{has_inner[of], "inner"}, std::pair{has_outer[of], "outer"}})
      if (!known)
        throw InputError(
            case_file, key,
            fmt::format("{} runs from the inner to the outer face of the wall, and it has no {} face", subject, name),
            std::string(name == std::string("inner") ? "name the inner face inner in the mesh, or "
                                                     : "leave a part of the boundary without a name, or ") +
                other_frame);
  wall.spread_to_copies(boundary.inner);
  wall.spread_to_copies(boundary.outer);
  if constexpr (Element::dim == 3) mark_ends<Element>(mesh, wall, faces, body, bodies, case_file, subject, boundary);
  return boundary;
}

template <class Element>
WallFrame wall_frame(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& wall,
                     const std::vector<int>& wall_regions) {
  const StructureData& data = *setup.structure;
  const std::string axis = text_of_axis<Element>(data);
  const auto facets = wall_boundary<Element>(mesh, wall_regions);
  WallFrame frame;
  const auto take_cylinder = [&](const std::string& why) {
    frame.kind = FibreFrame::cylinder;
    frame.remark = fmt::format("{} = cylinder: {}", key, why);
  };
  const auto take_own = [&](const std::string& subject, const std::string& why) {
    const FrameBoundary boundary = frame_boundary<Element>(mesh, wall, facets, setup.path.string(), subject);
    frame.fields = frame_fields<Element>(wall, boundary);
    frame.kind = FibreFrame::laplace;
    frame.remark = fmt::format("{} = laplace: {}", key, why);
    if (!boundary.from.empty())
      frame.remark += fmt::format(", from {} to {}", text_of(boundary.from), text_of(boundary.to));
  };
  if (data.fibre_frame == FibreFrame::laplace) {
    take_own("the frame \"laplace\"", "fibres follow the wall's own frame");
    return frame;
  }
  const bool is_about_axis = is_cylinder<Element>(mesh, facets, {data.axis_origin, data.axis_direction});
  if (data.fibre_frame == FibreFrame::cylinder) {
    take_cylinder(fmt::format("fibres lie about {}{}", axis,
                              is_about_axis ? "" : ", as the case says, though the wall is no cylinder about it"));
    return frame;
  }
  if (is_about_axis) {
    take_cylinder("the case names none, and the wall is a cylinder about " + axis);
    return frame;
  }
  try {
    take_own(
        fmt::format("no frame is named, and the wall is no cylinder about {}; its own frame", axis),
        fmt::format("the case names none, and the wall is no cylinder about {}: fibres follow its own frame", axis));
  } catch (const InputError& error) {
    if (!data.axis_is_named) throw;
    take_cylinder(fmt::format("the case names an axis but no frame, and the wall has no frame of its own"));
    frame.notice = fmt::format(
        "{}: fibres lie about {}, though the wall is no cylinder about it, since a frame of its own "
        "cannot be found; name the frame, or see to what that needs [{}]",
        key, axis, error.what());
  }
  return frame;
}

#define FSI_INSTANTIATE(Element)                                                                                      \
  template FrameBoundary frame_boundary<Element>(const MeshOf<Element>&, const PartOf<Element>&,                      \
                                                 const WallFacets<Element>&, const std::string&, const std::string&); \
  template WallFrame wall_frame<Element>(const Case&, const MeshOf<Element>&, const PartOf<Element>&,                 \
                                         const std::vector<int>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
