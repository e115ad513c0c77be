#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/flat_parts.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Fills a lumen's closed surface of triangles with tetrahedra, by the gmsh library; the surface stays as it is.
///
/// Surfaces of the result are the file's physical groups (.msh), and the openings, flat parts of the surface.
/// \param surface  .stl, .msh, or any other surface that gmsh reads
/// \throws InputError for a file that is missing or holds no triangles; a surface with holes or with edges where more
///         than two triangles meet; what name_flat_parts() refuses; no opening at all, with the places of flat parts; a
///         surface that gmsh cannot fill
TetrahedralMesh fill_lumen(const std::filesystem::path& surface, const std::vector<FlatPart>& openings);

/// Fills what triangles enclose together; they stay as they are.
/// \param nodes     mm
/// \param surfaces  of which each edge has two triangles in all; those of a surface without a name are in no group of
///                  the result, whose volume is `fluid`
/// \throws InputError saying of `file` that gmsh cannot fill them
TetrahedralMesh fill_surface(const std::vector<Point>& nodes, const std::vector<TetrahedralMesh::FacetGroup>& surfaces,
                             const std::string& file);

}  // namespace fsi
