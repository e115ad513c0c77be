#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/fields_part.hpp"
#include "io/file_in_place.hpp"

namespace fsi {

/// A finished entry: its step, its fields, and the HDF5 file beside the document that holds them.
struct ListedEntry {
  WrittenEntry entry;
  std::string file;
};

/// An XDMF 3 document that presents the HDF5 files as time series. It comes in two forms:
/// - All media (fields.xdmf): a spatial collection of temporal ones. With time outside, ParaView would number the media
///   anew in each step ("fluid", "fluid[1]", ...), and a block picked in one step would be lost in the next.
/// - One medium (fluid.xdmf, wall.xdmf): its temporal collection alone, which is what meshio.xdmf.TimeSeriesReader and
///   other readers of series on one mesh take.
/// An attribute has no child but its values, since meshio refuses others: units are <Information> beside them.
///
/// A document lists finished entries only and is complete at any moment. The list of each medium has free slots of one
/// length. A slot begins with a processing instruction, which readers skip. While the slot is free, that instruction
/// extends to the slot's end:
///     <?slot  >                                      ?>      free
///     <?slot  > <Grid> ... </Grid>             <?slot?>      free: the text is still a part of the instruction
///     <?slot ?> <Grid> ... </Grid>             <?slot?>      in use
/// So an entry is added by two writes into reserved space, the second of a single byte. When no slot is free, the
/// document is rewritten with twice as many and replaces the old one by rename: over a run, an entry is written fewer
/// than three times on average.
/// All functions throw WriteError.
class XdmfDocument {
 public:
  static constexpr std::int64_t first_slots = 256;

  /// Of all media.
  XdmfDocument(std::filesystem::path file, std::vector<FieldGrid> grids);
  /// Of grids[medium] alone. Entries still have the flags of all grids.
  XdmfDocument(std::filesystem::path file, const std::vector<FieldGrid>& grids, std::size_t medium);

  /// Makes the document, or replaces it, with `count` entries.
  /// \param total  number of entries that it will have in the end
  void replace(std::int64_t count, const std::function<ListedEntry(std::int64_t)>& entry, std::int64_t total);

  /// Lists one more entry.
  void add(const ListedEntry& entry);

 private:
  void prepare(const std::string& first_head);
  using Slot = std::function<std::string(std::size_t grid, std::int64_t place)>;
  void rewrite(std::int64_t count, const Slot& slot);
  std::string slot_text(std::size_t grid, const ListedEntry& entry, bool in_use) const;
  std::uint64_t place_of(std::size_t grid, std::int64_t slot) const;

  std::filesystem::path path_;
  std::vector<FieldGrid> grids_;     ///< without cells and layers
  std::vector<std::size_t> places_;  ///< of the grids among those of the entries
  std::string tail_;                 ///< behind the slots of the last grid
  std::vector<std::size_t> cells_;
  std::vector<bool> layered_;
  std::vector<std::string> head_;    ///< before the slots of each grid
  std::vector<std::size_t> length_;  ///< of a grid's slots, bytes
  std::int64_t count_ = 0, slots_ = 0, total_ = 0;
  std::optional<FileInPlace> file_;
};

}  // namespace fsi
