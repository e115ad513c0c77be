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

/// Length of a run's steps against the response time of the wall's ring (Membrane::answer_time()). What counts is the
/// period of u = (d - r) / period (InterfaceKinematics): the whole step with backward Euler, half of it with the
/// midpoint rule, 0.29 of it with tr-bdf2, whose stages are solved one by one.
struct StepsOverAnswer {
  double length = 0;      ///< ms, of the longest step
  double period = 0;      ///< ms, of such a step
  double answers = 0;     ///< period over the wall's response time
  bool adaptive = false;  ///< most steps are shorter
};
/// For a scene with fluid and wall. Empty where the length of steps is not known: in a static case, and with adaptive
/// steps without time.largest_step. Collective.
template <int n>
std::optional<StepsOverAnswer> steps_over_answer(const Case& setup, const Scene<n>& scene);

/// Factor of the Robin coefficient of block Newton over the wall's impedance as a membrane (Membrane::impedance()).
struct RobinStiffness {
  double factor;
  std::string reason;  ///< a clause for the log
};
/// By trial (docs/coupling.md): 1 in steps that are short against the wall's response time, or of unknown length. 10 in
/// long steps, where the whole stiffness of the wall resists. 1e4 where the wall stands in the fluid: it is no membrane
/// then, and with nearly prescribed velocities the added mass does no harm to the fluid. Depends on case and mesh
/// alone, so that a restart has the same factor. Collective.
template <int n>
RobinStiffness robin_stiffness(const Case& setup, const Scene<n>& scene);

/// The scheme that the case names. Without a name an interface iteration: with inexact passes where the wall is a tube
/// around the fluid, with passes that solve both media where it stands in the fluid. Collective.
template <int n>
SchemeChoice chosen_scheme(const Case& setup, const Scene<n>& scene);

}  // namespace fsi
