#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "io/field_grid.hpp"
#include "io/fields_plan.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// Writes the fields of a run: fields.h5, followed by fields-0002.h5 and so on for more than 256 entries
/// (io/fields_part.hpp), and the time series fields.xdmf, fluid.xdmf and wall.xdmf, which list the finished entries of
/// all of them (io/xdmf.hpp). They can be read after a kill at any moment. The costs of the start and of an entry do
/// not grow with the number of entries, but the lists are rewritten whenever they have doubled.
class FieldsWriter {
 public:
  /// Creates the first HDF5 file and the lists. \throws WriteError
  /// \param processes  that share the grids out: they make and use their writers together, and must outlive them
  FieldsWriter(const std::filesystem::path& folder, std::vector<FieldGrid> grids, FieldPlan plan,
               const Communicator& processes = Communicator::alone());

  /// Continues the fields in folder `from` (may be the same folder): entries up to the time `until` (ms) are kept,
  /// planned ones up to there are not written again, and later ones get numbers behind the kept ones. Without fields.h5
  /// in `from` nothing is kept. \throws InputError when `from` holds grids of another size or an unreadable file,
  /// WriteError
  FieldsWriter(const std::filesystem::path& folder, std::vector<FieldGrid> grids, FieldPlan plan,
               const std::filesystem::path& from, double until, const Communicator& processes = Communicator::alone());

  ~FieldsWriter();
  FieldsWriter(FieldsWriter&&) noexcept;
  FieldsWriter& operator=(FieldsWriter&&) noexcept;

  /// The number of the entry planned for a time in ms, if there is one.
  std::optional<std::int64_t> entry_at(double time) const;

  /// Writes all fields of all grids to the planned entry of this number. Writing it again replaces it.
  /// \throws WriteError when the disk is full, or a file has been removed or replaced; std::logic_error when the entry
  ///         is not planned or `values` have wrong sizes
  void write(std::int64_t step, const FieldValues& values);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace fsi
