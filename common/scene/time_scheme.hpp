#pragma once

#include <memory>
#include <string>

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

/// Largest theta of a midpoint rule whose shift is found from the scene: beyond it the shift would no longer keep the order.
inline constexpr double midpoint_bound = 0.5625;

/// The bound of theta in a run: midpoint_bound, or 1 where the case gives time.damping.
double largest_midpoint_theta(const TimeData& time);

/// The scheme of a case in time: as named, else
///   midpoint  for equal steps with 1/2 + midpoint_damping dt <= midpoint_bound, and for adaptive ones unless
///             time.largest_step allows more than the scene's time (midpoint_share / midpoint_damping),
///   tr-bdf2   for longer ones, which do not resolve the wall's own motion: of second order there, too (docs/theory.md,
///             section 8.5).
template <int n>
TimeScheme time_scheme_of(const Case& setup, const Scene<n>& scene);

/// Why the run has its scheme, for the log; empty when the case names it. A run that goes on keeps its scheme, whatever its
/// steps are now.
template <int n>
std::string about_time_scheme(const Case& setup, const Scene<n>& scene, TimeScheme scheme);

/// Where the run's midpoint rule is not of second order with its equal steps: why, and what to do. Else empty. Of adaptive
/// steps an estimate holds the error, the shift's part included.
template <int n>
std::string lost_order(const Case& setup, const Scene<n>& scene, TimeScheme scheme);

/// The integrator of a scheme in a case in time.
template <int n>
std::unique_ptr<const TimeIntegrator> make_time_scheme(const Case& setup, const Scene<n>& scene, TimeScheme scheme);

}  // namespace fsi
