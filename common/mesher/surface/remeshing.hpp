#pragma once

#include <string>
#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// A surface of triangles whose edges are of one length: edges are split, collapsed and flipped, nodes moved along the
/// surface and projected onto what it was, by CGAL's isotropic remeshing [Botsch2004]. Nodes of rims stay on the rims.
/// \param edge  mm
/// \throws InputError saying of `file` that the result folds over or cuts itself, with the place
TriangleSurface remeshed(const TriangleSurface& surface, double edge, const std::string& file);

/// The same with lengths that vary. The surface is taken apart into bands of lengths within a factor of 1.25, each of
/// which is remeshed to its mean; three times, with shifted bands in between, so that no line between bands stays.
/// Lengths change by no more than 0.3 of the way along the surface.
/// \param edges  mm, per node of the surface
TriangleSurface remeshed(const TriangleSurface& surface, std::vector<double> edges, const std::string& file);

/// Triangles that fill a flat rim, normals away from the surface. Their inner nodes, as far apart as those of the rim,
/// are added to the surface, the triangles are not.
/// \throws InputError saying of `file` that the rim cannot be filled, with the place
std::vector<SurfaceTriangle> flat_cap(TriangleSurface& surface, const std::vector<int>& rim, const std::string& file);

/// Closes a hole smoothly, as the surface around it bends [Liepa2003].
/// \throws InputError likewise
void close_hole(TriangleSurface& surface, const std::vector<int>& rim, const std::string& file);

/// Refuses a surface of which two triangles cut each other, with the number of such pairs and the place of the first.
/// \param remedy  for the message
/// \throws InputError saying it of `file`
void require_no_cuts(const TriangleSurface& surface, const std::string& file, const std::string& remedy);

}  // namespace fsi
