#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// The warnings of doubts that the case does not dispel. A pressure p in a vessel of radius R and thickness h strains
/// its wall by p R / (E h), E being the largest hoop modulus (materials/material.hpp). With R / h = 5, as in arteries,
/// a value is accepted if that is at most one half. A load from outside strains a block by p / E: accepted up to 2,
/// since fibres stiffen. Without a wall no doubt is dispelled.
std::vector<std::string> warnings_of_doubts(const std::vector<UnitDoubt>& doubts, const Case& scene);

}  // namespace fsi
