#pragma once

#include <string>

#include "case/case.hpp"

namespace fsi {

// What a case computes, as text and as a hash. It is made from the tables of keys that case files are read by
// (case_keys.hpp): a new key of [fluid], [structure], [inlet], [load], [time] or [static] counts unless its row says
// otherwise. Left out, so that a run can be extended, rescued or continued with other steps: title, [output],
// [economy], [time] step, end, predictor, retries and what adaptive steps go by, [static], volume_factor, the solver sections
// [newton], [linear], [monolithic] and [partitioned], the mesh's path (a checkpoint knows the mesh by its contents, and the steps), and
// keys that the run does not read: those of stabilisations with elements that need none.

/// The entries that determine the equations: one `key = value` a line in the order of the tables, defaults too, numbers
/// with round-trip precision.
std::string canonical_dump(const Case& scene);

/// FNV-1a 64 of canonical_dump, 16 hexadecimal digits.
std::string hash_of_case(const Case& scene);

/// The entries of canonical_dump for people: values longer than 200 characters are given by their hash.
std::string readable_dump(const Case& scene);

/// How two readable dumps differ, for a message: the first key that is not the same, with both values, and how many
/// there are more; empty when they agree.
std::string difference_of_cases(const std::string& earlier, const std::string& now);

}  // namespace fsi
