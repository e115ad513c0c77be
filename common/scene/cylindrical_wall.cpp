#include "scene/cylindrical_wall.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "fem/elements.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double roundness = 0.04;  // 12 elements around, refined: new vertices at cos(pi/12) = 1 - 0.034 of the radius
constexpr double half_turned =
    0.5;  // cosine of the angle to the radius from which a face looks along the axis or around

/// Distances of a face's vertices from the axis, mm.
struct RadiusRange {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;

  void add(double radius) {
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  bool empty() const { return smallest > largest; }
  bool is_one() const { return empty() || largest - smallest <= roundness * largest; }
};

/// Faces of a connected piece that look to the axis, away from it, and elsewhere.
struct BodyFaces {
  RadiusRange inward, outward, aside;

  bool are_a_cylinders() const {
    if (inward.empty() && outward.empty()) return false;
    if (!inward.is_one() || !outward.is_one()) return false;
    if (aside.empty()) return true;
    const bool within = outward.empty() || aside.largest <= (1 + roundness) * outward.largest;
    return within && (inward.empty() || aside.smallest >= (1 - roundness) * inward.smallest);
  }
};

}  // namespace

template <class Element>
bool is_cylinder(const MeshOf<Element>& mesh, const WallFacets<Element>& boundary, Axis axis) {
  if (Element::dim == 2) axis.direction = {0, 0, 1};
  if (Element::axisymmetric) axis.origin = {0, 0, 0};
  const AxisFrame frame(axis);
  std::map<int, BodyFaces> bodies;
  for (const auto& facet : boundary) {
    BodyFaces& faces = bodies[facet.body];
    if (facet.kind != WallFacetKind::inner && facet.kind != WallFacetKind::other) continue;
    Point middle{0, 0, 0};
    for (int i = 0; i < Element::dim; ++i) middle = middle + (1.0 / Element::dim) * mesh.nodes[facet.nodes[i]];
    const Point radial = middle - frame.origin - frame.axial(middle) * frame.along;
    const double length = norm(radial), cosine = length > 0 ? dot(facet.normal, radial) / length : 0;
    RadiusRange& range = cosine < -half_turned ? faces.inward : cosine > half_turned ? faces.outward : faces.aside;
    for (int i = 0; i < Element::dim; ++i) range.add(frame.radius(mesh.nodes[facet.nodes[i]]));
  }
  return std::all_of(bodies.begin(), bodies.end(), [](const auto& body) { return body.second.are_a_cylinders(); });
}

#define FSI_INSTANTIATE(Element) \
  template bool is_cylinder<Element>(const MeshOf<Element>&, const WallFacets<Element>&, Axis);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
