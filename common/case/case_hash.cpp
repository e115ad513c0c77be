#include "case/case_hash.hpp"

#include <map>
#include <set>
#include <sstream>

#include "base/hash.hpp"
#include "case/case_keys.hpp"

namespace fsi {

namespace {

constexpr std::size_t longest_value = 200, longest_shown = 60;

/// Whether a run reads a key: Taylor-Hood elements have no stabilisation.
bool is_read(const std::string& key, const Case& scene) {
  if (scene.element != ElementPair::p2p1) return true;
  return key != "stabilisation" && key != "fluid.grad_div" && key != "structure.stabilisation";
}

/// One `key = change(value)` per line.
template <class Change>
std::string dump(const Case& scene, Change change) {
  std::string lines;
  for (const auto& [key, value, role] : values_of_case(scene))
    if (role == KeyRole::physics && is_read(key, scene)) lines += key + " = " + change(value) + "\n";
  return lines;
}

std::map<std::string, std::string> entries_of(const std::string& dump) {
  std::map<std::string, std::string> entries;
  std::istringstream lines(dump);
  for (std::string line; std::getline(lines, line);)
    if (const auto sign = line.find(" = "); sign != std::string::npos)
      entries[line.substr(0, sign)] = line.substr(sign + 3);
  return entries;
}

std::string shown(const std::map<std::string, std::string>& entries, const std::string& key) {
  const auto found = entries.find(key);
  if (found == entries.end()) return "not there";
  const std::string& value = found->second;
  return value.size() <= longest_shown ? value : value.substr(0, longest_shown) + "...";
}

}  // namespace

std::string canonical_dump(const Case& scene) {
  return dump(scene, [](const std::string& value) { return value; });
}

std::string readable_dump(const Case& scene) {
  return dump(scene, [](const std::string& value) {
    if (value.size() <= longest_value) return value;
    Fnv1a hash;
    hash.add(value);
    return "(hash " + hash.hex() + ")";
  });
}

std::string difference_of_cases(const std::string& earlier, const std::string& now) {
  const auto then_entries = entries_of(earlier), now_entries = entries_of(now);
  std::set<std::string> differ;
  for (const auto* entries : {&then_entries, &now_entries})
    for (const auto& [key, value] : *entries) {
      const auto then_entry = then_entries.find(key), now_entry = now_entries.find(key);
      if (then_entry == then_entries.end() || now_entry == now_entries.end() || then_entry->second != now_entry->second)
        differ.insert(key);
    }
  if (differ.empty()) return {};
  const std::string& key = *differ.begin();
  return key + " was " + shown(then_entries, key) + " and is " + shown(now_entries, key) +
         (differ.size() > 1 ? ", and so on for " + std::to_string(differ.size() - 1) + " more keys" : "");
}

std::string hash_of_case(const Case& scene) {
  Fnv1a hash;
  hash.add(canonical_dump(scene));
  return hash.hex();
}

}  // namespace fsi
