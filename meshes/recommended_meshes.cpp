#include "meshes/recommended_meshes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"

namespace fsi {

namespace {

constexpr bool axisymmetric = true, three_dimensional = false, measured = true, expected = false;

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

// Axial cells govern the displacement, fluid cells near the wall the pressure; two cells a layer are enough once the
// pressure may jump between the layers. The rows called measured are a separate code's (quadratic axisymmetric
// elements, pressure separate per layer); how strongly it graded its meshes is not on record.
const std::vector<RecommendedMesh>& recommended_meshes() {
  static const std::vector<RecommendedMesh> table{
      // element, geometry, error in % of pressure, of displacement, how known,
      //   cells: lumen, media, adventitia, around, axial, grading of lumen, of axis
      {"p2p1", axisymmetric, 2.6, 3.9, measured, cells(6, 2, 1, 12, 72, 1, 1)},
      {"p2p1", axisymmetric, 1.9, 2.2, measured, cells(4, 2, 2, 12, 96, 3, 4)},
      {"p2p1", axisymmetric, 0.7, 1.0, measured, cells(6, 2, 2, 12, 96, 3, 4)},
      {"p2p1", three_dimensional, 2.6, 3.9, expected, cells(6, 2, 1, 12, 72, 1, 1)},
      {"p2p1", three_dimensional, 1.9, 2.2, expected, cells(4, 2, 2, 12, 96, 3, 4)},
      {"p2p1", three_dimensional, 0.7, 1.0, expected, cells(6, 2, 2, 12, 96, 3, 4)},
  };
  return table;
}

const RecommendedMesh& recommended_mesh(const std::string& element, bool axisymmetric, double percent) {
  std::set<std::string> elements;
  const RecommendedMesh* best = nullptr;
  for (const auto& mesh : recommended_meshes()) {
    elements.insert(mesh.element);
    if (mesh.element != element || mesh.axisymmetric != axisymmetric) continue;
    if (mesh.error() <= percent) return mesh;
    if (best == nullptr || mesh.error() < best->error()) best = &mesh;
  }
  if (best == nullptr)
    throw InputError("fsi-mesh", "--for", fmt::format("there are no meshes recommended for '{}'", element),
                     fmt::format("there are for {}", one_of({elements.begin(), elements.end()})));
  throw InputError("fsi-mesh", "--error", fmt::format("{:g}% is less than any recommended mesh leaves", percent),
                   fmt::format("ask for {:g}% or more, or give the numbers of cells", best->error()));
}

double percent_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  std::string sign(end);
  sign.erase(0, sign.find_first_not_of(' ') == std::string::npos ? 0 : sign.find_first_not_of(' '));
  if (end == text.c_str() || sign != "%" || !std::isfinite(value) || value <= 0)
    throw InputError("fsi-mesh", "--error", fmt::format("'{}' is no percentage", text), "give one, like 3%");
  return value;
}

std::string to_text(const RecommendedMesh& mesh) {
  const auto& c = mesh.cells;
  const auto graded = [](double ratio, const char* where) {
    return ratio == 1 ? std::string() : fmt::format(" (graded {:g} to {})", ratio, where);
  };
  return fmt::format(
      "{}, {}: cells through lumen {}{}, media {}, adventitia {}, {}along the axis {}{}; error in space of the "
      "neo-Hookean "
      "wave {:g} % of pressure, {:g} % of displacement, {}\n",
      mesh.element, mesh.axisymmetric ? "axisymmetric" : "three-dimensional", c.lumen,
      graded(c.lumen_grading, "the wall"), c.media, c.adventitia,
      mesh.axisymmetric ? "" : fmt::format("around {}, ", c.around), c.axial, graded(c.axial_grading, "the inlet"),
      mesh.pressure_error, mesh.displacement_error,
      mesh.measured ? "measured" : "expected from the axisymmetric mesh of the same cells");
}

}  // namespace fsi
