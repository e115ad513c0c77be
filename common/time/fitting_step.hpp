#pragma once

namespace fsi {

/// A step that divides the period, at most `step` and near it; one of few digits where there is one. All in ms.
double fitting_step(double period, double step);

}  // namespace fsi
