#pragma once

#include <memory>
#include <vector>

#include "observers/run_view.hpp"

namespace fsi {

inline constexpr const char* centreline_file = "centerline_pressure.csv";
inline constexpr const char* wall_file = "wall_displacement.csv";
inline constexpr const char* flow_file = "flow.csv";
inline constexpr const char* points_file = "points.csv";
inline constexpr const char* lines_file = "lines.csv";
inline constexpr const char* planes_file = "planes.csv";

/// Tables of levels: centre-line pressure, inner-wall displacement, flow, samples; those that a scene has.
template <int n>
std::unique_ptr<Observer> make_observables(const RunView<n>& watched);

/// Pressure at the points of the centre line, kPa. Collective over processes. \param fluid  (u, p), mixed layout
template <int n>
std::vector<double> centre_line_pressure(const ObservationPoints& points, const std::vector<double>& fluid,
                                         const Communicator& processes);

}  // namespace fsi
