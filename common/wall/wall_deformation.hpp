#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A value of the wall's deformation, and the place on the mesh that it belongs to, mm.
struct ValueAt {
  double value = 0;
  Point where{0, 0, 0};
};

/// How far a layer of the wall is deformed from its unloaded shape (docs/theory.md, section 4.9). Of all processes.
struct LayerDeformation {
  ValueAt least{1};     ///< det F, of the quadrature points
  ValueAt greatest{1};  ///< likewise
  /// A place where det F is not positive though it is at the quadrature points of its quadratic element; 1: none.
  ValueAt folded{1};
  ValueAt strain;    ///< largest principal strain, of the small strain tensor; of layers of `linear-elastic` alone
  ValueAt rotation;  ///< radians, of the antisymmetric part of grad d; likewise

  /// The least det F that was found; NaN where one is.
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
