#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Reads the tetrahedra of the named physical volumes from a gmsh file (.msh 4.1 or 2.2, ASCII or binary).
///
/// `regions` of the result are `volumes_wanted`, in that order. Other volumes are left out, and with them the nodes
/// that only they use. `facet_groups` are the named physical surfaces as far as their triangles are facets of what was
/// read (facets of left-out volumes are dropped, and groups that have none left). Facets are oriented out of the cell
/// they bound; one between two cells that were both read, out of the one in `fluid` if only one is, else out of the
/// first. Nodes keep the order of the file; cells that of the file, too.
///
/// Throws InputError, naming the file and the group or element at fault, for everything parse_gmsh() throws for and
/// for: no physical names; a wanted volume that is missing or empty; elements in a wanted volume that are not linear
/// tetrahedra, are in two wanted volumes, inverted or degenerate; unknown or repeated node tags; nodes that no element
/// uses; triangles of `inlet`, `outlet`, `wall_ends`, `outer` or `inner` that are no facet of any element.
TetrahedralMesh read_gmsh(const std::filesystem::path& path, const std::vector<std::string>& volumes_wanted);

/// Names of the physical volumes that the file has, in the file's order; what a case file may give materials to.
std::vector<std::string> gmsh_volumes(const std::filesystem::path& path);

/// A tetrahedron is degenerate when its volume is below this fraction of its longest edge cubed (regular: 0.118).
inline constexpr double smallest_relative_volume = 1e-12;

}  // namespace fsi
