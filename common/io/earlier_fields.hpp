#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/fields_writer.hpp"

namespace fsi {

/// Checks fields.h5 of an earlier run, and the files that follow it, without their values: grids, entries and their times
/// in order, a dataset of the right shape for all that is marked as written. fields.xdmf is made anew and not read.
/// \param grids  of the scene, without fields; points may stand behind theirs
/// \param until  ms, of the last level that is taken over
/// \returns the number of written entries up to there, 0 when there is no fields.h5
/// \throws InputError when a file is damaged or of another mesh
std::int64_t checked_field_entries(const std::filesystem::path& folder, const std::vector<FieldGrid>& grids,
                                   double until);

}  // namespace fsi
