#pragma once

#include <array>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "derived/derived_quantities.hpp"
#include "io/fields_writer.hpp"
#include "scene/scene.hpp"
#include "time/time_axis.hpp"

namespace fsi {

/// fields.h5 and fields.xdmf of a run: the fields that the case asks for and the scene has, one grid per medium. Cells
/// keep their mid-edge nodes; there pressures and stresses are the mean of the edge's ends, as the pressure's shape functions have it. Where layers
/// have vertices of their own, the nodes between these are written once for each.
template <int n>
class FieldOutput {
 public:
  /// Nothing is written when the case wants no fields.
  /// \param derived         what fields are made of that are not the solution itself; must outlive this, as the scene
  /// \param grids           of the media, without fields
  /// \param axis            must outlive this
  /// \param restarted_from  result folder that the run continues; empty: a new run
  /// \param until           ms, of the last level that the run there has written, or 0
  FieldOutput(const Case& setup, const Scene<n>& scene, const DerivedQuantities<n>& derived,
              std::vector<FieldGrid> grids, const TimeAxis& axis, const std::filesystem::path& folder,
              const std::filesystem::path& restarted_from, double until);

  /// Writes the state's fields if an entry is planned for its time. Returns whether there is one.
  bool write(const State& state);

 private:
  /// A point in the middle of an edge.
  struct Middle {
    int point, node;  ///< of the grid that is written, of the state
    std::array<int, 2> ends;
  };
  /// Gives the cells of a grid that have a mid-edge node in common, but not its ends, points of their own.
  static std::vector<Middle> separate_middles(FieldGrid& grid);

  std::array<int, n> axes_;
  const DerivedQuantities<n>& derived_;
  Profile& profile_;
  std::vector<FieldGrid> grids_;
  std::vector<std::vector<Middle>> middles_;  ///< per grid
  std::unique_ptr<FieldsWriter> writer_;
};

}  // namespace fsi
