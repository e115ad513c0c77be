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
/// Planes normal to x, y, z that the body is mirrored in, or slides on: no displacement and no flow across them.
/// Optional, on fluid and wall. The axis of an axisymmetric mesh needs no name: it is where r = 0.
inline constexpr std::array<const char*, 3> symmetry{"symmetry_x", "symmetry_y", "symmetry_z"};
inline constexpr std::array<const char*, 8> surfaces{inlet, outlet,      wall_ends,   outer,
                                                     inner, symmetry[0], symmetry[1], symmetry[2]};
}  // namespace group

}  // namespace fsi
