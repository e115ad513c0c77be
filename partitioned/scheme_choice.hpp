#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The coupling scheme of a run, and why it is this one.
struct SchemeChoice {
  std::string name;    ///< one of coupling_scheme_names()
  std::string reason;  ///< a clause for the log
  bool named = false;  ///< by the case
};

/// Steps of a run over the time within which the wall's ring answers (Membrane::answer_time). What counts is the period of
/// u = (d - r) / period (InterfaceKinematics): all of a step of backward Euler, half of one of the midpoint rule, 0.29 of one
/// of tr-bdf2, whose stages are solved one by one.
struct StepsOverAnswer {
  double length = 0;      ///< ms, of the longest step
  double period = 0;      ///< ms, of such a step
  double answers = 0;     ///< the period in times of the wall's answer
  bool adaptive = false;  ///< most steps are shorter
};
/// Of a scene with fluid and wall, for all processes together; empty where the case says nothing of the length of steps: it
/// has no time, or adaptive steps whose longest it does not name.
template <int n>
std::optional<StepsOverAnswer> steps_over_answer(const Case& setup, const Scene<n>& scene);

/// How much stiffer the Robin condition of block Newton is than the membrane's inertia and hoop (Membrane::impedance).
struct RobinStiffness {
  double factor;
  std::string reason;  ///< a clause for the log
};
/// By trial (docs/coupling.md): 1 in steps that are short against the wall's answer. 10 where they are long, and all its
/// stiffness answers. 1e4 where the wall stands in the fluid: it is no membrane then, and its added mass does no harm to
/// a fluid that is all but given its velocity. What it goes by is the same in a run and its restart: case and mesh alone. For
/// all processes together.
template <int n>
RobinStiffness robin_stiffness(const Case& setup, const Scene<n>& scene);

/// The scheme that the case names; where it names none, an interface iteration: by inexact passes around a vessel, by passes
/// that solve both media where the wall stands in the fluid. For all processes together.
template <int n>
SchemeChoice chosen_scheme(const Case& setup, const Scene<n>& scene);

}  // namespace fsi
