#pragma once

#include <string>

#include "case/case.hpp"

namespace fsi {

/// The entries of a case that determine the discrete equations, one `key = value` per line in a fixed order, numbers
/// with round-trip precision. Left out, so that a run can be extended or rescued: title, [output], [time] end and
/// predictor, the solver sections [monolithic] and [partitioned], and the mesh's path (a checkpoint knows the mesh by
/// its contents).
std::string canonical_dump(const Case& scene);

/// FNV-1a 64 of canonical_dump, 16 hexadecimal digits.
std::string hash_of_case(const Case& scene);

}  // namespace fsi
