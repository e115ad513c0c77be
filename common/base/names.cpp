#include "base/names.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include "base/error.hpp"

namespace fsi {

int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  const auto nearest = std::min_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  return nearest == candidates.end() ? std::string() : *nearest;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string one_of(const std::vector<std::string>& candidates) {
  std::string text;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0) text += (i + 1 == candidates.size()) ? " or " : ", ";
    text += candidates[i];
  }
  return text;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string name_remedy(const std::string& name, const std::vector<std::string>& names) {
  if (names.size() < 2) return "give " + one_of(names);
  return "did you mean " + nearest_name(name, names) + "? There are " + one_of(names);
}

void refuse_name(const std::string& what, const std::string& name, const std::vector<std::string>& names) {
  throw InputError("", what, "\"" + name + "\" is unknown", name_remedy(name, names));
}

}  // namespace fsi
