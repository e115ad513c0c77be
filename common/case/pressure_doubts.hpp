#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// The warnings of doubts that the case does not dispel. A pressure p in a vessel, radius R and thickness h, strains its wall
/// by p R / (E h), E the hoop modulus (materials/material.hpp): with R / h = 5, that of arteries, a value is meant as it stands
/// where that is below one half. A load from outside strains a block by p / E: below 2, since fibres stiffen. Without a wall
/// no doubt is dispelled.
std::vector<std::string> warnings_of_doubts(const std::vector<UnitDoubt>& doubts, const Case& scene);

}  // namespace fsi
