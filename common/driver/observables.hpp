#pragma once

#include "driver/observation.hpp"
#include "io/result_folder.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What the CSV tables show of a state: centre-line pressure, inner-wall displacement, flow. Parts that a scene does
/// not have cost nothing.
template <int n>
class Observables {
 public:
  Observables(ObservationPoints points, const Scene<n>& scene);

  ResultTables tables() const;
  /// Adds the rows of the state's current time level.
  void write(const State& state, ResultFolder& folder) const;

 private:
  const Scene<n>& scene_;
  ObservationPoints points_;
};

}  // namespace fsi
