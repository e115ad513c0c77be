#pragma once

#include <memory>

#include "case/case.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Of the scene's frequency that is the midpoint rule's damping: what the artery's wave tolerates best (docs/theory.md,
/// section 8.5), 0.2/ms there.
inline constexpr double midpoint_share = 0.25;

/// The rate of the shifted midpoint rule for a scene, 1/ms: a share of the frequency with which it swings across, so that
/// a scene in other units has the same answer.
///   fluid and wall:  c_w / R, the wave speed (wave_speed.hpp) over the radius 2 V_f / A,
///   wall alone:      sqrt(E / ((1 - nu^2) rho_s)) / R, R the largest distance from its axis,
///   fluid alone:     the larger of nu (2.405 / R)^2, the decay of the slowest flow in a pipe, R its largest distance from
///                    the z axis (half its smaller extent in the plane), and of the share over the shortest time between
///                    jumps of the load: without waves only these make stabilised velocities alternate.
template <int n>
double midpoint_damping(const Case& setup, const Scene<n>& scene);

/// The scheme that a case in time asks for.
template <int n>
std::unique_ptr<const TimeIntegrator> make_time_scheme(const Case& setup, const Scene<n>& scene);

}  // namespace fsi
