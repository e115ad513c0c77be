#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A field as a file gives it: values at places, and between them the cells of the file's mesh, if it has one.
struct FieldSamples {
  std::vector<Point> places;   ///< where there is a value: points, or centres of cells; mm
  std::vector<double> values;  ///< per place
  std::vector<Point> nodes;    ///< of the cells below
  /// Tetrahedra, or triangles whose last number is -1, as nodes. Cells of other kinds are not kept.
  std::vector<std::array<int, 4>> cells;
  std::vector<int> place_of_cell;  ///< of a field of cells; empty: the values belong to the nodes
};

/// A field of a file: `.csv` with columns x, y, z (mm) and `field`; `.vtu` and `.vtp` of VTK with an array of that name at
/// points or cells.
/// \throws InputError saying of the file what is wrong: missing, of another kind, damaged, without such a field
FieldSamples read_field_samples(const std::filesystem::path& file, const std::string& field);

/// The surface of a file by its triangles: `.vtp` or `.stl`, text or binary. \throws InputError likewise
struct PaintedSurface {
  std::vector<Point> nodes;  ///< mm
  std::vector<std::array<int, 3>> triangles;
};
PaintedSurface read_painted_surface(const std::filesystem::path& file);

/// A file as one text. \param kinds  the remedy for one that is missing \throws InputError also for one that is no regular file
std::string text_of_file(const std::filesystem::path& file, const std::string& kinds);

}  // namespace fsi
