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

/// XDMF 2 text that presents fields.h5 as a temporal collection of spatial collections, one grid per medium.
std::string xdmf_text(const std::vector<FieldGrid>& grids, const std::vector<FinishedStep>& finished);

}  // namespace fsi
