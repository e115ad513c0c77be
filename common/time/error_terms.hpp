#pragma once

namespace fsi {

/// Leading terms of a scheme's error (docs/theory.md, section 8): what one step adds to y is
///   constant dt^(order + 1) y^(order + 1) + shift dt^3 y''.
struct ErrorTerms {
  int order = 2;
  double constant = 1.0 / 12;
  double shift = 0;            ///< 1/ms, of the shifted midpoint rule
  double largest_shift = 0.5;  ///< bound of shift dt
};

}  // namespace fsi
