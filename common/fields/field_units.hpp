#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fields/field_samples.hpp"

namespace fsi {

/// A unit of length in mm, by its word: mm, cm, m, um or in. Empty: there is none of this name.
std::optional<double> length_unit(const std::string& word);
/// "mm, cm, m, um or in", for messages.
std::string known_length_units();

/// Units that a file itself says.
struct UnitsOfFile {
  std::string places;  ///< that its coordinates were in, before they were brought to mm; empty: it says none
  std::string values;  ///< that its values are in; empty: it says none
};

/// read_field_samples(), and the units in the header of a table: `x_cm`, `x [cm]`, `young [dyn/cm2]`.
FieldSamples read_field_samples(const std::filesystem::path& file, const std::string& field, UnitsOfFile& units);

/// The unit of length that explains why points and places in mm do not meet: the largest that brings 95 % of the points
/// into the box around the places, and spreads them over 0.3 of its diagonal or more. Empty: none does, or mm do.
struct LengthSlip {
  std::string unit;
  double factor;  ///< mm
};
std::optional<LengthSlip> length_slip(const std::vector<Point>& points, const std::vector<Point>& places);
/// The same for a field: the smallest with which 95 % of the places are near enough to a point, where in mm they are
/// not.
/// \param distance  from a place to the nearest point as the file has it
/// \param within    mm, how far that may be; 0: as far as `spacing`, in the file's unit
std::optional<LengthSlip> length_slip(const std::vector<Point>& places,
                                      const std::function<double(const Point&)>& distance, double within,
                                      double spacing);

}  // namespace fsi
