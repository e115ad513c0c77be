#include "mesh_motion/stiffening.hpp"

#include <array>
#include <cmath>

#include "mesh/point_math.hpp"
#include "mesh_motion/nearest_point.hpp"

namespace fsi {

namespace {

double mean(const std::vector<double>& of_cells) {
  double sum = 0;
  for (const double x : of_cells) sum += x;
  return sum / static_cast<double>(of_cells.size());
}

}  // namespace

template <int Dim, int Order>
std::vector<double> mesh_stiffness(const Submesh<Dim, Order>& part, const std::vector<int>& interface,
                                   const MeshMotionOptions& options) {
  if (!options.stiffens() || part.cells.empty()) return {};
  std::vector<Point> wet;
  for (const int node : interface) wet.push_back(part.nodes[node]);
  const bool by_distance = options.distance_exponent != 0 && !wet.empty();
  const NearestPoint nearest(std::move(wet));
  std::vector<double> volumes, distances;
  for (const auto& cell : part.cells) {
    std::array<Point, Dim + 1> x;
    Point centre{0, 0, 0};
    for (int a = 0; a <= Dim; ++a) {
      x[a] = part.nodes[cell[a]];
      centre = centre + (1.0 / (Dim + 1)) * x[a];
    }
    volumes.push_back(std::abs(simplex_volume<Dim>(x.data())));
    if (by_distance) distances.push_back(nearest.distance(centre));
  }
  const double mean_volume = mean(volumes);
  std::vector<double> stiffness;
  for (const double volume : volumes) stiffness.push_back(std::pow(mean_volume / volume, options.size_exponent));
  if (!by_distance) return stiffness;
  const double mean_distance = mean(distances);
  for (std::size_t c = 0; c < distances.size(); ++c)
    stiffness[c] *= std::pow(mean_distance / distances[c], options.distance_exponent);
  return stiffness;
}

#define FSI_INSTANTIATE(Dim, Order)                                                                \
  template std::vector<double> mesh_stiffness(const Submesh<Dim, Order>&, const std::vector<int>&, \
                                              const MeshMotionOptions&);
FSI_INSTANTIATE(2, 1)
FSI_INSTANTIATE(2, 2)
FSI_INSTANTIATE(3, 1)
FSI_INSTANTIATE(3, 2)
#undef FSI_INSTANTIATE

}  // namespace fsi
