#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// [network]
CaseKey<Case> network_key();

/// Joins openings by the case's network, if it has one, and says in the log what it is. \throws InputError where it does not
/// go with the rest of the case, or has not one solution
void join_network(const CaseEntry& whole_case, Case& scene);

}  // namespace fsi
