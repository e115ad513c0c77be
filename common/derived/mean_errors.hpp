#pragma once

#include <vector>

#include "derived/error_indicator.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// The error indicator of a medium's cells over a run, each cell's root of
///   1/T sum over steps of dt eta_K(t)^2,     t at the end of the step, T the time since the run's first level.
class MeanErrors {
 public:
  /// Where errors at this time are still to be taken in: one that is not behind the last has been.
  bool wants(double time) const { return !begun_ || time > time_; }
  /// The first call begins: its errors do not count.
  /// \param time  ms, behind that of the call before
  void add(double time, const CellErrors& errors);

  /// \param cells  how many there are; zero before the first step has ended
  CellErrors mean(std::size_t cells) const;

  /// What a restart needs to go on bit for bit. Where the earlier run had none, the mean begins anew, which is said.
  /// \param kind  ArrayKind::fluid_cells or wall_cells
  void keep(RestartArchive& archive, ArrayKind kind);

 private:
  bool begun_ = false;
  double start_ = 0, time_ = 0;   ///< ms, of the first and of the last level
  std::vector<double> integral_;  ///< per cell of both squares, ms times (unit of the quantity)^2
};

}  // namespace fsi
