#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A value of the wall's deformation, and the place on the mesh that it belongs to, mm.
struct ValueAt {
  double value = 0;
  Point where{0, 0, 0};
};

/// How far a layer of the wall is deformed from its unloaded shape (docs/theory.md, section 4.9). Wall::deformation()
/// has it of all processes, layer_deformation() of one.
struct LayerDeformation {
  ValueAt least{1};     ///< least det F at the quadrature points; 1, at no place, where all are larger
  ValueAt greatest{1};  ///< greatest likewise; 1, at no place, where all are less
  /// The worst place in quadratic elements where the deformed element's Jacobian is not shown to be positive, and its
  /// value there over the mean of the element, at most 0; `where` is in the deformed element, not on the mesh. 1: none.
  ValueAt folded{1};
  /// Largest absolute principal value of the small strain tensor. Of layers of `linear-elastic` alone, and not while
  /// the unloaded shape is searched; else 0.
  ValueAt strain;
  ValueAt rotation;  ///< largest rotation by the antisymmetric part of grad d, radians; likewise

  /// The lesser of `least` and `folded`; `least` where that is NaN.
  const ValueAt& worst() const { return folded.value < least.value ? folded : least; }
};

/// What LayerDeformation is made from.
struct DeformationInput {
  const double* wall = nullptr;       ///< (d, .), mixed layout, mm
  const double* prestress = nullptr;  ///< displacement from the unloaded shape to the mesh, vector layout, mm
  /// d is that displacement itself, on the mesh: F = (I - grad d)^-1 (wall/unloaded_shape.hpp).
  bool finds_unloaded_shape = false;
};

}  // namespace fsi
