#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Contents of a file of VTK's XML formats, .vtu or .vtp: all pieces, one after the other. Of .vtp only the polygons.
struct VtkMesh {
  struct Array {
    std::string name;
    bool of_cells = false;
    bool of_numbers = true;
    int components = 1;
    std::vector<double> values;  ///< empty if it was not asked for or has no numbers
    int pieces = 0;              ///< that have it
  };
  bool is_surface = false;  ///< .vtp
  std::vector<Point> nodes;
  std::vector<std::vector<int>> cells;  ///< nodes of each
  std::vector<int> kinds;               ///< VTK's number of each cell's kind; 7, a polygon, in .vtp
  std::vector<Array> arrays;
  int pieces = 0;
  std::int64_t lines = 0, strips = 0;  ///< what else a surface has: vertices and lines, strips of triangles
};

/// Whether an array's numbers are read, by all that is known of it before.
using VtkWanted = std::function<bool(const VtkMesh::Array&)>;

/// Reads arrays as text, base64 or raw, packed by zlib, by LZMA or not, of either order of bytes.
/// \param text  the whole file \param file  for messages
/// \param wanted  unless given all arrays of numbers are read
/// \throws InputError for what is damaged or in another form
VtkMesh read_vtk(const std::string& text, const std::string& file, const VtkWanted& wanted = {});

}  // namespace fsi
