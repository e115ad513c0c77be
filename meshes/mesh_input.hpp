#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesh_io/gmsh_reader.hpp"

namespace fsi {

/// A file's mesh, and what the mesh does not keep of the file.
struct ReadMesh {
  AnyMesh mesh;
  TriangleGeometry plane;                           ///< where triangles lie
  std::map<std::pair<int, std::string>, int> tags;  ///< of physical groups, by dimension and name
  std::size_t left_out = 0;                         ///< cells in no physical group with a name
};

/// What a .msh file holds, before its mesh is made.
struct MeshLayout {
  int dimension = 3, order = 1;
  std::vector<std::string> regions;  ///< names of its volumes, of triangles its surfaces
  TriangleGeometry plane = TriangleGeometry::plane;
  std::map<std::pair<int, std::string>, int> tags;  ///< as of ReadMesh
  std::size_t cells = 0;                            ///< of the dimension, named or not
};

/// \throws InputError for a script, a file that cannot be parsed, and one that names no volume and no surface
MeshLayout mesh_layout(const std::string& file);

/// The mesh of a .msh file, with all of its named physical groups; cells keep the file's order.
/// \throws InputError for a script, and for what read_gmsh() refuses
ReadMesh read_mesh_file(const std::string& file);

/// Warns of elements of surfaces that are no facet of a cell, in the words of FacetGroup::astray.
void warn_of_astray(const std::string& file, const std::string& surface, const std::string& astray);
template <int Dim, int Order>
void warn_of_astray(const std::string& file, const SimplexMesh<Dim, Order>& mesh) {
  for (const auto& group : mesh.facet_groups) warn_of_astray(file, group.name, group.astray);
}
/// The same, and of cells that the mesh leaves out.
void warn_of_left_out(const std::string& file, const ReadMesh& mesh);

}  // namespace fsi
