#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A nodal field of a grid.
struct FieldDescription {
  std::string name;    ///< "displacement", "velocity" or "pressure"
  int components = 1;  ///< 1 or 3
  std::string unit;    ///< "mm", "mm/ms", "kPa"
};

/// One medium's grid. Fluid and wall have nodes of their own, since the pressure jumps between them.
struct FieldGrid {
  std::string name;           ///< "fluid", "wall"
  std::vector<Point> points;  ///< N reference positions, mm
  int nodes_per_cell = 4;     ///< 4 or 10: tetrahedra, 3 or 6: triangles; mid-edge nodes in VTK's order
  std::vector<int> cells;     ///< M * nodes_per_cell node numbers below N
  std::vector<int> layer;     ///< M region numbers, written as the cell field "layer"; or empty
  std::vector<FieldDescription> fields;
};

/// An entry of fields.h5.
struct FieldStep {
  std::int64_t step = 0;  ///< its number: of the step in a run with equal steps, else of the entry
  double time = 0;        ///< ms
};

/// Nodal values by (grid, field): N * components doubles, the components of a node side by side.
using FieldValues = std::map<std::pair<std::string, std::string>, std::vector<double>>;

/// Steps 0, every, 2 every, ... and the last one; nothing when every is 0. `time_of` gives a step's time in ms.
std::vector<FieldStep> planned_field_steps(std::int64_t last_step, std::int64_t every,
                                           const std::function<double(std::int64_t)>& time_of);

/// Writes fields.h5 and fields.xdmf (opens in ParaView) so that both can be read after a kill at any moment: fields.h5
/// gets all its datasets when it is created and later only their raw data is overwritten in place; fields.xdmf lists
/// finished steps only and is replaced by rename after the data.
class FieldsWriter {
 public:
  /// Creates both files. `planned` must be ascending in step.
  /// \throws InputError when the files cannot be written
  FieldsWriter(const std::filesystem::path& folder, std::vector<FieldGrid> grids, std::vector<FieldStep> planned);

  /// Continues the fields in folder `from` (may be the same folder): entries up to the time `until` (ms) are kept,
  /// planned ones up to there are not written again; those behind get numbers behind the kept ones. A missing fields.h5 in `from` means that nothing is kept. \throws InputError
  /// when `from` holds grids of another size or an unreadable file
  FieldsWriter(const std::filesystem::path& folder, std::vector<FieldGrid> grids, std::vector<FieldStep> planned,
               const std::filesystem::path& from, double until);

  ~FieldsWriter();
  FieldsWriter(FieldsWriter&&) noexcept;
  FieldsWriter& operator=(FieldsWriter&&) noexcept;

  /// Whether write() has a place for this step; fields need not be gathered otherwise.
  bool wants(std::int64_t step) const;
  /// The number of the entry planned for a time in ms, if there is one.
  std::optional<std::int64_t> entry_at(double time) const;

  /// Writes all fields of all grids at a planned step. Writing a step again replaces it.
  /// \throws InputError when the disk is full
  void write(std::int64_t step, const FieldValues& values);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace fsi
