#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace fsi {

/// A line of what --check prints: what it is about, and what is known of it.
struct DescriptionLine {
  std::string head, text;
};
using Description = std::vector<DescriptionLine>;

// What a case says, in words, for a look before a run. Units stand with the numbers.

/// "mm^3"; of plane scenes "mm^2".
const char* unit_of_volume(const Case& setup);

void describe_fluid(const Case& setup, Description& lines);
/// Density, bulk modulus and gravity of the wall, and whether it is alone; not its layers. No line without a wall.
void describe_wall(const Case& setup, Description& lines);
/// "neo-hookean, c10 = 3 kPa", defaults too.
std::string text_of_layer(const MaterialData& layer);
/// One line per opening. \param surfaces  of the mesh: openings that need not be there and are not have no line
void describe_openings(const Case& setup, const std::vector<std::string>& surfaces, Description& lines);
/// What holds and loads the wall. \param surfaces  of the mesh
void describe_supports(const Case& setup, const std::vector<std::string>& surfaces, Description& lines);
/// \param scheme  name of the time scheme; not used in statics
void describe_time(const Case& setup, const std::string& scheme, Description& lines);

/// One text: heads in a column of their own.
std::string text_of(const Description& lines);

}  // namespace fsi
