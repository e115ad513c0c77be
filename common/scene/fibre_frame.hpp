#pragma once

#include <string>
#include <vector>

#include "scene/boundary_conditions.hpp"
#include "wall/fibre_frame.hpp"

namespace fsi {

/// Where the potentials of a wall's frame are held, each connected piece of the wall on its own (docs/theory.md,
/// section 5.6). Inner: its interface with the fluid, or the group `inner`. Outer: the rest of its boundary but for
/// `wall_ends` and planes of symmetry. Of the connected pieces of `wall_ends` the largest is the start, the others are
/// the end.
/// \param wall       the wall's part of the mesh
/// \param case_file  that asks for it, for messages
/// \throws InputError where a piece of the wall has no inner or outer face, or fewer than two ends
template <class Element>
FrameBoundary frame_boundary(const MeshOf<Element>& mesh, const PartOf<Element>& wall,
                             const std::vector<int>& wall_regions, const std::string& case_file);

}  // namespace fsi
