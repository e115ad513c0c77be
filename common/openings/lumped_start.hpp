#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "openings/opening_law.hpp"

namespace fsi {

/// A vessel without resistance, inertia and compliance of its own: the pressure is the same at all its openings, and what
/// flows in at some leaves by those with a law. Either that pressure is given over time or, where `pressure` is empty, the
/// flow that enters.
struct LumpedVessel {
  std::vector<std::shared_ptr<const OpeningLaw>> laws;
  std::function<double(double)> pressure;  ///< kPa at a time in ms
  std::function<double(double)> inflow;    ///< mm^3/ms at a time in ms
  double period = 0;                       ///< ms, of these
};

/// What the laws keep at time 0 in the periodic state, a vector for each law. The laws are linear, so that a march over one
/// period (implicit midpoint rule, error of second order in the step) is an affine map, whose fixed point this is.
/// \throws std::runtime_error where there is none: with a flow that is given and nothing that it leaves by
std::vector<std::vector<double>> periodic_start(const LumpedVessel& vessel, int steps = 2048);

}  // namespace fsi
