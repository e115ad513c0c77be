#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "partitioned/accelerators/filtered_qr.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// What earlier passes tell of a Jacobian: pairs of columns, newest first, those of earlier time steps behind.
class DifferenceColumns {
 public:
  struct Column {
    std::vector<double> v;  ///< difference of residuals
    std::vector<double> w;  ///< what it belongs to: the owner's choice
    int age;                ///< in time steps, or stages
  };

  /// \param most          columns kept
  /// \param reused_steps  earlier time steps, or stages, whose columns are kept
  /// \param filter        a column is dropped when less than this part of its v is new
  DifferenceColumns(int most, int reused_steps, double filter, const InterfaceSpace& space = {})
      : most_(static_cast<std::size_t>(most)), reused_steps_(reused_steps), filter_(filter), space_(space) {}

  /// A time step, or a stage of it, begins.
  void start();
  /// It has ended. What comes before the next one does not depend on the order of its passes, as a restart needs.
  void finish() { qr_.reset(); }
  /// Forgets the columns of the step, or stage, in progress.
  void abandon();
  void add(std::vector<double> v, std::vector<double> w);
  void clear();
  /// Factorises V; columns that the filter drops are forgotten, so that its places are those of the columns left. From
  /// the beginning in each step, or stage, so that a restart has the same bits; then column by column.
  const FilteredQr& factorise();

  bool empty() const { return columns_.empty(); }
  std::size_t size() const { return columns_.size(); }
  const Column& operator[](std::size_t j) const { return columns_[j]; }

  void keep(RestartArchive& archive, const std::string& name);

 private:
  std::size_t most_;
  int reused_steps_;
  double filter_;
  InterfaceSpace space_;
  std::vector<Column> columns_;
  std::optional<FilteredQr> qr_;  ///< of all but the newest
  std::size_t new_ = 0;           ///< how many these are
};

}  // namespace fsi
