#pragma once

#include <vector>

#include "io/result_tables.hpp"
#include "observers/observation.hpp"
#include "parallel/partial_sums.hpp"
#include "scene/scene.hpp"
#include "time/state.hpp"

namespace fsi {

/// points.csv, lines.csv and planes.csv of a run, as far as its case asks for them. Pressure and velocity are those of
/// the fluid, in the wall the pressure is the wall's and there is no velocity; the displacement is the wall's, in the
/// fluid that of the mesh, by which the sample has moved from its reference coordinates.
template <int n>
class SampleTables {
 public:
  /// Both must outlive this.
  SampleTables(const RequestedSamples& samples, const Scene<n>& scene);

  /// In the order points, lines, planes; those without a sample are left out.
  const std::vector<ResultTable>& tables() const { return tables_; }
  /// The rows of each of them at a level. Processes that share the scene ask for them together: what they have to add up
  /// goes into `sums`, and the rows are those of all processes when that is done.
  std::vector<std::vector<TableRow>> rows(const State& level, PartialSums& sums) const;

 private:
  void add(ResultTable table);
  void add(const char* file, const std::vector<SampledPoint>& samples, bool along_line);
  std::vector<TableRow> rows(const ResultTable& table, const State& level) const;

  const Scene<n>& scene_;
  const RequestedSamples& samples_;
  std::vector<ResultTable> tables_;
};

}  // namespace fsi
