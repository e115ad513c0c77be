#pragma once

#include <string>

#include "case/case.hpp"

namespace fsi {

// What a case computes, as text and as a hash. It is made from the tables of keys that read case files (case_keys.hpp):
// a new key counts unless its row or its section has KeyRole::running. Those that have it are left out, so that a run
// can be extended, rescued or continued with other steps:
// - title, [mesh] (a checkpoint knows the mesh by its contents), fluid.closed, prestress.file, structure.volume_factor;
// - [time] but for scheme and its parameters, [static];
// - [newton], [linear], [monolithic], [partitioned], [petsc], [output], [economy].
// Keys that the run does not read are left out, too: those of stabilisations with elements that need none.

/// The entries that determine the equations: one `key = value` a line in the order of the tables, defaults too, numbers
/// with round-trip precision.
std::string canonical_dump(const Case& scene);

/// FNV-1a 64 of canonical_dump, 16 hexadecimal digits.
std::string hash_of_case(const Case& scene);

/// The entries of canonical_dump for people: values longer than 200 characters are given by their hash.
std::string readable_dump(const Case& scene);

/// How two readable dumps differ, for a message: the first key that differs, with both values, and how many more do;
/// empty when they agree.
std::string difference_of_cases(const std::string& earlier, const std::string& now);

}  // namespace fsi
