#include "case/named_lists.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace fsi {

namespace {

constexpr std::array<const char*, 2> lists = {"opening", "support"};

/// \param order_key  entry that keeps each one's place in the list; null: none
toml::table by_name(const std::string& list, const char* name_key, const std::string& about_name, const char* order_key,
                    toml::array& entries, const CaseSource& source) {
  toml::table named;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const CaseEntry entry(entries[i], fmt::format("{}[{}]", list, i + 1), "", source);
    if (!entry.is_section()) entry.refuse("is no section", "begin each with a line [[" + list + "]]");
    if (!entry.has(name_key)) entry.refuse_missing(name_key, "add it (" + about_name + ")");
    const CaseEntry surface = entry.child(name_key, about_name);
    const std::string name = surface.line();
    if (name.empty()) surface.refuse_value("is empty", "give the " + about_name);
    if (named.contains(name))
      surface.refuse_value("has a [[" + list + "]] already", "put all that holds there into one");
    toml::table& table = *entries[i].as_table();
    table.erase(name_key);
    if (order_key != nullptr && !table.contains(order_key)) table.insert(order_key, static_cast<std::int64_t>(i + 1));
    named.insert(name, std::move(table));
  }
  return named;
}

}  // namespace

void name_lists_by_surface(toml::table& document, const CaseSource& source) {
  for (const char* list : lists)
    if (auto* entries = document[list].as_array()) {
      toml::table named = by_name(list, "surface", "name of a surface group of the mesh", nullptr, *entries, source);
      document.insert_or_assign(list, std::move(named));
    }
  if (auto* structure = document["structure"].as_table())
    if (auto* entries = (*structure)["region"].as_array()) {
      toml::table named =
          by_name("structure.region", "name", "name of the region, for messages and fields", "order", *entries, source);
      structure->insert_or_assign("region", std::move(named));
    }
}

}  // namespace fsi
