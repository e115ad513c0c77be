#pragma once

#include <vector>

#include "io/result_tables.hpp"
#include "observers/observation.hpp"
#include "parallel/partial_sums.hpp"
#include "scene/scene.hpp"
#include "time/state.hpp"

namespace fsi {

/// points.csv, lines.csv and planes.csv of a run, as far as its case asks for them. In the fluid the displacement is
/// that of the mesh, by which the sample has moved from its reference coordinates. In the wall the pressure is the
/// wall's, and there is no velocity.
template <int n>
class SampleTables {
 public:
  /// Both must outlive this.
  SampleTables(const RequestedSamples& samples, const Scene<n>& scene);

  /// In the order points, lines, planes; those without a sample are left out.
  const std::vector<ResultTable>& tables() const { return tables_; }
  /// The rows of each table at a level. Collective over the processes that share the scene. Numbers that are this
  /// process's part of a sum are included in `sums`: rows are complete once these are added up.
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
