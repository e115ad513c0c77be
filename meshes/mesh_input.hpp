#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/geo_script.hpp"

namespace fsi {

/// A file's mesh, and what of the file the mesh does not know.
struct ReadMesh {
  AnyMesh mesh;
  TriangleGeometry plane;  ///< where triangles lie
  std::map<std::pair<int, std::string>, int> tags;
  std::size_t left_out = 0;  ///< cells in no physical group with a name
};

/// What a .msh file holds, before its mesh is made.
struct MeshLayout {
  int dimension = 3, order = 1;
  std::vector<std::string> regions;  ///< names of its volumes, of triangles its surfaces
  TriangleGeometry plane = TriangleGeometry::plane;
  std::map<std::pair<int, std::string>, int> tags;
  std::size_t cells = 0;  ///< of the dimension, named or not
};

/// \throws InputError for a script, a file that cannot be parsed, and one that names no volume and no surface
MeshLayout mesh_layout(const std::string& file);

/// The mesh of a .msh file: all of its physical groups, in the order of its cells.
/// \throws InputError for a script, and for what read_gmsh() refuses
ReadMesh read_mesh_file(const std::string& file);

/// Says on the error stream what of the file the mesh does not have.
void warn_of_left_out(const std::string& file, const ReadMesh& mesh);

}  // namespace fsi
