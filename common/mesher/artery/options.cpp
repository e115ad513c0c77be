#include "mesher/artery/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/names.hpp"
#include "host/available_memory.hpp"
#include "math/pi.hpp"

namespace fsi {

namespace {

struct Level {
  const char* name;
  double size, axial_size;
};
// The axial size spends what the cross-section leaves of the paper's node count.
constexpr Level levels[] = {{"coarse", 0.75, 0.78}, {"intermediate", 0.375, 0.34}, {"fine", 0.1875, 0.168}};

// Rings thinner than the elements are long: bending and the pressure drop across the wall need more points through the
// thickness than along it, and one ring of the coarse media stays one ring of its own thickness.
constexpr double ring_to_size = 0.35;

void require(bool good, const std::string& option, double value, const std::string& remedy) {
  if (!good) throw InputError("fsi-mesh", option, fmt::format("{} mm will not do", value), remedy);
}

bool is_positive(double value) {
  return std::isfinite(value) && value > 0;
}

/// \throws OutOfMemory for a mesh that would not fit, before it is begun
void require_room(double nodes) {
  constexpr double bytes_per_node = 1600, worth_asking = 1e5;  // measured with straight edges; quadratic ones take more
  if (nodes < worth_asking || nodes * bytes_per_node <= static_cast<double>(available_memory().bytes)) return;
  throw OutOfMemory(
      fmt::format("about {} asked for a mesh of {:.3g} nodes", memory_text(nodes * bytes_per_node), nodes),
      "give larger elements or fewer cells");
}

}  // namespace

std::vector<std::string> artery_levels() {
  std::vector<std::string> names;
  for (const auto& level : levels) names.emplace_back(level.name);
  return names;
}

ArteryOptions artery_level(const std::string& name) {
  for (const auto& level : levels)
    if (name == level.name) {
      ArteryOptions options;
      options.size = level.size;
      options.axial_size = level.axial_size;
      return options;
    }
  throw InputError(
      "fsi-mesh", "--level", fmt::format("there is no level '{}'", name),
      fmt::format("nearest: {}; levels are {}", nearest_name(name, artery_levels()), one_of(artery_levels())));
}

void require_tube(const ArteryShape& shape) {
  require(is_positive(shape.inner_radius), "--inner-radius", shape.inner_radius, "give a positive radius");
  require(is_positive(shape.media), "--media", shape.media, "give a positive thickness");
  require(std::isfinite(shape.adventitia) && shape.adventitia >= 0, "--adventitia", shape.adventitia,
          "give a positive thickness, or 0 for a wall of media alone");
  require(is_positive(shape.length), "--length", shape.length, "give a positive length");
}

ArteryCells artery_cells(const ArteryOptions& o) {
  require_tube(o);
  require(is_positive(o.size), "--size", o.size, "give a positive element size");
  const double axial_size = o.axial_size.value_or(o.size);
  require(is_positive(axial_size), "--axial-size", axial_size, "give a positive element size");

  const double lumen = std::max(2.0, std::round(2 * pi * o.inner_radius / (6 * o.size)));
  const double media = std::max(1.0, std::round(o.media / (ring_to_size * o.size)));
  const double adventitia = o.adventitia > 0 ? std::max(1.0, std::round(o.adventitia / (ring_to_size * o.size))) : 0;
  const double axial = std::max(2.0, std::round(o.length / axial_size));

  const double nodes = (1 + 3 * lumen * (lumen + 1) + 6 * lumen * (media + adventitia)) * (axial + 1);
  if (!(nodes <= max_artery_nodes)) {
    const bool across = axial_size >= o.size;
    throw InputError("fsi-mesh", across ? "--size" : "--axial-size",
                     fmt::format("{} mm asks for {:.3g} nodes", across ? o.size : axial_size, nodes),
                     fmt::format("give a larger one, for at most {:.3g} nodes", max_artery_nodes));
  }
  require_room(nodes);
  ArteryCells cells;
  cells.lumen = static_cast<int>(lumen);
  cells.media = static_cast<int>(media);
  cells.adventitia = static_cast<int>(adventitia);
  cells.around = 6 * cells.lumen;
  cells.axial = static_cast<int>(axial);
  return cells;
}

void require_cells(const ArteryShape& shape, const ArteryCells& cells) {
  require_tube(shape);
  const auto at_least = [](int count, int least, const char* option) {
    if (count < least)
      throw InputError("fsi-mesh", option, fmt::format("{} cells will not do", count),
                       fmt::format("give at least {}", least));
  };
  at_least(cells.lumen, 1, "--lumen-cells");
  at_least(cells.media, 1, "--media-cells");
  if (shape.adventitia > 0) at_least(cells.adventitia, 1, "--adventitia-cells");
  at_least(cells.around, 6, "--around");
  at_least(cells.axial, 2, "--axial-cells");

  constexpr double most = 1e6;
  const auto ratio = [&](double value, const char* option) {
    if (!(value >= 1 / most && value <= most))
      throw InputError("fsi-mesh", option, fmt::format("a ratio of {} will not do", value),
                       fmt::format("give the longest cell over the shortest, 1 for equal cells, at most {:g}", most));
  };
  ratio(cells.lumen_grading, "--lumen-grading");
  ratio(cells.axial_grading, "--axial-grading");

  const double rings = static_cast<double>(cells.lumen) + cells.media + (shape.adventitia > 0 ? cells.adventitia : 0);
  const double nodes = (1 + cells.around * rings) * (cells.axial + 1.0);
  if (!(nodes <= max_artery_nodes))
    throw InputError("fsi-mesh", cells.axial >= cells.around * rings ? "--axial-cells" : "--around",
                     fmt::format("the cells asked for have up to {:.3g} nodes", nodes),
                     fmt::format("give fewer, for at most {:.3g} nodes", max_artery_nodes));
  require_room(nodes);
}

}  // namespace fsi
