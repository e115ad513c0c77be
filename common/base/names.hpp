#pragma once

#include <string>
#include <vector>

namespace fsi {

/// Number of single-character insertions, deletions and substitutions that turn a into b (Levenshtein).
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `name` by edit distance; empty when there is no candidate.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// Letters of ASCII in lower case.
std::string lower_case(std::string text);

/// "a, b or c", for messages.
std::string one_of(const std::vector<std::string>& candidates);

bool contains(const std::vector<std::string>& names, const std::string& name);

/// Remedy for a name that is none of `names`: "did you mean b? There are a, b or c"; "give a" if there is only one.
std::string name_remedy(const std::string& name, const std::vector<std::string>& names);

/// Refuses a name that is none of the `names` of the choice `what`. \throws InputError always
[[noreturn]] void refuse_name(const std::string& what, const std::string& name, const std::vector<std::string>& names);

}  // namespace fsi
