#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/flat_parts.hpp"

namespace fsi {

/// Of options --opening NAME=X,Y,Z. \throws InputError
std::vector<FlatPart> flat_parts_of(const std::vector<std::string>& options);

/// The points X,Y,Z of an option that is given any number of times, mm. \throws InputError
std::vector<Point> points_of(const std::string& option, const std::vector<std::string>& given);

/// Constants of a script, of options --set NAME=NUMBER. \throws InputError
std::map<std::string, double> numbers_of(const std::vector<std::string>& settings);

}  // namespace fsi
