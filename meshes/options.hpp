#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/flat_parts.hpp"
#include "mesher/surface/lumen_openings.hpp"

namespace fsi {

/// The values of options --opening NAME=X,Y,Z. \throws InputError
std::vector<FlatPart> flat_parts_of(const std::vector<std::string>& options);

/// The points X,Y,Z of an option that is given any number of times, mm. \throws InputError
std::vector<Point> points_of(const std::string& option, const std::vector<std::string>& given);

/// NAME=NUMBER or NAME=X,Y,Z of an option --opening. \throws InputError
OpeningChoice opening_choice_of(const std::string& text);

/// NUMBER or X,Y,Z of an option --closed. \throws InputError
OpeningChoice closed_choice_of(const std::string& text);

/// The values of options NAME=LENGTH, positive lengths below 1e6. \throws InputError, also for a name twice
std::vector<std::pair<std::string, double>> lengths_of(const std::string& option,
                                                       const std::vector<std::string>& given);

/// Constants of a script, of options --set NAME=NUMBER. \throws InputError
std::map<std::string, double> numbers_of(const std::vector<std::string>& settings);

}  // namespace fsi
