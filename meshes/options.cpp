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

/// NUMBER or X,Y,Z; false when the text says something else.
bool read_choice(const std::string& text, OpeningChoice& choice) {
  return read_point(text, choice.at) || (CLI::detail::lexical_cast(text, choice.number) && choice.number > 0);
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

OpeningChoice opening_choice_of(const std::string& text) {
  const auto equals = text.find('=');
  OpeningChoice choice{text.substr(0, equals)};
  if (equals == std::string::npos || choice.name.empty() || !read_choice(text.substr(equals + 1), choice))
    throw InputError("--opening", text, "is no NAME=NUMBER and no NAME=X,Y,Z",
                     "write, for one, --opening inlet=1; --list-openings shows the numbers");
  return choice;
}

OpeningChoice closed_choice_of(const std::string& text) {
  OpeningChoice choice{""};
  if (!read_choice(text, choice))
    throw InputError("--closed", text, "is no NUMBER and no X,Y,Z",
                     "write, for one, --closed 3; --list-openings shows the numbers");
  return choice;
}

std::vector<std::pair<std::string, double>> lengths_of(const std::string& option,
                                                       const std::vector<std::string>& given) {
  std::vector<std::pair<std::string, double>> lengths;
  for (const auto& text : given) {
    const auto equals = text.find('=');
    double length = 0;
    if (equals == std::string::npos || equals == 0 || !CLI::detail::lexical_cast(text.substr(equals + 1), length) ||
        !(length > 0 && length < 1e6))
      throw InputError(option, text, "is no NAME=LENGTH with a length above 0",
                       "write, for one, " + option + " inlet=2");
    const std::string name = text.substr(0, equals);
    for (const auto& [known, unused] : lengths)
      if (known == name) throw InputError(option, text, name + " is given twice", "give it once");
    lengths.emplace_back(name, length);
  }
  return lengths;
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
