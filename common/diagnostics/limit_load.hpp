#pragma once

#include <optional>

#include "case/case.hpp"
#include "wall/wall.hpp"

namespace fsi {

/// The limit pressure in kPa of an infinitely long tube of these layers at rest, whatever its radius: at unit axial
/// stretch, incompressible neo-Hookean and Mooney-Rivlin layers of shear modulus mu between the radii A and B tend to
/// the sum of mu ln(B/A). Empty where there is no such limit (fibres stiffen) or the wall is no straight tube.
template <int n>
std::optional<double> tube_limit_load(const StructureData& data, const Wall<n>& wall);

}  // namespace fsi
