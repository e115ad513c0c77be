#include "case/case_keys.hpp"

namespace fsi {

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
  for (auto found = text.find(mark); found != std::string::npos; found = text.find(mark, found + by.size()))
    text.replace(found, mark.size(), by);
  return text;
}

const std::vector<CaseKey<Case>>& case_keys() {
  static const auto keys = [] {
    auto all = physics_keys();
    for (auto& key : solver_keys()) all.push_back(std::move(key));
    return all;
  }();
  return keys;
}

std::vector<CaseValue> values_of_case(const Case& scene) {
  std::vector<CaseValue> values;
  list_keys(case_keys(), scene, "", values);
  return values;
}

}  // namespace fsi
