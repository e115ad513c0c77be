#include "case/named_lists.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace fsi {

namespace {

/// A list of sections, each with a name.
struct NamedList {
  const char *section, *list;   ///< section: "" for a list at top level
  const char *key, *about;      ///< of the name
  const char* order = nullptr;  ///< key that keeps each entry's place in the list; null: none

  std::string path() const { return *section == '\0' ? list : std::string(section) + "." + list; }
};
constexpr const char* surface = "name of a surface group of the mesh";
constexpr std::array<NamedList, 4> lists = {
    NamedList{"", "opening", "surface", surface}, NamedList{"", "support", "surface", surface},
    NamedList{"network", "element", "name", "name of the element"},
    NamedList{"structure", "region", "name", "name of the region, for messages and fields", "order"}};

toml::table by_name(const NamedList& kind, toml::array& entries, const CaseSource& source) {
  toml::table named;
  const std::string list = kind.path();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const CaseEntry entry(entries[i], fmt::format("{}[{}]", list, i + 1), "", source);
    if (!entry.is_section()) entry.refuse("is no section", "begin each with a line [[" + list + "]]");
    if (!entry.has(kind.key)) entry.refuse_missing(kind.key, fmt::format("add it ({})", kind.about));
    const CaseEntry named_by = entry.child(kind.key, kind.about);
    const std::string name = named_by.line();
    if (name.empty()) named_by.refuse_value("is empty", fmt::format("give the {}", kind.about));
    if (named.contains(name))
      named_by.refuse_value("has a [[" + list + "]] already", std::string(kind.key) == "surface"
                                                                  ? "put all that holds there into one"
                                                                  : "give another name");
    toml::table& table = *entries[i].as_table();
    table.erase(kind.key);
    if (kind.order != nullptr && !table.contains(kind.order))
      table.insert(kind.order, static_cast<std::int64_t>(i + 1));
    named.insert(name, std::move(table));
  }
  return named;
}

}  // namespace

void name_lists(toml::table& document, const CaseSource& source) {
  for (const NamedList& kind : lists) {
    toml::table* section = *kind.section == '\0' ? &document : document[kind.section].as_table();
    auto* entries = section == nullptr ? nullptr : (*section)[kind.list].as_array();
    if (entries == nullptr) continue;
    toml::table named = by_name(kind, *entries, source);
    section->insert_or_assign(kind.list, std::move(named));
  }
}

}  // namespace fsi
