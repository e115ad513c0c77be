#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// `structure.region`: parts of the wall with constants of their own, read once the layers are.
CaseKey<StructureData> regions_key();

}  // namespace fsi
