#pragma once

#include <array>
#include <vector>

#include "math/pack.hpp"
#include "mesh/submesh.hpp"
#include "mesh_motion/mesh_motion_options.hpp"

namespace fsi {

/// Coefficients k of a stiffened mesh motion, one a cell: with the volume V of a cell (its area, in two dimensions) and
/// the distance l of its centroid from the nearest node of the interface
///   k = (V_mean / V)^chi (l_mean / l)^p,
/// so that small elements and those at the interface, whose shape decides, are moved as they are, and large ones far
/// away deform: [Stein2003] with p = 0, [Jasak2006] with chi = 0. Means are over cells. Straight cells are taken for
/// curved ones.
/// \param interface  nodes of the part; without any the factor of the distance is left out
/// \returns one number a cell, without unit; empty where the options ask for no stiffening: all coefficients are one
template <int Dim, int Order>
std::vector<double> mesh_stiffness(const Submesh<Dim, Order>& part, const std::vector<int>& interface,
                                   const MeshMotionOptions& options);

/// Of the cells of a pack; 1 where there are no coefficients.
inline Pack stiffness_of(const std::vector<double>& stiffness, const std::array<int, pack_width>& cell) {
  if (stiffness.empty()) return Pack(1.0);
  Pack k(1.0);
  for (int lane = 0; lane < pack_width; ++lane) k.set(lane, stiffness[cell[lane]]);
  return k;
}

}  // namespace fsi
