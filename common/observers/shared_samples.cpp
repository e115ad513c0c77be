#include "observers/shared_samples.hpp"

namespace fsi {

NodalSample restricted(const NodalSample& sample, const PartRestriction& here) {
  NodalSample mine;
  for (std::size_t a = 0; a < sample.nodes.size(); ++a) {
    if (!here.owns_whole(sample.nodes[a])) continue;
    mine.nodes.push_back(here.local(sample.nodes[a]));
    mine.weights.push_back(sample.weights[a]);
  }
  return mine;
}

void restrict_samples(const PartRestriction* fluid, const PartRestriction* wall, ObservationPoints& points) {
  for (NodalSample& sample : points.centre_line) sample = restricted(sample, *fluid);
  for (InnerWallSample& sample : points.wall_line) sample.at = restricted(sample.at, *wall);
  for (auto* samples : {&points.requested.points, &points.requested.lines})
    for (SampledPoint& sample : *samples) {
      const PartRestriction& here = sample.in_fluid ? *fluid : *wall;
      sample.vectors = restricted(sample.vectors, here);
      sample.scalars = restricted(sample.scalars, here);
    }
}

void cut_through(const PartNodes& fluid, ObservationPoints& points) {
  for (SampledPlane& plane : points.requested.planes) plane.cut = plane.cut->through(fluid);
}

}  // namespace fsi
