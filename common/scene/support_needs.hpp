#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/case.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mesh_checks.hpp"

namespace fsi {

/// What the supports of a case ask of its mesh.
/// \param mesh_name  for the message
/// \throws InputError for a surface that the mesh does not have
template <class Mesh>
void need_supports(const Case& setup, const Mesh& mesh, const std::string& mesh_name, SceneMeshNeeds& needs) {
  if (setup.supports.count(group::wall_ends) > 0) needs.holding = needs.clamping = {};
  std::vector<std::string> names;
  for (const auto& group : mesh.facet_groups) names.push_back(group.name);
  for (const auto& entry : setup.supports) {
    const std::string& surface = entry.first;
    const SupportData& support = entry.second;
    if (std::find(names.begin(), names.end(), surface) == names.end())
      throw InputError(setup.path.string(), "support." + surface, "the mesh " + mesh_name + " has no such surface",
                       names.empty() ? "name it in the mesh" : name_remedy(surface, names));
    needs.supports.push_back(surface);
    if (support.holds()) needs.holding.push_back(surface);
    const auto fixes = [&](const char* name) {
      return support.fixed && std::find(support.fixed->begin(), support.fixed->end(), name) != support.fixed->end();
    };
    const bool clamped = setup.geometry == Geometry::axisymmetric ? fixes("r") && fixes("z")
                         : setup.geometry == Geometry::plane      ? fixes("x") && fixes("y")
                                                                  : fixes("x") && fixes("y") && fixes("z");
    if (clamped) needs.clamping.push_back(surface);
  }
}

}  // namespace fsi
