#pragma once

#include <vector>

#include "case/case_keys.hpp"

namespace fsi {

/// The sections [output.points], [output.lines.NAME] and [output.planes.NAME].
std::vector<CaseKey<OutputData>> sample_keys();

}  // namespace fsi
