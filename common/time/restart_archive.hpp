#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fsi {

/// What an array of a checkpoint has numbers of. That decides its length, and how processes share it out.
enum class ArrayKind {
  alike,              ///< the run: all processes have the same
  support_loads,      ///< loads of the wall's supports, alike
  opening_values,     ///< what the openings keep (Solution::openings), alike
  mesh,               ///< vectors per fluid node
  flow,               ///< vectors and scalars per fluid node
  wall,               ///< vectors and scalars per wall node
  wall_vectors,       ///< vectors per wall node
  interface,          ///< vectors per node between fluid and wall
  interface_columns,  ///< several of these, one after the other
  shear_vectors,      ///< vectors of space per node with wall shear stress
  shear_scalars,      ///< a number per node with wall shear stress
  fluid_cells,        ///< two numbers per cell of the fluid
  wall_cells,         ///< the same of the wall
  wall_branches       ///< what Maxwell branches keep, per cell of their layers
};

/// What a number may be; finite in any case.
struct Range {
  double least = -std::numeric_limits<double>::max(), most = std::numeric_limits<double>::max();
  bool whole = false;
};
inline constexpr Range count_range{0, std::numeric_limits<int>::max(), true};

/// What an array must be besides what its kind says.
struct ArrayRule {
  std::optional<std::size_t> length{};                         ///< numbers here, where the kind does not say it
  std::optional<std::size_t> columns{};                        ///< of interface_columns
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< numbers, of an array of any length
  Range each{};
};

/// What a restart needs to go on bit for bit. The owner of such numbers lists them in one function,
///   void keep(RestartArchive& a) { a.number("age", age_, count_range); a.array("load", kind, load_); }
/// with the name, kind and range of each, which serves both ways: an archive that is written takes the values; one that
/// recalls replaces them by those of an earlier run, which it may check. So an entry is one line.
class RestartArchive {
 public:
  virtual ~RestartArchive() = default;
  /// Whether values come from an earlier run; else they are written down.
  virtual bool recalls() const = 0;
  /// Whether the earlier run has left an entry. Only to be asked where recalls().
  virtual bool has(const std::string& name) const = 0;
  /// The run goes on with another step: Jacobians and differences of the one before must not serve.
  virtual bool step_changed() const { return false; }
  /// For the log: what could not be taken over.
  virtual void warn(const std::string& said) = 0;

  /// An entry that must be there. \throws InputError naming it where it is missing, too long, or holds what it may not
  virtual void array(const std::string& name, ArrayKind kind, std::vector<double>& values,
                     const ArrayRule& rule = {}) = 0;
  virtual void number(const std::string& name, double& value, const Range& range = {}) = 0;
  virtual void integer(const std::string& name, std::int64_t& value, const Range& range = {}) = 0;

  /// For entries that an earlier run may not have: whether values are written down, or any of the names is there.
  bool wants(std::initializer_list<std::string> names) const;
  /// An entry that an earlier run, or another method, may not have; then the value stays.
  void number_if_there(const std::string& name, double& value, const Range& range = {});
  /// A count that is kept among numbers; as above.
  void count_if_there(const std::string& name, int& value);
};

/// Another archive, with something before all names.
class PrefixedArchive : public RestartArchive {
 public:
  /// \param archive  must outlive this
  PrefixedArchive(std::string prefix, RestartArchive& archive) : prefix_(std::move(prefix)), archive_(archive) {}
  bool recalls() const override { return archive_.recalls(); }
  bool has(const std::string& name) const override { return archive_.has(prefix_ + name); }
  bool step_changed() const override { return archive_.step_changed(); }
  void warn(const std::string& said) override { archive_.warn(said); }
  void array(const std::string& name, ArrayKind kind, std::vector<double>& values, const ArrayRule& rule) override {
    archive_.array(prefix_ + name, kind, values, rule);
  }
  void number(const std::string& name, double& value, const Range& range) override {
    archive_.number(prefix_ + name, value, range);
  }
  void integer(const std::string& name, std::int64_t& value, const Range& range) override {
    archive_.integer(prefix_ + name, value, range);
  }

 private:
  std::string prefix_;
  RestartArchive& archive_;
};

/// Entries as they were written down; recalls them within the same program, without checks.
class WrittenArchive : public RestartArchive {
 public:
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, ArrayKind> kinds;  ///< of the arrays
  std::map<std::string, double> numbers;
  std::map<std::string, std::int64_t> integers;

  /// From now on it recalls.
  WrittenArchive& turn(bool step_changed = false);

  bool recalls() const override { return recalls_; }
  bool has(const std::string& name) const override;
  bool step_changed() const override { return step_changed_; }
  void warn(const std::string&) override {}
  void array(const std::string& name, ArrayKind kind, std::vector<double>& values, const ArrayRule& = {}) override;
  void number(const std::string& name, double& value, const Range& = {}) override;
  void integer(const std::string& name, std::int64_t& value, const Range& = {}) override;

 private:
  bool recalls_ = false, step_changed_ = false;
};

/// What `owner.keep()` writes down.
template <class Owner>
WrittenArchive archive_of(Owner& owner) {
  WrittenArchive archive;
  owner.keep(archive);
  return archive;
}

}  // namespace fsi
