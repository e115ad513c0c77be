#include "system/field_norms.hpp"

#include <algorithm>
#include <cmath>

#include "fem/dimensions.hpp"
#include "system/step_change.hpp"

namespace fsi {

namespace {

/// The squares of a field, each node's times its volume.
double weighted(const std::vector<double>& volumes, const std::vector<double>& field, int entries) {
  double sum = 0;
  for (std::size_t i = 0; i < field.size(); ++i) sum += volumes[i / entries] * field[i] * field[i];
  return sum;
}

/// The change of an entry of a field by an increment.
double moved(const Unknown& unknown, const std::vector<double>& increment) {
  return unknown.index >= 0 ? unknown.factor * increment[unknown.index] : 0;
}

void find_moves(const UnknownMap& map, const std::vector<double>& increment, std::vector<double>& field) {
  field.resize(map.size());
  for (std::size_t i = 0; i < map.size(); ++i) field[i] = moved(map[i], increment);
}

}  // namespace

template <int n>
FieldNorms<n>::FieldNorms(const Scene<n>& scene, const Numbering& numbering, SystemNorm norm)
    : scene_(scene), numbering_(numbering) {
  const auto volumes_of = [&](const FunctionSpace<n>& space, const PartNodes& part) {
    std::vector<double> volumes = owned_volumes<n>(space, part);
    for (int a = 0; norm == SystemNorm::entries && a < part.node_count(); ++a) volumes[a] = part.owns(a) ? 1 : 0;
    return volumes;
  };
  if (numbering_.has_fluid() || numbering_.has_mesh())
    mesh_volumes_ = fluid_volumes_ = volumes_of(scene_.fluid->space(), scene_.fluid->nodes());
  if (numbering_.has_wall()) wall_volumes_ = volumes_of(scene_.wall->space(), scene_.wall->nodes());
  follow_factors();
}

template <int n>
void FieldNorms<n>::follow_factors() {
  weights_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
  const auto add = [&](const UnknownMap& map, const std::vector<double>& volumes, int entries) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0 && map[i].index < numbering_.size)
        weights_[map[i].index] += map[i].factor * map[i].factor * volumes[i / entries];
  };
  add(numbering_.mesh, mesh_volumes_, Vector::entries);
  add(numbering_.fluid, fluid_volumes_, Mixed::entries);
  add(numbering_.wall, wall_volumes_, Mixed::entries);
}

template <int n>
double FieldNorms<n>::of_increment(const std::vector<double>& increment) const {
  double sum = 0;
  for (std::size_t i = 0; i < weights_.size(); ++i) sum += weights_[i] * increment[i] * increment[i];
  return std::sqrt(processes().sum(sum));
}

template <int n>
double FieldNorms<n>::of_solution(const Solution& now) const {
  return std::sqrt(processes().sum((numbering_.has_mesh() ? weighted(mesh_volumes_, now.mesh, Vector::entries) : 0) +
                                   (numbering_.has_fluid() ? weighted(fluid_volumes_, now.fluid, Mixed::entries) : 0) +
                                   (numbering_.has_wall() ? weighted(wall_volumes_, now.wall, Mixed::entries) : 0)));
}

template <int n>
bool FieldNorms<n>::negligible(const std::vector<double>& increment, const Solution& now, double share) const {
  std::vector<double> sums;  // of each field of vectors and of scalars: squares of increment and size
  const auto measure = [&](const UnknownMap& map, const std::vector<double>& volumes, const std::vector<double>& field,
                           int entries) {
    double changed[2] = {}, size[2] = {};
    for (std::size_t i = 0, a = 0; i < map.size(); ++a)
      for (int entry = 0; entry < entries; ++entry, ++i) {
        const double change = moved(map[i], increment);
        changed[entry == n] += volumes[a] * change * change;
        size[entry == n] += volumes[a] * field[i] * field[i];
      }
    sums.insert(sums.end(), {changed[0], size[0], changed[1], size[1]});
  };
  measure(numbering_.mesh, mesh_volumes_, now.mesh, Vector::entries);
  measure(numbering_.fluid, fluid_volumes_, now.fluid, Mixed::entries);
  if (numbering_.has_wall())
    measure(numbering_.wall, wall_volumes_, scene_.wall->from_unloaded(now.wall), Mixed::entries);
  processes().sum(sums);
  for (std::size_t i = 0; i < sums.size(); i += 2)
    if (sums[i] > share * share * sums[i + 1]) return false;
  return true;
}

template <int n>
double FieldNorms<n>::relative_to_change(const std::vector<double>& increment, const State& state,
                                         const StepData& data) const {
  find_moves(numbering_.fluid, increment, fluid_);
  find_moves(numbering_.wall, increment, wall_);
  return relative_to_step<n>(state, data, {fluid_volumes_, fluid_}, {wall_volumes_, wall_}, processes());
}

template <int n>
std::vector<double> FieldNorms<n>::magnitudes(const Solution& now) const {
  std::vector<double> x(numbering_.columns(), 0.0);
  // At nodes with a frame the components of space will do: as large as those of the frame but for a factor near one.
  const auto include = [&](const UnknownMap& map, const std::vector<double>& field) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0) x[map[i].index] = std::max(x[map[i].index], std::abs(field[i] / map[i].factor));
  };
  include(numbering_.mesh, now.mesh);
  include(numbering_.fluid, now.fluid);
  if (numbering_.has_wall()) include(numbering_.wall, scene_.wall->from_unloaded(now.wall));
  return x;
}

#define FSI_INSTANTIATE(n) template class FieldNorms<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
