#pragma once

#include <optional>
#include <string>

#include "mesh_io/gmsh_reader.hpp"
#include "mesher/artery/options.hpp"
#include "mesher/artery/recommended_meshes.hpp"

namespace fsi {

/// What the options of `fsi-mesh artery` ask for.
struct ArteryRequest {
  ArteryOptions sizes;  ///< dimensions and element sizes

  // Numbers of cells; what is not given follows from the sizes, or from the mesh recommended for an element.
  std::optional<int> lumen_cells, media_cells, adventitia_cells, around, axial_cells;
  std::optional<double> lumen_grading, axial_grading;

  std::optional<int> order;  ///< of the edges: 1 straight, 2 quadratic; 2 for a recommended mesh of p2p1, else 1
  bool axisymmetric = false;
  int sector = 360;       ///< degrees
  bool mirrored = false;  ///< the sector and its images, the whole tube

  std::string for_element;                                  ///< empty: no recommendation asked for
  std::optional<std::string> error;                         ///< with its sign; 3% unless given
  std::string waves = wave_kinds().name_of(Waves::damped);  ///< for which error holds
};

/// The mesh recommended for the request's element, nullptr when it asks for none.
/// Throws InputError with the option at fault.
const RecommendedMesh* recommendation(const ArteryRequest& request);

/// Makes the mesh. Sizes alone, of the whole tube, give the meshes of the levels; numbers of cells, sectors and
/// axisymmetric meshes are divided regularly, so that they can be graded and mirrored.
/// Throws InputError with the option at fault.
AnyMesh make_artery(const ArteryRequest& request);

}  // namespace fsi
