#pragma once

#include <string>

#include "partitioned/coupling_scheme.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// Sums the gap between fluid and wall over the stages of a loosely coupled scheme, which is stable but leaves an error
/// in each step.
class SplittingErrorMonitor {
 public:
  /// Part of the interface's motion up to which the difference is small (docs/coupling.md).
  static constexpr double small = 0.1;

  /// \param scheme  must outlive this
  explicit SplittingErrorMonitor(const CouplingScheme& scheme) : scheme_(&scheme) {}

  /// To be called once a stage.
  /// \param gap       |d~ - d| of its last pass, mm
  /// \param movement  of the wall since the last time level, mm (CouplingPass::movement())
  void add(double gap, double movement) {
    gaps_ += gap * gap;
    movements_ += movement * movement;
  }
  /// Root mean square of the gaps over that of the movements.
  double gap() const;
  /// As Stepper::unchecked(): how large the difference is, where it is not small.
  std::string unchecked() const;
  void keep(RestartArchive& archive);

 private:
  const CouplingScheme* scheme_;
  double gaps_ = 0, movements_ = 0;  ///< sums of squares, mm^2
};

}  // namespace fsi
