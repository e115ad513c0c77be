#include "case/renamed_keys.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "base/error.hpp"

namespace fsi {

namespace {

/// A key as version 0.2 named it, and its present section and name.
struct Renamed {
  const char *former_section, *former_name, *section, *name;

  std::string former() const { return fmt::format("{}.{}", former_section, former_name); }
  std::string present() const { return fmt::format("{}.{}", section, name); }
};
constexpr std::array<Renamed, 10> renamed = {{
    {"monolithic", "mode", "newton", "mode"},
    {"monolithic", "newton_tolerance", "newton", "tolerance"},
    {"monolithic", "error_tolerance", "newton", "error_tolerance"},
    {"monolithic", "residual_tolerance", "newton", "residual_tolerance"},
    {"monolithic", "max_iterations", "newton", "max_iterations"},
    {"monolithic", "linear_tolerance", "linear", "tolerance"},
    {"monolithic", "max_linear_iterations", "linear", "max_iterations"},
    {"monolithic", "krylov_restart", "linear", "restart"},
    {"monolithic", "direct_below", "linear", "direct_below"},
    {"partitioned", "direct_below", "linear", "direct_below"},
}};

/// The section of this name, made where there is none; null where the name stands for something else, which reading it
/// refuses.
toml::table* section_of(toml::table& document, const char* name) {
  if (!document.contains(name)) document.insert(name, toml::table{});
  return document.get(name)->as_table();
}

void rename(const Renamed& key, toml::table& document, CaseSource& source) {
  toml::node* const holder = document.get(key.former_section);
  toml::table* const former = holder == nullptr ? nullptr : holder->as_table();
  if (former == nullptr || !former->contains(key.former_name)) return;
  toml::table* const present = section_of(document, key.section);
  if (present == nullptr) return;

  toml::node& node = *former->get(key.former_name);
  const bool set = source.overridden.count(key.former()) > 0;
  const auto place = source.place(key.former(), node.source());
  if (present->contains(key.name)) {
    if (set == (source.overridden.count(key.present()) > 0)) {
      const auto other = source.former_of.find(key.present());
      throw InputError(place, key.former(),
                       fmt::format("stands beside {}, another name of the same",
                                   other == source.former_of.end() ? key.present() : other->second),
                       fmt::format("keep {}", key.present()));
    }
    if (!set) {
      former->erase(key.former_name);
      return;
    }
  }
  node.visit(
      [&](auto& value) { present->insert_or_assign(key.name, std::move(value)); });  // with its place in the file
  former->erase(key.former_name);
  if (set) source.overridden.insert(key.present());
  source.former_of[key.present()] = key.former();
  source.remarks.push_back(
      fmt::format("{}: {}: is read as {}, which is its name now; this one is valid in this version for the last time",
                  place, key.former(), key.present()));
}

}  // namespace

void rename_keys(toml::table& document, CaseSource& source) {
  for (const auto& key : renamed) rename(key, document, source);
}

std::vector<std::string> former_names(const std::string& section) {
  std::vector<std::string> names;
  for (const auto& key : renamed)
    if (section == key.former_section) names.emplace_back(key.former_name);
  return names;
}

}  // namespace fsi
