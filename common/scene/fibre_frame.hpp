#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "scene/wall_boundary.hpp"
#include "wall/fibre_frame.hpp"

namespace fsi {

/// The frame that a wall's fibres lie in.
struct WallFrame {
  FibreFrame kind = FibreFrame::cylinder;
  FrameFields fields{};  ///< empty: that of a cylinder
  std::string remark{};  ///< which it is, and why, for the log
  std::string notice{};  ///< a warning; empty: there is none
};

/// That which the case names; else that of a cylinder, if the wall is one about the axis of the case, else the wall's own
/// (docs/theory.md, section 5.6). Where that cannot be found, an axis that the case names is taken, with a notice.
/// \param wall  the wall's part of the mesh
/// \throws InputError where the wall's own frame is asked for, or needed, and cannot be found
template <class Element>
WallFrame wall_frame(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& wall,
                     const std::vector<int>& wall_regions);

/// Where the potentials of a wall's frame are held, each connected piece of the wall on its own. Inner: its interface with
/// the fluid, or the group `inner`. Of the ends (scene/vessel_ends.hpp) the largest connected piece is the start, the
/// others are the end. Outer: the rest of its boundary but for ends, planes of symmetry and cuts.
/// \param facets     the wall's boundary
/// \param case_file  that asks for it, for messages
/// \param subject    what needs the potentials, for messages
/// \throws InputError where a piece of the wall has no inner or outer face, or fewer than two ends
template <class Element>
FrameBoundary frame_boundary(const MeshOf<Element>& mesh, const PartOf<Element>& wall,
                             const WallFacets<Element>& facets, const std::string& case_file,
                             const std::string& subject);

}  // namespace fsi
