#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/field_grid.hpp"
#include "io/fields_plan.hpp"
#include "io/file_in_place.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// Which fields an entry has: by grid and field, in the order of the grids.
using FieldFlags = std::vector<std::vector<std::uint8_t>>;
bool any(const FieldFlags& flags);

/// An entry that is on disk.
struct WrittenEntry {
  FieldStep step;
  FieldFlags fields;
};

/// Path of a step's values of a field within a part.
std::string field_dataset(const std::string& grid, const std::string& field, std::int64_t step);

/// One HDF5 file with up to `capacity` entries of a run's fields, complete in itself: grids, and room for the values of
/// all its entries, which is reserved when it is made. Later nothing but these values is overwritten, not through the
/// HDF5 library, so that the file can be read after a kill at any moment, and a write costs the same whenever it is.
/// All functions throw InputError naming the file, WriteError when it cannot be written.
class FieldsPart {
 public:
  static constexpr std::int64_t capacity = 256;

  /// fields.h5 for part 0, then fields-0002.h5, ...
  static std::string name(std::int64_t part);
  /// The part that has this name; none: it is the name of something else.
  static std::optional<std::int64_t> number_of(const std::string& name);

  /// An entry that a new part takes over from a finished one.
  struct Source {
    std::filesystem::path file;
    FieldFlags fields;
  };

  /// Makes the part `file` under its temporary name (io/atomic_file.hpp). The first entries are copied from `sources`, the
  /// others are still to be written.
  /// \param processes  that share the grids out; all of them call this
  static void prepare(const std::filesystem::path& file, const std::vector<FieldGrid>& grids,
                      const std::vector<FieldStep>& entries, const std::vector<Source>& sources,
                      const Communicator& processes = Communicator::alone());

  /// What an earlier run has left: its entries, those that are not written included. Refuses another mesh.
  static std::vector<WrittenEntry> entries_of(const std::filesystem::path& file, const std::vector<FieldGrid>& grids);

  /// Opens a part for writing that `prepare` has made for these grids, or for less of their fields.
  FieldsPart(const std::filesystem::path& file, const std::vector<FieldGrid>& grids,
             const Communicator& processes = Communicator::alone());

  std::int64_t entries() const { return static_cast<std::int64_t>(flags_.size()); }
  const FieldFlags& fields_of(std::int64_t place) const { return flags_.at(place); }

  /// Writes all fields of the entry at a place; first the values, then, when they are on disk, what vouches for them.
  /// All processes that share the grids out call this. \param values  per grid and field, of their sizes here
  void write(std::int64_t place, const std::vector<std::vector<const std::vector<double>*>>& values);

 private:
  static void make(const std::filesystem::path& file, const std::vector<FieldGrid>& grids,
                   const std::vector<FieldStep>& entries, const std::vector<Source>& sources, bool with_values);
  static void fill(const std::filesystem::path& file, const std::vector<FieldGrid>& grids,
                   const std::vector<FieldStep>& entries, const std::vector<Source>& sources,
                   const Communicator& processes);
  void write_values(std::int64_t place, const std::vector<std::vector<const std::vector<double>*>>& values);
  void write_stretches(std::int64_t place, const std::vector<std::vector<const std::vector<double>*>>& values);
  void write_flags(std::int64_t place);
  void write_flags(FileInPlace::Opened& file, std::size_t place) const;

  /// Where in the file what belongs to a field stands.
  struct Places {
    std::vector<std::uint64_t> values;  ///< per entry
    std::uint64_t flags = 0;
    // Of a grid that is shared out:
    std::vector<std::string> datasets;  ///< per entry
    std::uint64_t first = 0;            ///< number in them at which those here begin
  };

  const Communicator* processes_;
  FileInPlace file_;
  std::vector<FieldFlags> flags_;            ///< per entry
  std::vector<std::vector<Places>> places_;  ///< per grid and field
};

}  // namespace fsi
