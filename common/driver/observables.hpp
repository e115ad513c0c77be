#pragma once

#include "driver/observation.hpp"
#include "driver/sample_tables.hpp"
#include "io/result_folder.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What the CSV tables show of a state: centre-line pressure, inner-wall displacement, flow, samples. Parts that a scene does
/// not have cost nothing. Processes that share the scene look together, and all see the same.
template <int n>
class Observables {
 public:
  Observables(ObservationPoints points, const Scene<n>& scene);

  ResultTables tables() const;
  const ObservationPoints& points() const { return points_; }
  /// kPa, at the points of the centre line. \param fluid  (u, p)
  std::vector<double> centre_line_pressure(const std::vector<double>& fluid) const;
  /// Adds the rows of the state's current time level.
  void write(const State& state, ResultFolder& folder) const;
  /// Compares a level with the last rows of an earlier run's tables, which its checkpoint must reproduce.
  /// \throws InputError when they show another state
  void require_same(const State& level, const EarlierTables& earlier) const;

 private:
  /// What is seen of a level; empty where there is nothing to see.
  struct Seen {
    std::vector<double> pressure;       ///< kPa, on the centre line
    std::vector<double> radial, axial;  ///< mm, of the inner wall
    FlowRecord flow;
    std::vector<std::vector<SampledRow>> samples;  ///< of each sampled table
  };
  Seen look(const State& level) const;
  /// The rows of what is seen; none where there is no such line.
  std::vector<CentrePoint> centre_points(const Seen& seen) const;
  std::vector<WallPoint> wall_points(const Seen& seen) const;
  /// This process's part.
  std::vector<double> centre_line_part(const std::vector<double>& fluid) const;

  const Scene<n>& scene_;
  ObservationPoints points_;
  SampleTables<n> samples_;
};

}  // namespace fsi
