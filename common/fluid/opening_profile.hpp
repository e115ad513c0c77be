#pragma once

#include <complex>
#include <vector>

#include "fluid/inflow_profile.hpp"

namespace fsi {

/// The solution w of  lambda w - Laplace w = 1 on an opening, w = 0 where the fluid sticks, with the velocity's shape
/// functions on the opening's facets; of curved surfaces the operator of Laplace and Beltrami. One number per entry of
/// `nodes`, mm^2.
/// \param nodes   of the opening, ascending: facet_nodes()
/// \param lambda  1/mm^2: 0 for steady flow, i w / nu for one that oscillates with e^(i w t)
template <class Element>
std::vector<std::complex<double>> developed_flow(const InflowOpening<Element>& opening, const std::vector<int>& nodes,
                                                 std::complex<double> lambda);

}  // namespace fsi
