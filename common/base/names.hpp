#pragma once

#include <string>
#include <vector>

namespace fsi {

/// Number of single-character insertions, deletions and substitutions that turn a into b (Levenshtein).
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `name` by edit distance; empty when there is no candidate.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// "a, b or c", for messages.
std::string one_of(const std::vector<std::string>& candidates);

}  // namespace fsi
