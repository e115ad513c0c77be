#include "meshes/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/error.hpp"

namespace fsi {

namespace {

FlatPart flat_part_of(const std::string& text) {
  const auto refuse = [&] {
    throw InputError("--opening", text, "is no NAME=X,Y,Z",
                     "write, for one, --opening inlet=0,0,0, a point near its middle");
  };
  const auto equals = text.find('=');
  FlatPart part{text.substr(0, equals), {}};
  if (equals == std::string::npos || part.name.empty() || std::count(text.begin(), text.end(), ',') != 2) refuse();
  std::size_t from = equals + 1;
  for (double& coordinate : part.at) {
    const auto comma = std::min(text.find(',', from), text.size());
    if (!CLI::detail::lexical_cast(text.substr(from, comma - from), coordinate)) refuse();
    from = comma + 1;
  }
  return part;
}

}  // namespace

std::vector<FlatPart> flat_parts_of(const std::vector<std::string>& options) {
  std::vector<FlatPart> parts;
  for (const auto& text : options) parts.push_back(flat_part_of(text));
  return parts;
}

}  // namespace fsi
