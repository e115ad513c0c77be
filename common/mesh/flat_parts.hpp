#pragma once

#include <string>
#include <vector>

#include "mesh/flat_regions.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A point for messages, "(0, 0, 5) mm"; what is zero to rounding is shown as zero.
std::string place_of(const Point& at);

/// A unit normal for messages, "(0, 0, 1)", likewise.
std::string text_of_normal(const Point& normal);

/// A flat part of a lumen's surface that is to have a name.
struct FlatPart {
  std::string name;
  Point at;  ///< mm, on it
};

/// Adds a facet group for each of `wanted`: the flat part of the fluid's boundary (mesh/flat_regions.hpp) on which its
/// point lies, within the mean length of the part's edges.
/// \throws InputError for a mesh without a volume `fluid`, for a point on no flat part (naming the nearest), for two
///         points on one part, and for a name that a surface has
template <int Order>
void name_flat_parts(SimplexMesh<3, Order>& mesh, const std::vector<FlatPart>& wanted);

/// The flat parts of the fluid's boundary of which less than half is in named surfaces or sides of other volumes,
/// largest first. Triangles are indices into boundary_facets() of the fluid.
/// \throws InputError for a mesh without a volume `fluid`
template <int Order>
std::vector<FlatRegion> unnamed_flat_parts(const SimplexMesh<3, Order>& mesh);

/// Names these parts end_1, end_2 and so on, but for names that are taken. \return a sentence on what was named
/// \throws InputError where there is none, and for a mesh without a volume `fluid`
template <int Order>
std::string name_flat_ends(SimplexMesh<3, Order>& mesh);

/// Refuses a mesh in which a flat part is neither in a named surface nor `closed`: it may be an opening that was
/// forgotten. The surface `inner` is no name here, since the wall grows on it.
/// \param closed  points on flat parts that are no openings, mm
/// \throws InputError that lists the parts with place, normal and area, and for a point that is on no flat part
template <int Order>
void require_flat_parts_named(const SimplexMesh<3, Order>& mesh, const std::vector<Point>& closed);

/// Places, normals and areas of all flat parts of the fluid's boundary, of six at most, for messages.
/// \throws InputError for a mesh without a volume `fluid`
template <int Order>
std::string places_of_flat_parts(const SimplexMesh<3, Order>& mesh);

}  // namespace fsi
