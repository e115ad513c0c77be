#include "system/wall_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <variant>

#include "fem/dimensions.hpp"
#include "materials/material.hpp"
#include "materials/varying_law.hpp"

namespace fsi {

namespace {

constexpr double incompressible_from = 20;  // kappa / mu

std::string place_in_layer(const Point& x, const std::string& layer) {
  return fmt::format("near ({:.4g}, {:.4g}, {:.4g}) mm{}", x[0], x[1], x[2], layer.empty() ? "" : " in layer " + layer);
}

/// Of one layer; empty: nothing is wrong.
std::string fault_of(const LayerDeformation& layer, const std::string& name, bool nearly_incompressible,
                     double factor) {
  if (const ValueAt& worst = layer.worst(); !(worst.value > 0))
    return fmt::format("the wall is folded {}, where det F is {:.3g}", place_in_layer(worst.where, name), worst.value);
  if (!nearly_incompressible) return {};
  const bool squeezed = layer.least.value < 1 / factor;
  if (!squeezed && !(layer.greatest.value > factor)) return {};
  const ValueAt& at = squeezed ? layer.least : layer.greatest;
  return fmt::format(
      "det F is {:.3g} {}, which a nearly incompressible wall does not let: structure.volume_factor = {:g} "
      "allows {:.3g} to {:g}",
      at.value, place_in_layer(at.where, name), factor, 1 / factor, factor);
}

}  // namespace

bool is_nearly_incompressible(const Material& material, double of_structure) {
  return !std::holds_alternative<CompressibleLaw>(element_law(material)) &&
         bulk_modulus(material, of_structure) >= incompressible_from * shear_modulus(material);
}

template <int n>
WallCheck check_wall(const Scene<n>& scene, const std::vector<double>& wall) {
  WallCheck check;
  if (!scene.wall) return check;
  const auto phase = scene.profile.phase("wall check");
  check.layers = scene.wall->deformation(wall);
  const auto& data = scene.wall->layer_data();
  for (std::size_t i = 0; i < data.size() && check.fault.empty(); ++i)
    check.fault =
        fault_of(check.layers[i], i < scene.layer_names.size() ? scene.layer_names[i] : std::string(),
                 is_nearly_incompressible(data[i].material, scene.wall->constants().bulk_modulus), scene.volume_factor);
  return check;
}

#define FSI_INSTANTIATE(n) template WallCheck check_wall(const Scene<n>&, const std::vector<double>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
