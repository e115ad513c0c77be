#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A field as a file gives it: values at places, and the cells of the file's mesh, if it has one.
struct FieldSamples {
  std::vector<Point> places;   ///< where there is a value: points, or centres of cells; mm
  std::vector<double> values;  ///< per place
  std::vector<Point> nodes;    ///< of the cells below
  /// Tetrahedra, or triangles whose last number is -1, as nodes. Cells of other kinds are not kept.
  std::vector<std::array<int, 4>> cells;
  std::vector<int> place_of_cell;  ///< of a field of cells: the place of each cell above; else empty
};

/// A field of a file: `.csv` with columns x, y, z and `field` (point_table.hpp); `.vtu` and `.vtp` of VTK with an array
/// of that name at points or cells.
/// \throws InputError saying of the file what is wrong: missing, of another kind, damaged, without such a field
FieldSamples read_field_samples(const std::filesystem::path& file, const std::string& field);

/// A surface of triangles.
struct PaintedSurface {
  std::vector<Point> nodes;  ///< mm
  std::vector<std::array<int, 3>> triangles;
};
/// Of a file: `.vtp`, whose polygons are cut into triangles, or `.stl`, text or binary. \throws InputError likewise
PaintedSurface read_painted_surface(const std::filesystem::path& file);

/// A file as one text. \param kinds  remedy of the message for a file that is missing
/// \throws InputError also for one that is no regular file, or has more than 4 GiB
std::string text_of_file(const std::filesystem::path& file, const std::string& kinds);

}  // namespace fsi
