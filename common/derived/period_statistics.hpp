#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "time/restart_archive.hpp"

namespace fsi {

/// Averages of the wall shear stress tau over a period, per node (docs/theory.md, section 11a.2).
struct ShearStatistics {
  std::vector<double> mean;         ///< TAWSS, the mean of |tau| over the period, kPa
  std::vector<double> oscillation;  ///< OSI = (1 - |mean of tau| / TAWSS) / 2, from 0 to 0.5; 0 where tau is zero
  /// RRT = 1 / ((1 - 2 OSI) TAWSS) = 1 / |mean of tau|, 1/kPa; 0 where tau is zero. A mean below `smallest_mean` TAWSS
  /// counts as that, so that the number stays finite.
  std::vector<double> residence;
};

/// Averages of the wall shear stress over the periods 0 to T, T to 2 T, ... [Ku1985, He1996, Himburg2004]. It is added
/// at the end of each step, of any length, and taken as linear in time between these, also where a period ends within a
/// step: integrals are by the trapezoidal rule.
class PeriodStatistics {
 public:
  static constexpr double smallest_mean = 1e-6;

  /// \param period  T, ms
  explicit PeriodStatistics(double period) : period_(period) {}

  /// tau in kPa at a time in ms: three numbers per node, as many nodes each time. The first call begins; a time that is
  /// not later than the last has no effect.
  void add(double time, const std::vector<double>& shear);

  /// Averages of the last whole period; empty while there is none.
  const std::optional<ShearStatistics>& last() const { return last_; }
  double until() const { return until_; }  ///< ms, end of that period

  /// Saves or recalls the state, bit for bit. If the earlier run had none, or another period, the statistics begin
  /// anew, with a warning, and the period of the restart has none.
  void keep(RestartArchive& archive);

 private:
  void accumulate(double duration, const std::vector<double>& from, const std::vector<double>& to);
  void finish(double time);

  double period_;
  bool begun_ = false;
  double time_ = 0;                           ///< ms, of the last values
  double periods_ = 0;                        ///< a whole number: those that have ended
  double start_ = 0;                          ///< ms, from which the integrals run
  std::vector<double> now_;                   ///< tau at time_
  std::vector<double> integral_, magnitude_;  ///< of tau and |tau| since start_, kPa ms
  std::optional<ShearStatistics> last_;
  double until_ = 0;
};

}  // namespace fsi
