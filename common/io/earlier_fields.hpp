#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/fields_writer.hpp"

namespace fsi {

/// Checks fields.h5 of an earlier run, and the files that follow it, without the fields' values: grids, the order of
/// entries and times, and a dataset of the right shape for each field marked as written. fields.xdmf is not read, since
/// a restart makes it anew.
/// \param grids  of the scene, without fields; the file may have further points behind theirs
/// \param until  ms, of the last level that is taken over
/// \returns the number of written entries up to there, 0 when there is no fields.h5
/// \throws InputError when a file is damaged or of another mesh
std::int64_t checked_field_entries(const std::filesystem::path& folder, const std::vector<FieldGrid>& grids,
                                   double until);

/// Refuses a restart in place that would lose fields of an earlier run.
/// \param wanted  GRID.FIELD, those that the restart writes
/// \throws InputError where an entry up to the time `until` (ms) has another one
void require_no_lost_fields(const std::filesystem::path& folder, const std::vector<std::string>& wanted, double until);

}  // namespace fsi
