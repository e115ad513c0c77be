#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "derived/derived_quantities.hpp"
#include "io/fields_writer.hpp"
#include "observers/grid_share.hpp"
#include "scene/scene.hpp"
#include "scene/time_axis.hpp"

namespace fsi {

/// Whether a case writes fields of any kind.
inline bool writes_fields(const Case& setup) {
  const auto& output = setup.output;
  return output.every > 0 && (!output.fields.empty() || (output.derived.statistics && output.derived.period) ||
                              output.derived.error_indicator);
}

/// The fields that a case asks for and its scene has, per grid. Collective over the processes that share the scene.
template <int n>
std::vector<std::vector<FieldDescription>> wanted_fields(const Case& setup, const Scene<n>& scene,
                                                         const DerivedQuantities<n>& derived,
                                                         const std::vector<FieldGrid>& grids);

/// Names of output.fields that ask for none of these fields, but for those that a case need not give.
template <int n>
std::vector<std::string> unmet_fields(const Case& setup, const std::vector<std::vector<FieldDescription>>& found);

/// Field files of a run: the fields that the case asks for and the scene has, one grid per medium. Cells keep their
/// mid-edge nodes; there pressures are the mean of the edge's ends, as their shape functions have it. Where layers have
/// vertices of their own, the mid-edge nodes between these are written once for each layer.
template <int n>
class FieldOutput {
 public:
  /// Nothing is written when the case asks for no fields.
  /// \param scene, derived  must outlive this
  /// \param grids           of the media, without fields
  /// \param shares          of these grids, where processes share them; else empty
  /// \param axis            must outlive this
  /// \param restarted_from  result folder that the run continues; empty: a new run
  /// \param until           ms, time of the last level in that folder to keep; 0 in a new run
  FieldOutput(const Case& setup, const Scene<n>& scene, const DerivedQuantities<n>& derived,
              std::vector<FieldGrid> grids, std::vector<GridShare> shares, const TimeAxis& axis,
              const std::filesystem::path& folder, const std::filesystem::path& restarted_from, double until);

  /// Writes the state's fields if an entry is planned for its time. Collective over the processes that share the scene.
  /// \returns whether one is planned
  bool write(const State& state);

 private:
  /// A grid that is written.
  struct Grid {
    const NodeShare* share;       ///< of its medium; null: whole
    std::vector<Middle> middles;  ///< of its edges
    std::optional<WholeOrder> order;
  };

  const Scene<n>& scene_;
  const DerivedQuantities<n>& derived_;
  std::vector<FieldGrid> grids_;
  std::vector<Grid> made_;  ///< per grid
  std::unique_ptr<FieldsWriter> writer_;
};

}  // namespace fsi
