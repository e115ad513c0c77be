#include "meshes/surface_input.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/error.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesher/surface/sound_surface.hpp"
#include "mesher/surface/surface_file.hpp"
#include "meshes/mesh_report.hpp"
#include "run/program.hpp"

namespace fsi {

const std::map<std::string, double> surface_units{{"mm", 1}, {"cm", 10}, {"m", 1000}};

namespace {

/// Openings no vessel has in mm: a file in another unit. Where the unit is given, that is a warning.
void require_plausible(const SurfaceInput& input, const std::vector<LumenOpening>& openings) {
  constexpr double narrowest = 0.1, widest = 100;  // mm: arterioles, twice an aneurysm of the aorta
  if (openings.empty()) return;
  const double width = openings.front().diameter();
  if (width >= narrowest && width <= widest) return;
  if (!input.unit.empty()) {
    warn(mesh_program,
         fmt::format(
             "{}: --unit {}: the widest opening, at {}, measures {:.3g} mm, as no vessel's does: is {} the unit of the "
             "file?",
             input.file, input.unit, fsi::place_of(openings.front().centre), width, input.unit));
    return;
  }
  std::string fitting;
  for (const auto& [unit, length] : surface_units)
    if (width * length >= 1 && width * length <= widest) fitting += (fitting.empty() ? "" : " or ") + unit;
  throw InputError(
      input.file, "--unit",
      fmt::format("is not given, and in mm the widest opening would measure {:.3g} mm, as no vessel's does", width),
      fitting.empty() ? "give --unit m, cm or mm: that of the file"
                      : "the file may be in " + fitting + ": give --unit, mm if it is so");
}

}  // namespace

TriangleSurface triangles_of_file(const SurfaceInput& input) {
  auto surface = read_triangles(input.file);
  if (!input.unit.empty())
    for (auto& node : surface.nodes) node = surface_units.at(input.unit) * node;
  return surface;
}

OpenedLumen read_lumen_surface(const SurfaceInput& input, std::vector<std::string>& done) {
  auto sound = sound_surface(triangles_of_file(input), input.largest_shell, input.file);
  done = std::move(sound.done);
  auto lumen = opened(sound.surface);
  require_plausible(input, lumen.openings);
  return lumen;
}

}  // namespace fsi
