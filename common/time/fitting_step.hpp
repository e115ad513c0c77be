#pragma once

namespace fsi {

/// A step in ms, near this one and no longer, of which the period has a whole number: of few digits where there is one.
double fitting_step(double period, double step);

}  // namespace fsi
