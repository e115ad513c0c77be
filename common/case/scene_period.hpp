#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"

namespace fsi {

class CaseEntry;

/// Keys of the tables and network elements that are periodic, with their periods in ms.
std::vector<std::pair<std::string, double>> periods_of_openings(const Case& setup);

/// The period that all periodic openings share, ms. \param asking  entry that needs it \param key  that can give it
/// instead
/// \throws InputError where none is periodic, or they have different periods
double require_period(const CaseEntry& asking, const Case& setup, const char* key);

/// A sentence for the log on a run that ends when it has become periodic; empty for others.
std::string about_periodic_end(const Case& setup);
/// A sentence on steps that do not fall on the same phases in each period, with a step that does; empty: they do.
std::string about_steps_of_periods(const Case& setup);
/// A sentence for the log on the period of the statistics and where it comes from; empty without statistics.
std::string about_statistics(const Case& setup);

}  // namespace fsi
