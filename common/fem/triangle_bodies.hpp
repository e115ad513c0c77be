#pragma once

namespace fsi {

/// What a triangle in a plane stands for. `axis`: the space axes of the two coordinates and components.

/// A prism of unit thickness, 1 mm, in plane strain: coordinates (x, y, 0), nothing moves or changes along z.
struct PlaneStrain {
  static constexpr int axis[2] = {0, 1};
  static constexpr bool axisymmetric = false;
};

/// A ring about the z axis: coordinates (r, 0, z), components (radial, axial), the circumferential strain u_r / r in
/// the (1, 1) entry of gradients and 2 pi r in the integration weight. Quadrature points lie inside their element, so
/// that r > 0 at each, also where a side lies on the axis; u_r / r stays bounded there since u_r = 0 on the axis.
struct BodyOfRevolution {
  static constexpr int axis[2] = {0, 2};
  static constexpr bool axisymmetric = true;
};

inline constexpr double two_pi = 6.283185307179586476925286766559;

}  // namespace fsi
