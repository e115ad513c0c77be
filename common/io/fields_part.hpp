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

/// Which fields an entry has: 0 or 1 by grid and field, in the order of the grids.
using FieldFlags = std::vector<std::vector<std::uint8_t>>;
bool any(const FieldFlags& flags);

/// An entry of a part; without any of its fields it is not written yet.
struct WrittenEntry {
  FieldStep step;
  FieldFlags fields;
};

/// Path of a step's values of a field within a part.
std::string field_dataset(const std::string& grid, const std::string& field, std::int64_t step);

/// One HDF5 file with up to `capacity` entries of a run's fields, complete in itself: grids, and room for the values of
/// all its entries, reserved when it is made. Later only these values and their flags are overwritten; a
/// single process does that without the HDF5 library. So the file can be read after a kill at any moment, and each
/// write costs the same.
/// All functions throw InputError naming the file, WriteError when it cannot be written.
class FieldsPart {
 public:
  static constexpr std::int64_t capacity = 256;

  /// fields.h5 for part 0, then fields-0002.h5, ...
  static std::string name(std::int64_t part);
  /// The number of the part with this file name; empty: the name of something else.
  static std::optional<std::int64_t> number_of(const std::string& name);

  /// An entry that a new part takes over from a finished one.
  struct Source {
    std::filesystem::path file;
    FieldFlags fields;
  };

  /// Makes the part `file` under its temporary name (io/atomic_file.hpp). The first entries are copied from `sources`;
  /// the others are to be written later.
  /// \param processes  that share the grids out; all of them call this
  static void prepare(const std::filesystem::path& file, const std::vector<FieldGrid>& grids,
                      const std::vector<FieldStep>& entries, const std::vector<Source>& sources,
                      const Communicator& processes = Communicator::alone());

  /// The entries of a part of an earlier run, including those that are not written. Refuses grids of another size.
  static std::vector<WrittenEntry> entries_of(const std::filesystem::path& file, const std::vector<FieldGrid>& grids);

  /// Opens a part for writing that prepare() has made for these grids, or for some of their fields.
  FieldsPart(const std::filesystem::path& file, const std::vector<FieldGrid>& grids,
             const Communicator& processes = Communicator::alone());

  std::int64_t entries() const { return static_cast<std::int64_t>(flags_.size()); }
  const FieldFlags& fields_of(std::int64_t place) const { return flags_.at(place); }

  /// Writes all fields of the entry at a place: the values, and once they are on disk the flags that say so.
  /// All processes that share the grids out call this. \param values  per grid and field, places_here() * components
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

  /// Where a field's values and flags are in the file.
  struct Places {
    std::vector<std::uint64_t> values;  ///< per entry, bytes from the file's start
    std::uint64_t flags = 0;            ///< likewise
    // Of a grid that is shared out:
    std::vector<std::string> datasets;  ///< per entry
    std::uint64_t first = 0;            ///< index of this process's first number in them
  };

  const Communicator* processes_;
  FileInPlace file_;
  std::vector<FieldFlags> flags_;            ///< per entry
  std::vector<std::vector<Places>> places_;  ///< per grid and field
};

}  // namespace fsi
