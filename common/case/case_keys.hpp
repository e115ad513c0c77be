#pragma once

// The tables of keys. Each key is stated once; reading, `--help-keys`, defaults in messages and the case's hash follow.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "case/case_entry.hpp"

namespace fsi {

/// Whether a key belongs to the case's hash (case_hash.hpp).
enum class KeyRole {
  physics,  ///< it does: the equations depend on it
  running   ///< it does not: names, files, steps, solvers, output, the end of the run
};

/// An effective value of a case, default or given, as canonical text: numbers with round-trip precision.
struct CaseValue {
  std::string key;  ///< its path
  std::string value;
  KeyRole role;
};

/// A line of `--help-keys`.
struct KeyHelp {
  std::string path;
  std::string about;
  bool required = false;
};

/// How a key's value gets into its Target and back to text.
template <class Target>
struct KeyValue {
  std::function<void(const CaseEntry&, Target&)> read;
  std::function<std::string(const Target&)> write;
  std::string standard = {};  ///< replaces {} in `about`: the default, or the names with the default marked
  std::string unit = {};      ///< replaces {unit}
};

/// A key of a section.
template <class Target>
struct CaseKey {
  std::string name;
  bool required;
  std::string about;  ///< meaning, unit and default, for help and messages
  std::function<void(const CaseEntry&, Target&)> read;
  std::function<void(const Target&, const std::string& path, std::vector<CaseValue>&)> list;  ///< its effective values
  KeyRole role = KeyRole::physics;  ///< of a section: running makes all below it running
  std::vector<KeyHelp> below = {};  ///< the keys of a section
};

/// `text` with every `mark` replaced.
std::string replaced(std::string text, const std::string& mark, const std::string& by);

/// Whether a key must be given, for leaf() and section().
namespace presence {
inline constexpr bool required = true, optional = false;
}

/// A key that is no section. \param about  {unit} and {} in it are replaced, see KeyValue
template <class Target>
CaseKey<Target> leaf(const std::string& name, bool required, const std::string& about, KeyValue<Target> value,
                     KeyRole role = KeyRole::physics) {
  return {name,
          required,
          replaced(replaced(about, "{unit}", value.unit), "{}", value.standard),
          value.read,
          [write = value.write, role](const Target& target, const std::string& path, std::vector<CaseValue>& values) {
            values.push_back({path, write(target), role});
          },
          role};
}

/// Reads a section by its table of keys. Refuses unknown keys first, since a misspelt one explains a missing one.
/// \throws InputError
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

/// Appends the effective values of a section.
template <class Target>
void list_keys(const std::vector<CaseKey<Target>>& keys, const Target& target, const std::string& path,
               std::vector<CaseValue>& values) {
  for (const auto& key : keys) key.list(target, path.empty() ? key.name : path + "." + key.name, values);
}

/// A section of a Parent: its keys are read into the Target that `make` finds or makes.
/// \param find   the Target; null: it is not there
/// \param role   running: for all its keys
/// \param check  checks the section as a whole; may be empty
template <class Target, class Parent>
CaseKey<Parent> section(const std::string& name, bool required, const std::string& about,
                        const std::vector<CaseKey<Target>>& keys, std::function<Target&(Parent&)> make,
                        std::function<const Target*(const Parent&)> find, KeyRole role = KeyRole::physics,
                        std::function<void(const CaseEntry&, Target&)> check = nullptr) {
  CaseKey<Parent> key{name, required, about, nullptr, nullptr, role};
  for (const auto& child : keys) {
    key.below.push_back({name + "." + child.name, child.about, child.required});
    for (const auto& grandchild : child.below)
      key.below.push_back({name + "." + grandchild.path, grandchild.about, grandchild.required});
  }
  key.read = [keys, make, check](const CaseEntry& entry, Parent& parent) {
    Target& target = make(parent);
    read_keys(entry, keys, target);
    if (check) check(entry, target);
  };
  key.list = [keys, find, role](const Parent& parent, const std::string& path, std::vector<CaseValue>& values) {
    const Target* target = find(parent);
    if (target == nullptr) return;
    const auto first = values.size();
    list_keys(keys, *target, path, values);
    if (role == KeyRole::running)
      for (auto i = first; i < values.size(); ++i) values[i].role = role;
  };
  return key;
}

// The tables.
const std::vector<CaseKey<Case>>& case_keys();
std::vector<CaseKey<Case>> physics_keys();  ///< of scene, mesh, media, loads and time
CaseKey<Case> mesh_motion_section();        ///< [mesh_motion]
CaseKey<Case> petsc_section();              ///< [petsc]
std::vector<CaseKey<Case>> solver_keys();   ///< of solvers, output and economy

/// All effective values of a case, in the order of the tables. Sections without defaults that it leaves out have none.
std::vector<CaseValue> values_of_case(const Case& scene);

}  // namespace fsi
