#pragma once

namespace fsi {

/// What lies behind an open boundary (docs/theory.md, section 3.5): a resistance, or the Windkessel of three elements
/// ([Westerhof2009]),
///   p = p_c + R_p Q,   C dp_c/dt = Q - (p_c - p_d) / R_d,
/// Q being the outward flow. A time scheme with dp_c/dt = k (p_c - r) at its balance makes p an affine function of the
/// Q there, which is solved with the step. Without compliance p = p_d + R_p Q, and nothing is stored.
struct OutflowLaw {
  double proximal = 0;          ///< R_p, kPa ms/mm^3
  double compliance = 0;        ///< C, mm^3/kPa; 0: a resistance
  double distal = 0;            ///< R_d, kPa ms/mm^3; positive where there is a compliance
  double distal_pressure = 0;   ///< p_d, kPa
  double initial_pressure = 0;  ///< p_c at the start, kPa

  bool stores() const { return compliance > 0; }
  /// p_c at a balance, kPa; of a resistance p_d. \param k  1/ms \param reference  r, kPa \param flow  Q, mm^3/ms
  double stored_pressure(double k, double reference, double flow) const {
    if (!stores()) return distal_pressure;
    return (compliance * k * reference + distal_pressure / distal + flow) / (compliance * k + 1 / distal);
  }
  /// p at a balance, kPa.
  double pressure(double k, double reference, double flow) const {
    return stored_pressure(k, reference, flow) + proximal * flow;
  }
  /// dp/dQ at a balance, kPa ms/mm^3.
  double slope(double k) const { return proximal + (stores() ? 1 / (compliance * k + 1 / distal) : 0); }
  /// dp_c/dt, kPa/ms.
  double rate(double stored, double flow) const {
    return stores() ? (flow - (stored - distal_pressure) / distal) / compliance : 0;
  }
};

}  // namespace fsi
