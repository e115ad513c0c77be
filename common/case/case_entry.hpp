#pragma once

// Entries of a case file. Shared by the files that read cases; nothing else should need TOML.

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/quantity.hpp"

namespace fsi {

/// Text from the user as part of a one-line message: control characters are replaced by blanks.
std::string one_line(std::string text);

/// Limits of a number's size, wide enough for any unit. Beyond them squares and quotients overflow or vanish.
constexpr double smallest_size = 1e-100, largest_size = 1e100;

/// A value that seems to be in a wrong unit unless the wall is stiff enough to bear it (case/pressure_doubts.hpp).
struct UnitDoubt {
  std::string key;
  double value;
  std::string warning;
};

/// Where the entries of a case come from, for messages.
struct CaseSource {
  std::string file;                  ///< as the user wrote it
  std::set<std::string> overridden;  ///< key paths that --set has put in place; all below them counts as well
  /// What looks wrong but is not refused. Mutable, since entries have a const source.
  mutable std::vector<std::string> warnings;
  mutable std::vector<UnitDoubt> doubts{};     ///< warnings that depend on the whole case
  mutable std::vector<std::string> remarks{};  ///< what the reader did, such as conversions of units, for the log
  /// Present key path to the name of an earlier version that the case uses (case/renamed_keys.hpp).
  std::map<std::string, std::string> former_of{};

  std::string name_in_case(const std::string& key) const;
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
  /// As refuse, with the value before the problem, "-1 is not positive", and the entry's meaning behind the remedy.
  [[noreturn]] void refuse_value(const std::string& problem, const std::string& remedy) const;

  /// As refuse_value, without the entry's meaning: for choices, where the remedy says it all.
  [[noreturn]] void refuse_name(const std::string& problem, const std::string& remedy) const;
  /// For a key that is missing in this section: placed at the section's header.
  [[noreturn]] void refuse_missing(const std::string& name, const std::string& remedy) const;

  /// Adds a warning with place and key to the source.
  void warn(const std::string& problem, const std::string& remedy) const;
  /// Adds a remark with the key to the source.
  void remark(const std::string& text) const;
  /// Warns when the value seems to be in a wrong unit; for loads of the wall this waits until the whole case is read.
  /// \return whether it seems so
  bool warn_of_unit(const Quantity& quantity, double value) const;

  // Conversions; each throws InputError when the entry is of another type.
  double number() const;                          ///< 0, or of a size from smallest_size to largest_size
  double number(const Quantity& quantity) const;  ///< as number(), with a warning when it seems to be in a wrong unit
  int whole_number(int low, int high) const;      ///< both ends included
  bool boolean() const;
  std::string text() const;
  /// Text that is shown to people and stands in tables: one line of printable characters, at most 1,000 bytes.
  std::string line() const;
  /// A file, by a line(): relative to the case file; given by --set, relative to the working directory if it exists
  /// there. \param what  "path of a file", for the remedy of an empty name
  std::filesystem::path path(const std::string& what) const;
  std::vector<CaseEntry> elements() const;
  bool is_array() const { return node_->is_array(); }
  bool is_text() const { return node_->is_string(); }
  bool is_section() const { return node_->is_table(); }

  /// Entries of a section in the order of the file. \throws InputError when this is no section
  std::vector<CaseEntry> children() const;
  /// The child of this name; if there is none this section itself, as the best place for messages.
  CaseEntry child(const std::string& name, const std::string& about = "") const;
  bool has(const std::string& name) const;

 private:
  std::string path_of(const std::string& name) const { return key_.empty() ? name : key_ + "." + name; }
  [[noreturn]] void refuse_type(const std::string& expected) const;

  const toml::node* node_;
  std::string key_, about_;
  const CaseSource* source_;
};

/// \throws InputError for an entry whose name is not among `known`, with the nearest that is
void refuse_unknown_keys(const CaseEntry& section, const std::vector<std::string>& known);

}  // namespace fsi
