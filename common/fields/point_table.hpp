#pragma once

#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Values at points.
struct PointTable {
  std::vector<Point> places;   ///< mm
  std::vector<double> values;  ///< per place; NaN: an empty cell
  std::string unit{};          ///< of the values, as the header says it; empty: it does not
  std::string length_unit{};   ///< that the coordinates were in, likewise
};

/// Reads comma-separated columns with a line of names: x, y, z in mm and `column`; others are skipped. A unit may stand
/// behind a name, `x_cm` or `x [cm]`: coordinates are converted to mm, values stay as they are.
/// \param file    for messages
/// \param remedy  for a value that is no number, "give it in mm"
/// \throws InputError with file and line: a column is missing, a field is no number, there are fewer than two points
PointTable point_table(const std::string& text, const std::string& column, const std::string& file,
                       const std::string& remedy);

/// Points of a line as such a table has them in x, y and z, in its order. \throws InputError likewise
/// \param length_unit  set to what the header says the coordinates were in; empty: it does not
std::vector<Point> polyline_of(const std::string& text, const std::string& file, std::string& length_unit);

}  // namespace fsi
