#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/edge_curves.hpp"
#include "mesher/prism_columns.hpp"

namespace fsi {

/// Warnings that follow a report.
using MeshWarnings = std::vector<std::string>;

/// The curved edges of a lumen of straight ones: those of its surface (mesher/surface/smooth_edges.hpp), and those
/// below in layers along it (mesher/curved_columns.hpp). Where cells would fold they are left straight.
/// \param on        the surface, as WallGrowth::on
/// \param layers    of columns that end on the surface; none where it is empty
/// \param said      gets sentences, each a line
/// \param warnings  gets where edges are left straight
EdgeCurves curves_of_lumen(const TetrahedralMesh& lumen, const std::string& on, const Levels& layers, std::string& said,
                           MeshWarnings& warnings);

/// Warns of edges that are left straight, since cells would fold.
void add_straightened(const std::vector<Point>& middles, const std::string& whose, MeshWarnings& warnings);

/// The sentence on how the shape of the lumen changed, ended by a newline.
std::string changed_volume(const std::string& before_text, double before, const std::string& after_text, double after);

/// The volume of the straight cells, mm^3.
double straight_volume(const TetrahedralMesh& lumen);

}  // namespace fsi
