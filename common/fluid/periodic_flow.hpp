#pragma once

#include <complex>
#include <utility>
#include <vector>

namespace fsi {

/// A flow rate that repeats itself, linear between its points and from the last one to the first of the next period.
struct PeriodicFlow {
  double period = 0;                              ///< ms
  std::vector<std::pair<double, double>> points;  ///< (ms, mm^3/ms), times ascending, over less than a period

  /// mm^3/ms, at any time in ms.
  double at(double time) const;
  /// q_k of the Fourier series Re sum over k >= 0 of q_k e^(2 pi i k t / period), mm^3/ms: integrated exactly, since
  /// the flow is linear between its points. q_0 is real.
  std::complex<double> coefficient(int k) const;
  /// Mean of the square over a period, mm^6/ms^2.
  double mean_square() const;
};

}  // namespace fsi
