#pragma once

#include <memory>

#include "case/case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "io/fields_writer.hpp"
#include "scene/scene.hpp"
#include "time/time_axis.hpp"

namespace fsi {

/// fields.h5 and fields.xdmf of a run: the fields that the case asks for and the scene has, one grid per medium.
class FieldOutput {
 public:
  /// Nothing is written when the case wants no fields.
  /// \param restarted_from  result folder that the run continues; empty: a new run
  /// \param first_step      last step of the checkpoint, or 0
  FieldOutput(const Case& setup, const Scene<P1Tetrahedron>& scene, const TimeAxis& axis,
              const std::filesystem::path& folder, const std::filesystem::path& restarted_from, int first_step);

  /// Writes the state's fields if its step is a planned one.
  void write(const State& state);

 private:
  const Scene<P1Tetrahedron>& scene_;
  std::vector<FieldGrid> grids_;
  std::unique_ptr<FieldsWriter> writer_;
};

}  // namespace fsi
