#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "parallel/communicator.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// Where the arrays of a checkpoint come from, and what they must be like.
struct StoredArrays {
  std::vector<std::string> names;
  std::function<std::vector<double>(const std::string& name, ArrayKind kind)> read;  ///< for all processes together
  std::function<std::optional<std::size_t>(ArrayKind kind)> length;                  ///< as ArrayOrders::length()
};

/// An archive that gives back what a checkpoint holds. It checks that every number is finite and in its range, and
/// every array as long as its kind or its owner says. For all processes together: where one of them refuses, all do.
class RecalledArchive : public RestartArchive {
 public:
  /// \param file  of the checkpoint, for messages
  /// \param head, processes  must outlive this
  RecalledArchive(std::filesystem::path file, const Checkpoint& head, StoredArrays arrays,
                  const Communicator& processes = Communicator::alone());

  const std::filesystem::path& file() const { return file_; }
  bool recalls() const override { return true; }
  bool has(const std::string& name) const override;
  bool step_changed() const override { return step_changed_; }
  /// From now on step_changed().
  void change_step() { step_changed_ = true; }
  void warn(const std::string& said) override { warnings_.push_back(said); }
  const std::vector<std::string>& warnings() const { return warnings_; }

  void array(const std::string& name, ArrayKind kind, std::vector<double>& values, const ArrayRule& rule) override;
  void number(const std::string& name, double& value, const Range& range) override;
  void integer(const std::string& name, std::int64_t& value, const Range& range) override;

  /// Refuses an array that no owner has asked for, unless other methods may have written it. \throws InputError
  /// \param others  prefixes of the names that other methods use \returns the names left to them
  std::vector<std::string> require_all_known(const std::vector<std::string>& others) const;

 private:
  std::filesystem::path file_;
  const Checkpoint& head_;
  StoredArrays arrays_;
  const Communicator& processes_;
  std::set<std::string> asked_;
  bool step_changed_ = false;
  std::vector<std::string> warnings_;
};

/// Refuses an entry of a checkpoint. \throws InputError naming it
[[noreturn]] void refuse_entry(const std::filesystem::path& file, const std::string& name, const std::string& problem);

/// Refuses a number that is not what it may be. \throws InputError
void require_in(const Range& range, double number, const std::filesystem::path& file, const std::string& name);

}  // namespace fsi
