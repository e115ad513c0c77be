#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// [network]
CaseKey<Case> network_key();

/// Joins openings by the case's network, if it has one, with a remark on it for the log.
/// \throws InputError where it contradicts the rest of the case, or has no unique solution
void join_network(const CaseEntry& whole_case, Case& scene);

}  // namespace fsi
