#include "case/case_overrides.hpp"

#include <fmt/format.h>

#include <array>

#include "base/error.hpp"
#include "case/key_depth.hpp"

namespace fsi {

namespace {

/// Entries of which only one can be given: setting `key` removes `rival` from the file.
struct Rivals {
  const char* section;
  const char* key;
  const char* rival;
  bool only_array;  ///< only an array as the value of `key` excludes the rival
};
constexpr std::array<Rivals, 10> rivals = {{{"mesh", "file", "level", false},
                                            {"mesh", "file", "error", false},
                                            {"mesh", "file", "waves", false},
                                            {"mesh", "level", "error", false},
                                            {"mesh", "level", "waves", false},
                                            {"mesh", "error", "file", false},
                                            {"mesh", "error", "level", false},
                                            {"mesh", "level", "file", false},
                                            {"inlet", "pressure", "until", true},
                                            {"load", "pressure", "until", true}}};

std::vector<std::string> parts_of(const std::string& key, const std::string& override_text) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else if (c != ' ' && c != '\t')
      parts.back() += c;
  }
  for (const auto& part : parts)
    if (part.empty())
      throw InputError("--set", one_line(override_text), "has no key", "write --set key=value, e.g. time.end=6.0");
  if (parts.size() > deepest_key)
    throw InputError("--set", one_line(override_text.substr(0, 60)), fmt::format("has a key of {} parts", parts.size()),
                     "see --help-keys for valid keys");
  return parts;
}

/// The value as TOML, or else as it stands: `--set mesh.file=a.msh` needs no quotes.
toml::table parsed_value(const std::string& text) {
  if (line_of_deep_key(text)) return toml::table{{"value", text}};
  try {
    auto table = toml::parse("value = " + text);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
    // a bare string, handled below
  }
  return toml::table{{"value", text}};
}

}  // namespace

void apply_overrides(const std::vector<std::string>& overrides, toml::table& document, CaseSource& source) {
  for (const auto& text : overrides) {
    const auto equals = text.find('=');
    if (equals == std::string::npos)
      throw InputError("--set", one_line(text), "has no '='", "write --set key=value, e.g. time.end=6.0");
    const auto parts = parts_of(text.substr(0, equals), text);
    const auto value = parsed_value(text.substr(equals + 1));
    const auto& node = *value.get("value");

    toml::table* table = &document;
    std::string path;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      path += (i > 0 ? "." : "") + parts[i];
      if (!table->contains(parts[i])) {
        table->insert(parts[i], toml::table{});
        source.overridden.insert(path);
      }
      table = table->get(parts[i])->as_table();
      if (table == nullptr)
        throw InputError("--set", one_line(text), one_line(path) + " is no section", "see --help-keys for valid keys");
    }
    path += (path.empty() ? "" : ".") + parts.back();
    table->insert_or_assign(parts.back(), node);
    source.overridden.insert(path);

    for (const auto& pair : rivals) {
      const auto rival_path = std::string(pair.section) + "." + pair.rival;
      if (path == std::string(pair.section) + "." + pair.key && (!pair.only_array || node.is_array()) &&
          !source.is_overridden(rival_path))
        table->erase(pair.rival);
    }
  }
}

}  // namespace fsi
