#pragma once

#include <vector>

#include "mesh/submesh.hpp"
#include "mesh/symmetry_planes.hpp"

namespace fsi {

/// Points along a curve.
struct CurvePoints {
  std::vector<Point> at;  ///< mm
  std::vector<double> s;  ///< arc length from the first, mm
};

/// The centre line of a tube from one opening to another, evenly spaced by arc length: a smooth curve (SmoothCurve)
/// through the centroids of the surfaces on which the harmonic coordinate between the openings is constant. About as
/// many surfaces are cut as edges of mean length fit along it. Of a surface in several pieces the one with the greatest
/// flux counts, so that dead ends and side branches do not pull. Exact for straight tubes and rings but for the error
/// of linear elements; where a tube branches, a curve near the middle.
/// \param part    the fluid
/// \param from    facets of the opening where it begins, in the part's node numbers
/// \param to      facets of the opening where it ends
/// \param count   number of points, at least 2
/// \param turned  whether triangles stand for a body of revolution: the centroids then lie on its axis
/// \param planes  of symmetry, in the part's node numbers. A surface that reaches some has the centroid of itself with
///                its images: that projected onto them
/// \throws ConvergenceError if the part does not connect the openings, or harmonic_coordinate() does
template <int Dim, int Order>
CurvePoints centre_line(const Submesh<Dim, Order>& part, const std::vector<typename Submesh<Dim, Order>::Facet>& from,
                        const std::vector<typename Submesh<Dim, Order>::Facet>& to, int count, bool turned = false,
                        const std::vector<MirrorPlane>& planes = {});

}  // namespace fsi
