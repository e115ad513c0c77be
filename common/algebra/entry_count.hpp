#pragma once

#include <cstdint>

namespace fsi {

/// A count of a matrix's entries or blocks, which positions in it have as `int`.
/// \throws InputError beyond 2^31 - 1, with the remedy: a process that has fewer rows
int entry_count(std::int64_t entries);

}  // namespace fsi
