#include "driver/mesh_units.hpp"

#include <fmt/format.h>

namespace fsi {

namespace {

// Arterioles are wider than 0.03 mm; the aorta is 25 mm wide, 0.025 in metres. Giant aneurysms stay below 150 mm.
constexpr double narrowest = 0.035, widest = 150;        // mm
constexpr double spread_soon = 1e-3, spread_late = 1e6;  // d^2 rho / mu over the length of the run

}  // namespace

std::optional<std::string> unit_slip_of_mesh(const Case& setup, double diameter) {
  if (!setup.fluid || !setup.time || !(diameter > 0)) return std::nullopt;
  const double spread = diameter * diameter * setup.fluid->density / (setup.fluid->viscosity * setup.time->end);
  const bool metres = diameter < narrowest && spread < spread_soon;
  if (!metres && !(diameter > widest && spread > spread_late)) return std::nullopt;
  return fmt::format(
      "the widest opening of the mesh is {:.3g} mm across: the mesh seems to be in {}; lengths are in mm (in gmsh: "
      "Mesh.ScalingFactor = {} before saving)",
      diameter, metres ? "m" : "um", metres ? "1000" : "0.001");
}

}  // namespace fsi
