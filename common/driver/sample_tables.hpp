#pragma once

#include <vector>

#include "driver/observation.hpp"
#include "io/sampled_table.hpp"
#include "scene/scene.hpp"
#include "time/state.hpp"

namespace fsi {

/// points.csv, lines.csv and planes.csv of a run, as far as its case asks for them. Pressure and velocity are those of
/// the fluid, in the wall the pressure is the wall's and there is no velocity; the displacement is the wall's, in the
/// fluid that of the mesh, by which the sample has moved from its reference coordinates.
template <int n>
class SampleTables {
 public:
  SampleTables(RequestedSamples samples, const Scene<n>& scene);

  /// In the order points, lines, planes; those without a sample are left out.
  const std::vector<SampledTable>& tables() const { return tables_; }
  /// The rows of one of them at a level.
  std::vector<SampledRow> rows(const SampledTable& table, const State& level) const;

 private:
  void add(const char* file, const std::vector<SampledPoint>& samples, bool along_line);
  SampledRow row(const SampledPoint& sample, const State& level) const;

  const Scene<n>& scene_;
  RequestedSamples samples_;
  std::vector<SampledTable> tables_;
};

}  // namespace fsi
