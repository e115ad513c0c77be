#include "case/named_lists.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace fsi {

namespace {

constexpr std::array<const char*, 2> lists = {"opening", "support"};
constexpr const char* name_key = "surface";

toml::table by_surface(const std::string& list, toml::array& entries, const CaseSource& source) {
  toml::table named;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const CaseEntry entry(entries[i], fmt::format("{}[{}]", list, i + 1), "", source);
    if (!entry.is_section()) entry.refuse("is no section", "begin each with a line [[" + list + "]]");
    if (!entry.has(name_key)) entry.refuse_missing(name_key, "add it (name of a surface group of the mesh)");
    const CaseEntry surface = entry.child(name_key, "name of a surface group of the mesh");
    const std::string name = surface.line();
    if (name.empty()) surface.refuse_value("is empty", "give the name of a surface group of the mesh");
    if (named.contains(name))
      surface.refuse_value("has a [[" + list + "]] already", "put all that holds there into one");
    toml::table& table = *entries[i].as_table();
    table.erase(name_key);
    named.insert(name, std::move(table));
  }
  return named;
}

}  // namespace

void name_lists_by_surface(toml::table& document, const CaseSource& source) {
  for (const char* list : lists)
    if (auto* entries = document[list].as_array()) {
      toml::table named = by_surface(list, *entries, source);
      document.insert_or_assign(list, std::move(named));
    }
}

}  // namespace fsi
