#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Contents of a file of VTK's XML formats, .vtu or .vtp: all pieces, one after the other. Of .vtp only the polygons.
struct VtkMesh {
  struct Array {
    std::string name;
    bool of_cells = false;
    int components = 1;
    std::vector<double> values;
  };
  std::vector<Point> nodes;
  std::vector<std::vector<int>> cells;  ///< nodes of each
  std::vector<int> kinds;               ///< VTK's number of each cell's kind; 7, a polygon, in .vtp
  std::vector<Array> arrays;
};

/// Reads arrays as text, base64 or raw, packed by zlib or not, in little-endian order.
/// \param text  the whole file \param file  for messages \throws InputError for what is damaged or in another form
VtkMesh read_vtk(const std::string& text, const std::string& file);

}  // namespace fsi
