#pragma once

#include <memory>
#include <string>

#include "case/case.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Characteristic frequency of a scene's radial oscillation, 1/ms. Time schemes are chosen and damped by the step times
/// this number, which does not depend on units. To be called by all processes.
///   fluid and wall:  c_w / R, the wave speed (wave_speed.hpp) over the radius 2 V_f / A,
///   wall alone:      sqrt(E / ((1 - nu^2) rho_s)) / R, R the largest distance from its axis,
///   fluid alone:     the larger of nu (2.405 / R)^2 over midpoint_share, so that the midpoint rule's damping is the decay
///                    of the slowest flow in a pipe, R = 2 V / A of the volume V and the area A that the fluid sticks to
///                    (half the smaller extent in the plane), and of one over the shortest time between jumps of the
///                    load: without waves only these make stabilised velocities alternate.
template <int n>
double scene_frequency(const Case& setup, const Scene<n>& scene);

/// The inverse of scene_frequency(), ms; the end of the run where that is zero. Of fluid and wall the time in which a
/// wave travels the radius. To be called by all processes, as are the functions below that take a scene.
template <int n>
double scene_time(const Case& setup, const Scene<n>& scene);

/// That adaptive steps must resolve, ms: the scene's time, and an eighth of the shortest period of a load.
template <int n>
double resolved_time(const Case& setup, const Scene<n>& scene);

/// The scheme of a case in time: as named, else
///   midpoint  for equal steps whose shift keeps theta within midpoint_bound, and for adaptive ones unless
///             time.largest_step allows more than the scene's time,
///   tr-bdf2   for longer ones, which do not resolve the wall's own motion: of second order there, too (docs/theory.md,
///             section 8.5).
template <int n>
std::string time_scheme_of(const Case& setup, const Scene<n>& scene);

/// Why the run has its scheme, for the log; empty when the case names it. A run that goes on keeps its scheme, whatever its
/// steps are now.
template <int n>
std::string about_time_scheme(const Case& setup, const Scene<n>& scene, const std::string& scheme);

/// Where the scheme in use loses its order with the run's equal steps: why, and what to do. Else empty. Of adaptive
/// steps an estimate holds the error.
std::string lost_order(const TimeData& time, const TimeIntegrator& scheme);

/// The integrator of a scheme in a case in time.
template <int n>
std::unique_ptr<const TimeIntegrator> make_time_scheme(const Case& setup, const Scene<n>& scene,
                                                       const std::string& scheme);

}  // namespace fsi
