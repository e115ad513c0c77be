#include "meshes/artery_request.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/mirror.hpp"
#include "mesher/artery/curved_edges.hpp"
#include "mesher/artery/sector_images.hpp"
#include "mesher/artery_generator.hpp"

namespace fsi {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& problem, const std::string& remedy) {
  throw InputError("fsi-mesh", option, problem, remedy);
}

/// Options that contradict each other.
void check_combination(const ArteryRequest& request) {
  if (request.axisymmetric && request.sector != 360)
    refuse("--sector", "an axisymmetric mesh has no sectors", "leave one of the two options out");
  if (request.axisymmetric && request.around)
    refuse("--around", "an axisymmetric mesh has no cells around the axis", "leave one of the two options out");
  if (request.mirrored && request.sector == 360)
    refuse("--mirrored", "there is no sector to mirror", "give --sector, 90 or 180 for example, as well");
  if (request.mirrored && request.sector > 0 && 360 % request.sector == 0 && 180 % request.sector != 0)
    refuse("--mirrored",
           fmt::format("{} sectors of {} degrees are not each other's mirror images all the way round",
                       360 / request.sector, request.sector),
           "give a --sector that divides 180 degrees, or leave this option out");
  if (request.adventitia_cells && request.sizes.adventitia == 0)
    refuse("--adventitia-cells", "the wall has no adventitia", "leave it out, or give --adventitia a thickness");
  if (request.error && request.for_element.empty())
    refuse("--error", "belongs to --for", "say which element the mesh is for: --for p2p1");
  if (request.waves != wave_kinds().name_of(Waves::damped) && request.for_element.empty())
    refuse("--waves", "belongs to --for", "say which element the mesh is for: --for p2p1");
}

bool by_numbers(const ArteryRequest& r) {
  return r.axisymmetric || r.sector != 360 || !r.for_element.empty() || r.lumen_cells || r.media_cells ||
         r.adventitia_cells || r.around || r.axial_cells || r.lumen_grading || r.axial_grading;
}

ArteryCells cells_of(const ArteryRequest& request) {
  const auto* recommended = recommendation(request);
  ArteryCells cells = recommended ? recommended->cells : artery_cells(request.sizes);
  const int sectors = request.sector > 0 && 360 % request.sector == 0 ? 360 / request.sector : 1;
  cells.around += (sectors - cells.around % sectors) % sectors;  // what was not asked for may be rounded up
  cells.around = std::max(cells.around, sectors == 1 ? 0 : 2 * sectors);
  cells.lumen = request.lumen_cells.value_or(cells.lumen);
  cells.media = request.media_cells.value_or(cells.media);
  cells.adventitia = request.adventitia_cells.value_or(cells.adventitia);
  cells.around = request.around.value_or(cells.around);
  cells.axial = request.axial_cells.value_or(cells.axial);
  cells.lumen_grading = request.lumen_grading.value_or(cells.lumen_grading);
  cells.axial_grading = request.axial_grading.value_or(cells.axial_grading);
  return cells;
}

/// The tube of a request, whole or a sector, with straight edges.
TetrahedralMesh tube(const ArteryRequest& request) {
  if (!by_numbers(request)) return generate_artery(request.sizes);
  auto mesh = generate_artery(request.sizes, cells_of(request), request.sector);
  if (!request.mirrored) return mesh;
  if (request.sector < 90)
    return joined_with_sector_images(mesh, request.sector, group::symmetry[1], group::oblique_symmetry);
  mesh = joined_with_mirror_image(mesh, 1);
  return request.sector == 90 ? joined_with_mirror_image(mesh, 0) : mesh;
}

}  // namespace

const RecommendedMesh* recommendation(const ArteryRequest& request) {
  if (request.for_element.empty()) return nullptr;
  const auto asked = request.error.value_or("3%");
  const auto percent = percent_of(asked);
  if (!percent) refuse("--error", fmt::format("'{}' is no percentage", asked), "give one, like 3%");
  return &recommended_mesh(request.for_element, request.axisymmetric, wave_kinds().at(request.waves), *percent,
                           {"fsi-mesh", "--for", "--error"});
}

AnyMesh make_artery(const ArteryRequest& request) {
  check_combination(request);
  const int order = request.order.value_or(request.for_element == "p2p1" ? 2 : 1);
  if (order != 1 && order != 2) refuse("--order", fmt::format("there are no meshes of order {}", order), "give 1 or 2");
  if (request.axisymmetric) {
    const auto section = generate_artery_section(request.sizes, cells_of(request));
    if (order == 1) return section;
    return with_mid_edge_nodes(section);
  }
  const auto mesh = tube(request);
  if (order == 1) return mesh;
  return with_curved_edges(mesh, request.sizes.inner_radius);
}

}  // namespace fsi
