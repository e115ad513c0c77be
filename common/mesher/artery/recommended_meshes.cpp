#include "mesher/artery/recommended_meshes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"

namespace fsi {

namespace {

constexpr bool plane_section = true, three_dimensional = false, measured = true;
constexpr Waves damped = Waves::damped, resolved = Waves::resolved;

ArteryCells cells(int lumen, int media, int adventitia, int around, int axial, double lumen_grading,
                  double axial_grading) {
  ArteryCells result;
  result.lumen = lumen;
  result.media = media;
  result.adventitia = adventitia;
  result.around = around;
  result.axial = axial;
  result.lumen_grading = lumen_grading;
  result.axial_grading = axial_grading;
  return result;
}

}  // namespace

// Measured with the programs themselves by `fsi-compare accuracy`, see docs/evidence/evidence.md: quadratic elements,
// pressure separate per layer, against 16-5-5-256 cells graded by 3 and 4; rounded up. Of damped waves cells along the
// axis near the inlet govern the displacement, those across the lumen the pressure; one or two cells a layer are enough
// when the pressure may jump between the layers. Resolved waves need cells along the whole axis and two in the outer
// layer. The three-dimensional rows are quarters. Damped: backward Euler with 1/8 ms. Resolved: midpoint rule with
// 1/64 ms, 1/32 ms on the quarter.
const std::vector<RecommendedMesh>& recommended_meshes() {
  static const std::vector<RecommendedMesh> table{
      // element, geometry, waves, error in % of pressure, of displacement, how known,
      //   cells: lumen, media, adventitia, around, axial, grading of lumen, of axis
      {"p2p1", plane_section, damped, 2.7, 5.8, measured, cells(3, 1, 1, 12, 20, 2, 6)},
      {"p2p1", plane_section, damped, 1.9, 4.7, measured, cells(4, 1, 1, 12, 24, 2, 8)},
      {"p2p1", plane_section, damped, 1.7, 2.6, measured, cells(4, 1, 1, 12, 36, 2, 8)},
      {"p2p1", plane_section, damped, 1.3, 2.0, measured, cells(6, 2, 1, 12, 36, 2, 12)},
      {"p2p1", plane_section, damped, 0.7, 1.0, measured, cells(6, 2, 1, 12, 48, 2, 6)},
      {"p2p1", plane_section, damped, 0.5, 0.3, measured, cells(8, 3, 2, 12, 144, 3, 4)},
      {"p2p1", plane_section, damped, 0.2, 0.1, measured, cells(12, 4, 4, 12, 192, 3, 4)},
      {"p2p1", three_dimensional, damped, 2.3, 5.1, measured, cells(3, 1, 1, 12, 20, 2, 6)},
      {"p2p1", three_dimensional, damped, 2.0, 4.0, measured, cells(4, 1, 1, 12, 24, 2, 8)},
      {"p2p1", three_dimensional, damped, 1.3, 2.3, measured, cells(4, 1, 1, 12, 36, 2, 8)},
      {"p2p1", three_dimensional, damped, 0.6, 1.8, measured, cells(6, 2, 1, 16, 48, 2, 8)},
      {"p2p1", three_dimensional, damped, 0.5, 0.9, measured, cells(6, 2, 1, 16, 72, 2, 6)},
      {"p2p1", plane_section, resolved, 5.7, 9.3, measured, cells(4, 1, 1, 12, 48, 2, 4)},
      {"p2p1", plane_section, resolved, 3.8, 4.4, measured, cells(4, 1, 1, 12, 72, 2, 4)},
      {"p2p1", plane_section, resolved, 1.9, 2.2, measured, cells(6, 2, 2, 12, 96, 3, 4)},
      {"p2p1", plane_section, resolved, 1.5, 1.3, measured, cells(6, 2, 2, 12, 120, 3, 4)},
      {"p2p1", plane_section, resolved, 1.1, 0.8, measured, cells(8, 3, 2, 12, 144, 3, 4)},
      {"p2p1", plane_section, resolved, 0.6, 0.7, measured, cells(9, 3, 3, 12, 144, 3, 4)},
      {"p2p1", three_dimensional, resolved, 4.5, 8.0, measured, cells(4, 1, 1, 12, 48, 2, 4)},
      {"p2p1", three_dimensional, resolved, 3.8, 4.4, !measured, cells(4, 1, 1, 12, 72, 2, 4)},
      {"p2p1", three_dimensional, resolved, 1.9, 2.2, !measured, cells(6, 2, 2, 12, 96, 3, 4)},
      {"p2p1", three_dimensional, resolved, 1.1, 0.8, !measured, cells(8, 3, 2, 16, 144, 3, 4)},
  };
  return table;
}

const NameTable<Waves>& wave_kinds() {
  static const NameTable<Waves> table{"waves", {{"damped", Waves::damped}, {"resolved", Waves::resolved}}};
  return table;
}

const RecommendedMesh& recommended_mesh(const std::string& element, bool axisymmetric, Waves waves, double percent,
                                        const AskedFor& asked) {
  std::set<std::string> elements;
  const RecommendedMesh* best = nullptr;
  for (const auto& mesh : recommended_meshes()) {
    elements.insert(mesh.element);
    if (mesh.element != element || mesh.axisymmetric != axisymmetric || mesh.waves != waves) continue;
    if (mesh.error() <= percent) return mesh;
    if (best == nullptr || mesh.error() < best->error()) best = &mesh;
  }
  if (best == nullptr)
    throw InputError(asked.file, asked.element, fmt::format("there are no meshes recommended for '{}'", element),
                     fmt::format("there are for {}", one_of({elements.begin(), elements.end()})));
  throw InputError(asked.file, asked.error, fmt::format("{:g}% is less than any recommended mesh leaves", percent),
                   fmt::format("ask for {:g}% or more, or give the numbers of cells", best->error()));
}

std::optional<double> percent_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  std::string sign(end);
  sign.erase(0, sign.find_first_not_of(' ') == std::string::npos ? 0 : sign.find_first_not_of(' '));
  if (end == text.c_str() || sign != "%" || !std::isfinite(value) || value <= 0) return std::nullopt;
  return value;
}

std::string to_text(const RecommendedMesh& mesh) {
  const auto& c = mesh.cells;
  const auto graded = [](double ratio, const char* where) {
    return ratio == 1 ? std::string() : fmt::format(" (graded {:g} to {})", ratio, where);
  };
  return fmt::format(
      "{}, {}, {} waves: cells through lumen {}{}, media {}, adventitia {}, {}along the axis {}{}; error in space of "
      "the "
      "neo-Hookean wave {:g} % of pressure, {:g} % of displacement, {}\n",
      mesh.element, mesh.axisymmetric ? "axisymmetric" : "three-dimensional", wave_kinds().name_of(mesh.waves), c.lumen,
      graded(c.lumen_grading, "the wall"), c.media, c.adventitia,
      mesh.axisymmetric ? "" : fmt::format("around {}, ", c.around), c.axial, graded(c.axial_grading, "the inlet"),
      mesh.pressure_error, mesh.displacement_error,
      mesh.measured ? "measured" : "expected from the axisymmetric mesh of the same cells");
}

}  // namespace fsi
