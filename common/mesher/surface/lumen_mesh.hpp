#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/prism_columns.hpp"
#include "mesher/surface/boundary_layers.hpp"
#include "mesher/surface/lumen_openings.hpp"

namespace fsi {

/// The options of a lumen's mesh.
struct LumenRequest {
  std::string file;                     ///< for messages
  std::vector<OpeningChoice> openings;  ///< with names: all openings but those in `closed`
  std::vector<OpeningChoice> closed;    ///< holes and flat parts that become wall
  int smoothing = 20;                   ///< passes
  double edge = 0;                      ///< length of the surface's edges, mm; 0: as they are on average
  double edges_per_diameter = 0;        ///< in place of `edge`: a length that follows the local diameter
  double edges_per_curvature =
      0;                     ///< edges along the diameter of the circle of curvature, where that is shorter; 0: none
  double shortest_edge = 0;  ///< mm, that curvature asks for; 0: half the mean edge of the surface as it comes
  BoundaryLayers layers;     ///< inside the wall
  double womersley =
      0;  ///< above 0: the layers are as thick as the Stokes layer, sqrt(2) R / it, in the widest opening
  std::vector<std::pair<std::string, double>> cuts;        ///< by opening, mm behind its centre
  std::vector<std::pair<std::string, double>> extensions;  ///< by opening, in diameters
};

/// A lumen's volume mesh, what was done in sentences for the user, and its openings as they are now.
struct LumenMesh {
  TetrahedralMesh mesh;  ///< volume `fluid`; a surface for each opening; the wall has no name
  Levels layers;         ///< nodes of the layers along the wall, from within; empty where there are none
  std::vector<std::string> done;
  std::vector<LumenOpening> openings;
};

/// From an open surface to tetrahedra: names, holes closed, smoothed, cut, made longer, remeshed, capped flat, filled.
/// \throws InputError for what is no lumen once holes are closed (not_a_lumen()), openings without a name, names twice,
///         options that name no opening, smoothing that changes the volume by more than 1 %, and what the steps refuse
LumenMesh mesh_lumen(OpenedLumen lumen, const LumenRequest& request);

}  // namespace fsi
