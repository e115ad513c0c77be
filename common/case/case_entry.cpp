#include "case/case_entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/renamed_keys.hpp"

namespace fsi {

namespace {

const char* type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a section";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a decimal number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

/// At most 60 bytes, not cutting a UTF-8 character.
std::string shortened(const std::string& text) {
  std::size_t cut = 60;
  if (text.size() <= cut) return text;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0u) == 0x80u) --cut;
  return text.substr(0, cut) + "...";
}

std::string value_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return "\"" + shortened(text->get()) + "\"";
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* decimal = node.as_floating_point()) return fmt::format("{}", decimal->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* array = node.as_array()) {
    std::string text;
    for (const auto& element : *array) {
      if (!text.empty()) text += ", ";
      text += value_text(element);
      if (text.size() > 60) break;
    }
    return shortened("[" + text + "]");
  }
  if (node.is_table()) return "a section";
  std::ostringstream date;
  node.visit([&](const auto& value) { date << value; });
  return date.str();
}

}  // namespace

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20u || c == 0x7f) c = ' ';
  return text;
}

bool CaseSource::is_overridden(const std::string& key) const {
  constexpr const char* within = ".[";  // sections, and elements of lists
  for (auto end = key.find_first_of(within); end != std::string::npos; end = key.find_first_of(within, end + 1))
    if (overridden.count(key.substr(0, end)) > 0) return true;
  return overridden.count(key) > 0;
}

std::string CaseSource::name_in_case(const std::string& key) const {
  const auto former = former_of.find(key);
  return former == former_of.end() ? key : former->second;
}

std::string CaseSource::place(const std::string& key, const toml::source_region& region) const {
  if (is_overridden(key)) return "--set";
  return region.begin.line > 0 ? fmt::format("{}:{}", file, region.begin.line) : file;
}

void CaseEntry::refuse(const std::string& problem, const std::string& remedy) const {
  // The whole file begins in line 1, which would say nothing.
  const std::string place = key_.empty() ? source_->file : source_->place(key_, node_->source());
  throw InputError(place, one_line(source_->name_in_case(key_)), one_line(problem), one_line(remedy));
}

void CaseEntry::refuse_value(const std::string& problem, const std::string& remedy) const {
  refuse(value_text(*node_) + " " + problem, about_.empty() ? remedy : remedy + " (" + about_ + ")");
}

void CaseEntry::refuse_name(const std::string& problem, const std::string& remedy) const {
  refuse(value_text(*node_) + " " + problem, remedy);
}

void CaseEntry::refuse_type(const std::string& expected) const {
  if (node_->is_table()) refuse("is a section", "give " + expected + (about_.empty() ? "" : " (" + about_ + ")"));
  refuse_value(std::string("is ") + type_name(*node_), "give " + expected);
}

void CaseEntry::refuse_missing(const std::string& name, const std::string& remedy) const {
  const std::string place = key_.empty() ? source_->file : source_->place(key_, node_->source());
  throw InputError(place, one_line(path_of(name)), "missing", remedy);
}

double CaseEntry::number() const {
  double value = 0;
  if (const auto* decimal = node_->as_floating_point())
    value = decimal->get();
  else if (const auto* whole = node_->as_integer())
    value = static_cast<double>(whole->get());
  else
    refuse_type("a number");
  if (!std::isfinite(value)) refuse_value("is not finite", "give a finite number");
  if (value != 0 && !(std::abs(value) >= smallest_size && std::abs(value) <= largest_size))
    refuse_value(std::abs(value) > 1 ? "is out of range: too large" : "is out of range: too close to 0",
                 fmt::format("give 0 or a number of a size from {:g} to {:g}", smallest_size, largest_size));
  return value;
}

double CaseEntry::number(const Quantity& quantity) const {
  const double value = number();
  warn_of_unit(quantity, value);
  return value;
}

void CaseEntry::warn(const std::string& problem, const std::string& remedy) const {
  source_->warnings.emplace_back(
      InputError(source_->place(key_, node_->source()), one_line(key_), problem, remedy).what());
}

void CaseEntry::remark(const std::string& text) const {
  source_->remarks.push_back(one_line(key_ + ": " + text));
}

bool CaseEntry::warn_of_unit(const Quantity& quantity, double value) const {
  const auto slip = unit_slip(quantity, value);
  if (!slip) return false;
  const std::string warning = InputError(source_->place(key_, node_->source()), one_line(key_),
                                         fmt::format("{:g} looks like a value in {}", value, slip->unit),
                                         fmt::format("did you mean {:.3g} {}?", slip->meant, quantity.unit))
                                  .what();
  if (quantity.borne_by_wall)
    source_->doubts.push_back({key_, value, warning});
  else
    source_->warnings.push_back(warning);
  return true;
}

int CaseEntry::whole_number(int low, int high) const {
  const auto* whole = node_->as_integer();
  if (whole == nullptr) refuse_type(fmt::format("a whole number from {} to {}", low, high));
  if (whole->get() < low || whole->get() > high)
    refuse_value("is out of range", fmt::format("give a whole number from {} to {}", low, high));
  return static_cast<int>(whole->get());
}

bool CaseEntry::boolean() const {
  const auto* flag = node_->as_boolean();
  if (flag == nullptr) refuse_type("true or false");
  return flag->get();
}

std::string CaseEntry::text() const {
  const auto* text = node_->as_string();
  if (text == nullptr) refuse_type("a string in quotes");
  return text->get();
}

std::string CaseEntry::line() const {
  constexpr std::size_t longest = 1000;
  auto given = text();
  if (one_line(given) != given) refuse_value("holds control characters", "give one line of printable text");
  if (given.size() > longest)
    refuse_value(fmt::format("is {} bytes long", given.size()), fmt::format("give at most {}", longest));
  return given;
}

std::filesystem::path CaseEntry::path(const std::string& what) const {
  const std::string name = line();
  if (name.empty()) refuse_value("is empty", "give the " + what);
  std::error_code error;
  if (source_->is_overridden(key_) && std::filesystem::exists(name, error)) return name;
  return std::filesystem::path(source_->file).parent_path() / name;
}

std::vector<CaseEntry> CaseEntry::elements() const {
  const auto* array = node_->as_array();
  if (array == nullptr) refuse_type("an array");
  std::vector<CaseEntry> entries;
  for (const auto& element : *array)
    entries.emplace_back(element, fmt::format("{}[{}]", key_, entries.size()), "", *source_);
  return entries;
}

std::vector<CaseEntry> CaseEntry::children() const {
  const auto* table = node_->as_table();
  if (table == nullptr) refuse(value_text(*node_) + " is " + type_name(*node_), "make it a section [" + key_ + "]");
  std::vector<std::pair<toml::source_position, CaseEntry>> found;
  for (const auto& [name, node] : *table)
    found.emplace_back(node.source().begin, CaseEntry(node, path_of(std::string(name.str())), "", *source_));
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<CaseEntry> entries;
  for (const auto& [position, entry] : found) entries.push_back(entry);
  return entries;
}

CaseEntry CaseEntry::child(const std::string& name, const std::string& about) const {
  const auto* table = node_->as_table();
  const auto* node = table == nullptr ? nullptr : table->get(name);
  return node == nullptr ? *this : CaseEntry(*node, path_of(name), about, *source_);
}

bool CaseEntry::has(const std::string& name) const {
  const auto* table = node_->as_table();
  return table != nullptr && table->contains(name);
}

void refuse_unknown_keys(const CaseEntry& section, const std::vector<std::string>& known) {
  const std::string prefix = section.key().empty() ? "" : section.key() + ".";
  for (const auto& entry : section.children()) {
    const auto name = entry.key().substr(prefix.size());  // a quoted key may hold dots
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto former = nearest_name(name, former_names(section.key()));
    if (!former.empty() && edit_distance(name, former) <= 2)
      entry.refuse("unknown key", "did you mean " + prefix + former + "?");
    const auto nearest = nearest_name(name, known);
    const std::string problem = entry.is_section() ? "unknown section" : "unknown key";
    // Where most letters differ, the nearest name is none that was meant.
    if (static_cast<std::size_t>(edit_distance(name, nearest)) >= name.size() && known.size() > 1)
      entry.refuse(problem, "there are " + one_of(known));
    entry.refuse(problem, "did you mean " + prefix + nearest + "?");
  }
}

}  // namespace fsi
