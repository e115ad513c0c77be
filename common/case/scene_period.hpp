#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"

namespace fsi {

class CaseEntry;

/// Keys of the tables of openings that are periodic, with their periods in ms.
std::vector<std::pair<std::string, double>> periods_of_openings(const Case& setup);

/// The period that all periodic openings share, ms. \param asking  what needs it \param key  that gives it otherwise
/// \throws InputError where none is periodic, or they have different periods
double require_period(const CaseEntry& asking, const Case& setup, const char* key);

/// A sentence for the log on a run that ends when it has become periodic; empty of others.
std::string about_periodic_end(const Case& setup);
/// What is to be said of steps that do not fall on the same phases in each period, with a step that does; empty: they do.
std::string about_steps_of_periods(const Case& setup);
/// A sentence for the log on the period of the statistics, and whose it is; empty without statistics.
std::string about_statistics(const Case& setup);

}  // namespace fsi
