#pragma once

#include <array>
#include <string_view>

namespace fsi {

/// Names of physical groups with a meaning of their own (docs/theory.md, section 1.4). Other volumes are wall layers,
/// other surfaces openings, supports or closed faces, as the case file says.
namespace group {
inline constexpr const char* fluid = "fluid";  ///< volume
inline constexpr const char* inlet = "inlet";  ///< surfaces from here on
inline constexpr const char* outlet = "outlet";
inline constexpr const char* wall_ends = "wall_ends";  ///< clamped end faces of all wall layers
inline constexpr const char* outer = "outer";          ///< free outer face of the wall, optional
inline constexpr const char* inner = "inner";          ///< loaded face of a wall without fluid
inline constexpr const char* wall = "wall";            ///< where a fluid alone has its wall, optional
/// Surfaces whose names say that the fluid sticks there: a case need not list them.
constexpr bool is_no_opening(std::string_view name) {
  return name == wall || name == inner;
}
/// Planes normal to x, y, z that the body is mirrored in, or slides on: no displacement and no flow across them.
/// Optional, on fluid and wall. The axis of an axisymmetric mesh needs no name: it is where r = 0.
inline constexpr std::array<const char*, 3> symmetry{"symmetry_x", "symmetry_y", "symmetry_z"};
/// Such a plane, of any normal: `symmetry`, or a name that begins with `symmetry_`. But for the three above, the facets
/// tell the normal.
constexpr bool is_symmetry_plane(std::string_view name) {
  return name == "symmetry" || name.substr(0, 9) == "symmetry_";
}
inline constexpr const char* oblique_symmetry = "symmetry_1";  ///< that of a sector which is normal to no axis
/// Surfaces that a case need not name.
constexpr bool has_meaning(std::string_view name) {
  return name == inlet || name == outlet || name == wall_ends || name == outer || name == inner ||
         is_symmetry_plane(name);
}
}  // namespace group

}  // namespace fsi
