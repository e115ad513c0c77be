#pragma once

namespace fsi {

/// mesh_motion.method: what takes the fluid's mesh along with its interface (docs/theory.md, section 6).
enum class MeshMotionMethod {
  harmonic,          ///< Laplace's equation, component by component
  stiffened,         ///< the same with a coefficient that is large where elements are small or the interface is near
  nonlinear_elastic  ///< a hyperelastic pseudo-solid that no deformation can fold
};

/// [mesh_motion]. Defaults by measurement (docs/theory.md, section 6). The harmonic method has no options.
struct MeshMotionOptions {
  MeshMotionMethod method = MeshMotionMethod::harmonic;
  double size_exponent = 1;      ///< chi: the coefficient grows with V^-chi, V being an element's volume
  double distance_exponent = 1;  ///< p: and with l^-p, l being its distance from the interface
  double poisson = 0;            ///< of the pseudo-solid at rest, from 0 to below 0.5

  /// Elements have coefficients of their own.
  bool stiffens() const {
    return method != MeshMotionMethod::harmonic && (size_exponent != 0 || distance_exponent != 0);
  }
};

}  // namespace fsi
