#pragma once

namespace fsi {

/// Options of the quasi-Newton accelerators of the coupling, here so that case files can set them; defaults near
/// preCICE's (version 3: 0.1, 100, 10, QR3 1e-2).
struct QuasiNewtonOptions {
  double relaxation = 0.01;  ///< while there are no differences yet
  double mixing = 1;         ///< relaxation of the part of a residual outside the span of the differences
  int columns = 200;         ///< differences kept at most
  int reused_steps = 10;     ///< earlier time steps whose columns are kept
  double filter = 1e-2;      ///< a column is dropped when less than this part of it is new
};

}  // namespace fsi
