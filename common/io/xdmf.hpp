#pragma once

#include <string>
#include <vector>

#include "io/fields_writer.hpp"

namespace fsi {

/// Path of a step's values of a field within fields.h5.
std::string field_dataset(const std::string& grid, const std::string& field, std::int64_t step);

/// A finished step in fields.h5 and the (grid, field) pairs that it has.
struct FinishedStep {
  FieldStep step;
  std::vector<std::pair<std::string, std::string>> fields;
};

/// XDMF 2 text that presents fields.h5 as a spatial collection of temporal ones, one per medium. The other way round,
/// time outside, ParaView would number the media anew in each step ("fluid", "fluid[1]", ...), and a block picked in
/// one step would be lost in the next.
std::string xdmf_text(const std::vector<FieldGrid>& grids, const std::vector<FinishedStep>& finished);

}  // namespace fsi
