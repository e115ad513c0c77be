#pragma once

// Shared by the files that read cases; nothing else should need TOML.

#include <toml++/toml.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace fsi {

/// Text from the user as part of a one-line message: without line breaks and other control characters.
std::string printable(std::string text);

/// Where the entries of a case come from, for messages.
struct CaseSource {
  std::string file;                  ///< as the user wrote it
  std::set<std::string> overridden;  ///< key paths that --set has put in place; all below them counts as well

  bool is_overridden(const std::string& key) const;
  /// "case.toml:12", "--set", or "case.toml" when there is no line.
  std::string place(const std::string& key, const toml::source_region& region) const;
};

/// One entry of a case file, with all that a message about it needs. Refers to the document, which must outlive it.
class CaseEntry {
 public:
  /// \param key    key path, "structure.layers.media.c10"; empty for the whole file
  /// \param about  meaning and unit of the entry
  CaseEntry(const toml::node& node, std::string key, std::string about, const CaseSource& source)
      : node_(&node), key_(std::move(key)), about_(std::move(about)), source_(&source) {}

  const std::string& key() const { return key_; }
  const CaseSource& source() const { return *source_; }
  /// \throws InputError that names place, key, problem and remedy
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;
  /// As refuse; the value is put before the problem, "-1 is not positive", and what the entry means behind the remedy.
  [[noreturn]] void refuse_value(const std::string& problem, const std::string& remedy) const;

  /// As refuse_value, without what the entry means: for a choice, where the remedy says it all.
  [[noreturn]] void refuse_name(const std::string& problem, const std::string& remedy) const;
  /// For a key that this section lacks: placed at the section's header.
  [[noreturn]] void refuse_missing(const std::string& name, const std::string& remedy) const;

  // Conversions; each throws InputError when the entry is of another type.
  double number() const;  ///< finite
  int whole_number() const;
  bool boolean() const;
  std::string text() const;
  std::vector<CaseEntry> elements() const;
  bool is_array() const { return node_->is_array(); }
  bool is_section() const { return node_->is_table(); }

  /// Entries of a section in the order of the file. \throws InputError when this is no section
  std::vector<CaseEntry> children() const;
  /// The child of this name; this section itself, for want of a better place, when there is none.
  CaseEntry child(const std::string& name, const std::string& about = "") const;
  bool has(const std::string& name) const;

 private:
  std::string path_of(const std::string& name) const { return key_.empty() ? name : key_ + "." + name; }
  [[noreturn]] void refuse_type(const std::string& expected) const;

  const toml::node* node_;
  std::string key_, about_;
  const CaseSource* source_;
};

/// A line of `--help-keys`.
struct KeyHelp {
  std::string path;
  std::string about;
  bool required = false;
};

/// A key of a section: what it means, and how its entry gets into the Target.
template <class Target>
struct CaseKey {
  using Reader = std::function<void(const CaseEntry&, Target&)>;

  std::string name;
  bool required;
  std::string about;  ///< meaning and unit
  Reader read;
  std::vector<KeyHelp> below;  ///< the keys of a section

  CaseKey(std::string name_, bool required_, std::string about_, Reader read_, std::vector<KeyHelp> below_ = {})
      : name(std::move(name_)),
        required(required_),
        about(std::move(about_)),
        read(std::move(read_)),
        below(std::move(below_)) {}
};

/// \throws InputError for an entry whose name is not among `known`, with the nearest that is
void refuse_unknown_keys(const CaseEntry& section, const std::vector<std::string>& known);

/// Reads a section by its table of keys: misspelt ones first, since they explain missing ones.
template <class Target>
void read_keys(const CaseEntry& section, const std::vector<CaseKey<Target>>& keys, Target& target) {
  std::vector<std::string> known;
  for (const auto& key : keys) known.push_back(key.name);
  refuse_unknown_keys(section, known);
  for (const auto& key : keys) {
    if (section.has(key.name))
      key.read(section.child(key.name, key.about), target);
    else if (key.required)
      section.refuse_missing(key.name, "add it (" + key.about + ")");
  }
}

}  // namespace fsi
