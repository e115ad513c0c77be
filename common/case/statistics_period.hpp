#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"

namespace fsi {

/// Keys of the tables of openings that are periodic, with their periods in ms: statistics without output.period are of
/// the one that all have.
std::vector<std::pair<std::string, double>> periods_of_openings(const Case& setup);

/// A sentence for the log on the period of the statistics, and whose it is; empty without statistics.
std::string about_statistics(const Case& setup);

}  // namespace fsi
