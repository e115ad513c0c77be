#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "partitioned/accelerators/filtered_qr.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// Differences of passes as secant information on a Jacobian: pairs of columns, newest first, those of earlier time
/// steps behind.
class DifferenceColumns {
 public:
  struct Column {
    std::vector<double> v;  ///< difference of residuals
    std::vector<double> w;  ///< what it belongs to: the owner's choice
    int age;                ///< calls of start() since: time steps or stages, repeated attempts included
  };

  /// \param most          columns kept
  /// \param reused_steps  earlier time steps, or stages, whose columns are kept
  /// \param filter        a column is dropped when less than this part of its v is new
  DifferenceColumns(int most, int reused_steps, double filter, const InterfaceSpace& space = {})
      : most_(static_cast<std::size_t>(most)), reused_steps_(reused_steps), filter_(filter), space_(space) {}

  /// A time step, or a stage of it, begins.
  void start();
  /// The step, or stage, has ended. Drops the factorisation, so that the next one is made from the beginning, with the
  /// same bits as after a restart.
  void finish() { qr_.reset(); }
  /// Forgets the columns of the step, or stage, in progress.
  void abandon();
  /// Adds a pair as the newest; beyond `most` the oldest is dropped.
  void add(std::vector<double> v, std::vector<double> w);
  void clear();
  /// Factorises V and forgets the columns that the filter drops, so that places in the factorisation are places here.
  /// In each step, or stage, from the beginning at first, then by inserting the new column. Collective.
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
