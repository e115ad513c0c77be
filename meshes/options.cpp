#include "meshes/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/error.hpp"

namespace fsi {

namespace {

/// X,Y,Z; false when the text says something else.
bool read_point(const std::string& text, Point& point) {
  if (std::count(text.begin(), text.end(), ',') != 2) return false;
  std::size_t from = 0;
  for (double& coordinate : point) {
    const auto comma = std::min(text.find(',', from), text.size());
    if (!CLI::detail::lexical_cast(text.substr(from, comma - from), coordinate)) return false;
    from = comma + 1;
  }
  return true;
}

FlatPart flat_part_of(const std::string& text) {
  const auto equals = text.find('=');
  FlatPart part{text.substr(0, equals), {}};
  if (equals == std::string::npos || part.name.empty() || !read_point(text.substr(equals + 1), part.at))
    throw InputError("--opening", text, "is no NAME=X,Y,Z", "write, for one, --opening inlet=0,0,0, a point on it");
  return part;
}

}  // namespace

std::vector<FlatPart> flat_parts_of(const std::vector<std::string>& options) {
  std::vector<FlatPart> parts;
  for (const auto& text : options) parts.push_back(flat_part_of(text));
  return parts;
}

std::vector<Point> points_of(const std::string& option, const std::vector<std::string>& given) {
  std::vector<Point> points;
  for (const auto& text : given)
    if (!read_point(text, points.emplace_back()))
      throw InputError(option, text, "is no X,Y,Z", "write, for one, " + option + " 0,0,0, a point on it");
  return points;
}

std::map<std::string, double> numbers_of(const std::vector<std::string>& settings) {
  std::map<std::string, double> numbers;
  for (const auto& text : settings) {
    const auto equals = text.find('=');
    double value = 0;
    if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), value))
      throw InputError("--set", text, "is no name=number", "write, for one, --set size=0.2");
    numbers[text.substr(0, equals)] = value;
  }
  return numbers;
}

}  // namespace fsi
