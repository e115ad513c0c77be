#pragma once

#include <vector>

#include "mesh/submesh.hpp"

namespace fsi {

/// Points along a curve.
struct CurvePoints {
  std::vector<Point> at;  ///< mm
  std::vector<double> s;  ///< arc length from the first, mm
};

/// The centre line of a tube from one opening to another, evenly spaced by arc length. It joins the centroids of the
/// surfaces on which the harmonic coordinate between the openings is constant, smoothly (SmoothCurve). About as many
/// surfaces are cut as edges of mean length fit along it. Of a surface in several pieces that with the greatest flux
/// counts, so that dead ends and side branches do not pull. Exact for straight tubes and rings but for the error of
/// linear elements; where a tube branches, a curve near the middle.
/// \param part    the fluid
/// \param from    facets of the opening where it begins, in the part's node numbers
/// \param count   of points, at least 2
/// \param turned  whether triangles stand for the body that they are turned out of: the centroids lie on its axis
/// \throws ConvergenceError when there is none: the part does not connect the openings
template <int Dim, int Order>
CurvePoints centre_line(const Submesh<Dim, Order>& part, const std::vector<typename Submesh<Dim, Order>::Facet>& from,
                        const std::vector<typename Submesh<Dim, Order>::Facet>& to, int count, bool turned = false);

}  // namespace fsi
