#pragma once

#include <string>
#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// Thicknesses of a wall at points: on the lumen's surface, or along its centre line.
struct ThicknessTable {
  std::string file;            ///< for messages
  std::vector<Point> places;   ///< mm
  std::vector<double> values;  ///< mm
  std::string length_unit{};   ///< of the places in the file, if its header names one
  std::string unit{};          ///< of the values in the file, likewise
};

/// Units of length of a table whose header names none. Empty: mm; of places that of the values.
struct ThicknessUnits {
  std::string values, places;
};
/// Multiplies places and values of units that the header does not name.
/// \throws InputError for a unit that is not the one in the header
void bring_to_mm(ThicknessTable& table, const ThicknessUnits& units);

/// A sentence about thicknesses that no vessel's wall has beside its radius, with the unit that would explain them;
/// else empty.
/// \param thickness  per node, mm
std::string thickness_slip(const TriangleSurface& surface, const std::vector<double>& thickness);

/// The table in a text of comma-separated columns with a line of names: x, y, z and `column`, in mm or in the units
/// behind these names.
/// \throws InputError saying of `file`, with the line: a column that is missing, and what is no number. A value that is
///         no finite number above 0 is a hole in the table: thickness_at() refuses it where it is needed.
ThicknessTable thickness_table(const std::string& text, const std::string& column, const std::string& file);

/// The wall's thickness at each node of a lumen's surface, mm: the mean of the table's four nearest points, weighted by
/// their inverse squared distances, then averaged with neighbours'.
/// \param passes  of averaging
/// \throws InputError for a hole in the table, with the place: a node whose nearest point has no thickness above 0, or
///         is too far away. Points that are on the surface must be within three times their own distance from each
///         other, or two of the surface's edges; others within 1.5 times the local radius.
std::vector<double> thickness_at(const TriangleSurface& surface, const ThicknessTable& table, int passes);

}  // namespace fsi
