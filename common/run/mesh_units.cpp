#include "run/mesh_units.hpp"

#include <fmt/format.h>

namespace fsi {

namespace {

// Above the aorta in metres, 0.025, and at the lower end of arterioles in mm. Giant aneurysms stay below 150 mm.
constexpr double narrowest = 0.035, widest = 150;        // mm
constexpr double shortest = 0.5, longest = 2000;         // mm: of a piece of vessel
constexpr double spread_soon = 1e-3, spread_late = 1e6;  // d^2 rho / mu over the length of the run

enum class Unit { mm, metres, micrometres };

/// Of a flow in an opening: the size alone tells only of a vessel.
Unit unit_of_opening(const Case& setup, double diameter) {
  const bool narrow = diameter<narrowest, wide = diameter> widest;
  if (setup.prestress) return narrow ? Unit::metres : wide ? Unit::micrometres : Unit::mm;
  if (!setup.time) return Unit::mm;
  const double spread = diameter * diameter * setup.fluid->density / (setup.fluid->viscosity * setup.time->end);
  if (narrow && spread < spread_soon) return Unit::metres;
  return wide && spread > spread_late ? Unit::micrometres : Unit::mm;
}

Unit unit_of_extent(double extent) {
  return extent < shortest ? Unit::metres : extent > longest ? Unit::micrometres : Unit::mm;
}

}  // namespace

std::optional<std::string> unit_slip_of_mesh(const Case& setup, const VesselSize& size) {
  const bool flows = setup.fluid && size.opening > 0, stands = setup.prestress && size.extent > 0;
  if (!flows && !stands) return std::nullopt;
  const Unit unit = flows ? unit_of_opening(setup, size.opening) : unit_of_extent(size.extent);
  if (unit == Unit::mm) return std::nullopt;
  return fmt::format(
      "{} {:.3g} mm {}: the mesh seems to be in {}; lengths are in mm (in gmsh: Mesh.ScalingFactor = {} before saving)",
      flows ? "the widest opening of the mesh is" : "the vessel of the mesh is", flows ? size.opening : size.extent,
      flows ? "across" : "long", unit == Unit::metres ? "m" : "um", unit == Unit::metres ? "1000" : "0.001");
}

}  // namespace fsi
