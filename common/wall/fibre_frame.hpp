#pragma once

#include <vector>

#include "math/tensor.hpp"
#include "mesh/submesh.hpp"

namespace fsi {

/// Where the potentials of a wall's frame are held: a mark per node of the wall's part, copies marked as their
/// originals.
struct FrameBoundary {
  std::vector<char> inner, outer;  ///< the radial potential is 0 and 1
  std::vector<char> start, end;    ///< the axial potential is 0 and 1; empty in two dimensions
  std::vector<Point> from, to;     ///< mm, middles of the faces that start and end are, for messages
};

/// Frame of a wall of any shape from two potentials, each harmonic on the whole wall with no flux through the rest of
/// the boundary (docs/theory.md, section 5.6; the idea is [Bayer2012]'s).
struct FrameFields {
  std::vector<double> radial, axial;  ///< potentials per node of the part; the axial one is empty in two dimensions
  /// Of linear elements, whose gradients are constant: found at the nodes from the potentials around, 1/mm. Else empty.
  std::vector<Vec3<double>> radial_slope, axial_slope;

  bool empty() const { return radial.empty(); }
};

/// On the whole wall, not a share of it. \throws ConvergenceError where the boundary leaves a potential undetermined
template <class Element>
FrameFields frame_fields(const Submesh<Element::dim, Element::order>& part, const FrameBoundary& boundary);

/// Unit vectors at a point, at right angles to each other.
struct LocalFrame {
  Vec3<double> radial, circumferential, axial;
};

/// e_r along the radial slope, e_z along what the axial slope has across e_r, e_theta = e_z x e_r. Where that is
/// nothing, as at the saddle of a branching, e_z is along the projection across e_r of the axis of space most nearly
/// at right angles to it. e_r is along x where the radial slope is zero.
LocalFrame frame_of(const Vec3<double>& radial_slope, const Vec3<double>& axial_slope);

}  // namespace fsi
