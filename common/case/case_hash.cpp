#include "case/case_hash.hpp"

#include "base/hash.hpp"
#include "case/case_keys.hpp"

namespace fsi {

std::string canonical_dump(const Case& scene) {
  std::string lines;
  for (const auto& [key, value, role] : values_of_case(scene))
    if (role == KeyRole::physics) lines += key + " = " + value + "\n";
  return lines;
}

std::string hash_of_case(const Case& scene) {
  Fnv1a hash;
  hash.add(canonical_dump(scene));
  return hash.hex();
}

std::map<std::string, std::string> stepping_of_case(const Case& scene) {
  std::map<std::string, std::string> steps;
  for (const auto& [key, value, role] : values_of_case(scene))
    if (role == KeyRole::stepping) steps[key] = value;
  return steps;
}

}  // namespace fsi
