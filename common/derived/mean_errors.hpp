#pragma once

#include <vector>

#include "derived/error_indicator.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// The error indicator of a medium's cells over a run, each cell's root of
///   1/T sum over steps of dt eta_K(t)^2,     t at the end of the step, T the time since the run's first level.
class MeanErrors {
 public:
  /// Whether errors at this time, ms, are still to be added: later than the last, or the first.
  bool wants(double time) const { return !begun_ || time > time_; }
  /// The first call begins: its errors do not count.
  /// \param time  ms; without effect unless later than that of the call before
  void add(double time, const CellErrors& errors);

  /// The mean so far, zero before the first step has ended. \param cells  number of cells
  CellErrors mean(std::size_t cells) const;

  /// Saves or recalls the state, bit for bit. Where the earlier run had no mean it begins anew, with a warning.
  /// \param kind  ArrayKind::fluid_cells or wall_cells
  void keep(RestartArchive& archive, ArrayKind kind);

 private:
  bool begun_ = false;
  double start_ = 0, time_ = 0;   ///< ms, of the first and of the last level
  std::vector<double> integral_;  ///< of both squares, per cell, ms times (unit of the quantity)^2
};

}  // namespace fsi
