#pragma once

#include <array>

namespace fsi {

/// Names of physical groups with a meaning of their own (docs/theory.md, section 1.4). Every other volume is a wall
/// layer named in the case file; every other surface is ignored by the programs.
namespace group {
inline constexpr const char* fluid = "fluid";  ///< volume
inline constexpr const char* inlet = "inlet";  ///< surfaces from here on
inline constexpr const char* outlet = "outlet";
inline constexpr const char* wall_ends = "wall_ends";  ///< clamped end faces of all wall layers
inline constexpr const char* outer = "outer";          ///< free outer face of the wall, optional
inline constexpr const char* inner = "inner";          ///< loaded face of a wall without fluid
/// Planes of symmetry normal to the x, y and z axis of space, which also carry what may slide along them.
inline constexpr std::array<const char*, 3> symmetry_planes{"symmetry_x", "symmetry_y", "symmetry_z"};
inline constexpr std::array<const char*, 8> surfaces{inlet, outlet,       wall_ends,    outer,
                                                     inner, "symmetry_x", "symmetry_y", "symmetry_z"};
}  // namespace group

}  // namespace fsi
