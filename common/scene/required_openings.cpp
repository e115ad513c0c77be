#include "scene/required_openings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/openings.hpp"

namespace fsi {

std::vector<std::string> required_openings(const Case& setup, const std::vector<std::string>& surfaces,
                                           const std::string& mesh) {
  std::vector<std::string> names;
  bool determined = setup.structure.has_value();
  for (const auto& opening : openings_of(setup)) {
    const bool found = std::find(surfaces.begin(), surfaces.end(), opening.surface) != surfaces.end();
    if (!found && opening.demanded)
      throw InputError(setup.path.string(), "opening." + opening.surface,
                       fmt::format("the mesh {} has no such surface on the volumes of the scene", mesh),
                       surfaces.empty() ? "name the surface in the mesh" : name_remedy(opening.surface, surfaces));
    if (!found) continue;
    names.push_back(opening.surface);
    determined = determined || !opening.flow_rate;
  }
  if (!determined && names.empty() && is_closed(setup))
    throw InputError(setup.path.string(), "fluid.closed",
                     "a closed fluid between rigid walls: nothing can move it, and its pressure has no level",
                     "add [structure], or an [[opening]] with a pressure");
  if (!determined)
    throw InputError(setup.path.string(), "opening",
                     "the flow is given at every opening of a fluid between rigid walls, which leaves its pressure "
                     "undetermined, and no solution unless the flows add up to zero",
                     "give one opening a pressure, a resistance or a windkessel, or nothing: free of traction");
  return names;
}

}  // namespace fsi
