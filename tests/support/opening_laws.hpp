#pragma once

#include "openings/opening_laws.hpp"

namespace fsi::test {

/// R_p, C, R_d in kPa ms/mm^3 and mm^3/kPa; the pressures behind R_d and of the compliance at the start in kPa.
inline OpeningLawData windkessel(double proximal, double compliance, double distal, double distal_pressure,
                                 double initial_pressure) {
  return {"windkessel",
          {{"proximal", proximal},
           {"compliance", compliance},
           {"distal", distal},
           {"distal_pressure", distal_pressure},
           {"initial_pressure", initial_pressure}}};
}

}  // namespace fsi::test
