#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// How a .msh file is written.
struct GmshFormat {
  std::string version = "4.1";  ///< "4.1" or "2.2"
  bool binary = false;
  /// Tags of all physical groups by dimension and name, distinct in a dimension; empty: numbered from 1.
  std::map<std::pair<int, std::string>, int> tags = {};
};

/// Writes a mesh by the gmsh library: regions as physical volumes, facet groups as physical surfaces (in two dimensions
/// surfaces and curves). Nodes are numbered from 1 in the order of the mesh, elements from 1 group by group. Quadratic
/// cells and facets are gmsh's second-order elements (types 8, 9 and 11). The same mesh gives the same bytes. The file
/// appears complete or not at all (written beside, read back, then renamed). Not thread-safe: the library has one
/// global model. Throws InputError for an unknown version or a place that cannot be written.
template <int Dim, int Order>
void write_gmsh(const SimplexMesh<Dim, Order>& mesh, const std::filesystem::path& file, const GmshFormat& format);

}  // namespace fsi
