#pragma once

namespace fsi {

/// Velocity and displacement of the fluid-wall interface in one step (docs/theory.md, section 8.3): the one owner of
/// u = a d + history, for every scheme written as
///   u = (d - r) / period,
/// with a reference r made of finished levels (backward Euler: period = dt, r = d^(n-1)). The displacements meant are
/// those of the wall and of the fluid's mesh, which move with one velocity.
struct InterfaceKinematics {
  double period = 1;  ///< ms; 1 in statics, where "velocity" stands for the displacement itself

  double velocity(double displacement, double reference) const { return (displacement - reference) / period; }
  double displacement(double velocity, double reference) const { return reference + period * velocity; }
  /// The change of the velocity that comes with a change of the displacement.
  double velocity_change(double displacement_change) const { return displacement_change / period; }
  /// a = du / dd, 1/ms.
  double rate() const { return 1.0 / period; }
};

}  // namespace fsi
