#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "run/case_description.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What drives a flow that is not given.
struct FlowDrive {
  double pressure;   ///< kPa, the largest difference
  double length;     ///< mm, of the fluid's longest extent
  double duration;   ///< ms, of the run
  double density;    ///< mg/mm^3
  double viscosity;  ///< kPa ms
};

/// Mean velocity that a difference of pressure p drives at most through a rigid vessel, mm/ms: whichever of viscosity,
/// p D^2 / (32 mu L), inertia, p T / (rho L), and kinetic energy, sqrt(2 p / rho), allows least.
/// \param diameter  D, mm
double driven_velocity(const FlowDrive& drive, double diameter);

/// The flow through an opening at the largest rate that the case gives there, or at the most that pressures can drive.
struct OpeningFlow {
  std::string surface;
  double diameter = 0;   ///< mm, of the circle of the opening's area; in plane scenes its width
  double velocity = 0;   ///< mm/ms, mean over the opening
  double reynolds = 0;   ///< rho U D / mu
  double womersley = 0;  ///< D / 2 sqrt(2 pi rho / (T mu)), T the period of what is given there; 0: it has none
  std::optional<FlowDrive> drive;  ///< no flow is given: velocity and Reynolds number are upper bounds
};

/// Numbers without unit that tell whether a case is about what its author has in mind: a wrong unit shows in them, whichever
/// key it stands in.
struct DerivedNumbers {
  std::vector<OpeningFlow> flows;  ///< of openings with a flow
  double wave_speed = 0;  ///< c of long pressure waves, mm/ms (scene/wave_speed.hpp); 0: fluid and wall do not meet
  double load = 0;        ///< kPa: the largest change of pressure that the case gives, in fluid with a wall
  double strain = 0;      ///< around the vessel under that load at rest, by moduli at small strain: p / (2 rho c^2)
  bool stiffens = false;  ///< a layer has fibres: the strain is an upper bound
};

/// All numbers are zero or absent for a case without fluid, or in statics. To be called by all processes.
template <int n>
DerivedNumbers derived_numbers(const Case& setup, const Scene<n>& scene);

/// One line for each opening, one for the wall.
void describe_numbers(const DerivedNumbers& numbers, Description& lines);
/// Those in one line for the log; empty: there are none.
std::string text_of_numbers(const DerivedNumbers& numbers);

/// Warnings, one for each number that no vessel and no experiment with one has: mean velocities above 10 m/s or, where
/// a flow is given, below 2e-6 m/s; Reynolds numbers above 20,000; Womersley numbers above 100; mean velocities above
/// three quarters of the wave speed; strains above 1, with fibres above 10. Each names the wrong units that would
/// explain it.
std::vector<std::string> implausible_numbers(const DerivedNumbers& numbers);

}  // namespace fsi
