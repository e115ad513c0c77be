#pragma once

namespace fsi {

/// Memory that UMFPACK takes at most while it factorises with the symmetric strategy, bytes: 9 per entry of both factors
/// and 8 per entry of the matrix. Fitted to five matrices of 2,214 to 35,220 unknowns, 0 to 11 % above the measured
/// (docs/archive.md, "Direct solver"). UMFPACK's own bound is three to five times that.
/// \param factor_entries  of both factors, as the symbolic analysis expects them
inline double factorisation_bytes(double factor_entries, double matrix_entries) {
  return 9 * factor_entries + 8 * matrix_entries;
}

/// Whether a factorisation is not to be begun: even with the estimate's error there is no room for it.
inline bool will_not_fit(double estimated_bytes, double room) {
  return 0.85 * estimated_bytes > room;
}

/// Whether a warning is due.
inline bool takes_more_than_half(double estimated_bytes, double room) {
  return estimated_bytes > 0.5 * room;
}

}  // namespace fsi
