#pragma once

#include <string>

#include "scene/loads.hpp"
#include "scene/scene.hpp"
#include "time/state.hpp"

namespace fsi {

/// What a load step does to the energy of a wall at rest, uJ = mm^3 kPa; of the whole wall.
struct LoadPathEnergy {
  double stored = 0;       ///< change of the elastic energy, springs included
  double work_before = 0;  ///< of the loads as they are before the step, on the way of the step
  double work_after = 0;   ///< of the loads as they are after it, on the same way

  /// How far `stored` is outside the interval of both works, relative to the largest of the three; 0: inside. Along a
  /// path of stable states it is inside: with the loads f(s) and the displacements d(s)
  ///   stored = integral of f . d' ds,   f' . d' > 0,
  /// so that f_0 . (d_1 - d_0) <= stored <= f_1 . (d_1 - d_0) (docs/theory.md, section 4.9).
  double excess() const;
  /// A step with a larger excess does not follow the path of stable states.
  static constexpr double tolerable_excess = 0.02;
  bool follows_the_load() const { return excess() <= tolerable_excess; }
};

/// Of the step from one state to another. The work of pressures is that of the volume that their surfaces sweep on
/// straight ways, exactly but for curved axes of revolution. Processes that share the scene call it together.
/// \param step  number of the load step
template <int n>
LoadPathEnergy load_path_energy(const Scene<n>& scene, const Loads& loads, int step, const State& before,
                                const State& after);

/// A clause for people.
std::string text_of(const LoadPathEnergy& energy);

}  // namespace fsi
