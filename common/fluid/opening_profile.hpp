#pragma once

#include <complex>
#include <vector>

#include "fluid/inflow_profile.hpp"

namespace fsi {

/// The solution f of  lambda f - Laplace f = 1 on an opening, f = 0 where the fluid sticks, with the velocity's shape
/// functions on the opening's facets; on curved surfaces with the Laplace-Beltrami operator. One number per entry of
/// `nodes`, mm^2. The same for any number of threads.
/// \param nodes   of the opening, ascending: facet_nodes()
/// \param lambda  1/mm^2: 0 for steady flow, i omega / nu for one that oscillates with e^(i omega t)
/// \pre lambda is not zero, or the fluid sticks somewhere: else the matrix is singular
/// \throws ConvergenceError as DirectSolver
template <class Element>
std::vector<std::complex<double>> developed_flow(const InflowOpening<Element>& opening, const std::vector<int>& nodes,
                                                 std::complex<double> lambda);

}  // namespace fsi
