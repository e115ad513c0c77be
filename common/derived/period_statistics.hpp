#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "time/restart_archive.hpp"

namespace fsi {

/// What a period of the wall shear stress tau amounts to, per node.
struct ShearStatistics {
  std::vector<double> mean;         ///< TAWSS, the mean of |tau| over the period, kPa
  std::vector<double> oscillation;  ///< OSI = (1 - |mean of tau| / TAWSS) / 2, from 0 to 0.5; 0 where tau is zero
  /// RRT = 1 / ((1 - 2 OSI) TAWSS) = 1 / |mean of tau|, 1/kPa; 0 where tau is zero. Where the mean of tau is below
  /// `smallest_mean` TAWSS, that stands for it, so that the number stays finite.
  std::vector<double> residence;
};

/// Averages of the wall shear stress over the periods 0 to T, T to 2 T, ... [Ku1985, He1996, Himburg2004]. It is taken
/// in at the end of each step, of any length; between these it counts as linear in time, also where a period ends
/// within a step, and integrals are by the trapezoidal rule.
class PeriodStatistics {
 public:
  static constexpr double smallest_mean = 1e-6;

  /// \param period  T, ms
  explicit PeriodStatistics(double period) : period_(period) {}

  /// tau at a time (ms): three numbers per node, as many nodes each time. The first call begins; a time that is not
  /// behind the last one has been taken in already and changes nothing.
  void add(double time, const std::vector<double>& shear);

  /// Of the last whole period; empty while there is none.
  const std::optional<ShearStatistics>& last() const { return last_; }
  double until() const { return until_; }  ///< ms, end of that period

  /// What a restart needs to go on bit for bit. An earlier run without, or of another period, does not serve: then the
  /// period that the restart falls into has none, which is said.
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
