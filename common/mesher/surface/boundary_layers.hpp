#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesher/prism_columns.hpp"
#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

/// Layers of thin cells along a lumen's wall.
struct BoundaryLayers {
  int count = 0;             ///< 0: none
  double first = 0;          ///< thickness of the cells at the wall, mm
  double growth = 1.2;       ///< of each layer over the one before
  double thickness() const;  ///< of all, mm
};

/// The wall moved inwards by the layers' thickness, along normals that are averaged with their neighbours' and lie in
/// the planes of openings at rims. Nodes and triangles keep their numbers.
/// \throws InputError naming `--layers`, with the place: layers thicker than 0.4 of the smallest local radius, and a
///         moved surface that folds or cuts itself
TriangleSurface moved_inwards(const TriangleSurface& wall, const BoundaryLayers& layers);

/// Grows the layers from a lumen that was filled inside of the moved wall back to the wall. Their cells are in the
/// volume `fluid`, their ends in the surfaces of the openings.
/// \param inner  the wall moved inwards, whose nodes are among the mesh's
/// \return the layers' nodes, from the inner wall outwards
/// \throws InputError naming `--layers`, with the place of a cell that is folded
Levels grow_layers(TetrahedralMesh& lumen, const TriangleSurface& wall, const TriangleSurface& inner,
                   const BoundaryLayers& layers);

}  // namespace fsi
