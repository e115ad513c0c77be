#include "observers/observables.hpp"

#include "fem/dimensions.hpp"
#include "mesh/group_names.hpp"
#include "observers/sample_tables.hpp"
#include "parallel/partial_sums.hpp"

namespace fsi {

namespace {

/// A point of the centre line at a level.
struct CentrePoint {
  double z = 0;         ///< mm, reference coordinate
  double pressure = 0;  ///< kPa; written in Pa
};

/// A position along the inner wall at a level: means over the circumference.
struct WallPoint {
  double z = 0;                  ///< mm, reference coordinate
  double radial = 0, axial = 0;  ///< mm
};

/// Flow is positive from inlet to outlet; pressures are means over the face.
struct FlowRecord {
  double inlet_flow = 0, outlet_flow = 0;          ///< mm^3/ms
  double inlet_pressure = 0, outlet_pressure = 0;  ///< kPa; written in Pa
};

const Columns<CentrePoint>& centreline_columns() {
  using R = CentrePoint;
  static const Columns<R> columns{
      {"z_mm", [](const R& r) { return r.z; }},
      {"pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.pressure; }, Measure::pressure}};
  return columns;
}

const Columns<WallPoint>& wall_columns() {
  using R = WallPoint;
  static const Columns<R> columns{{"z_mm", [](const R& r) { return r.z; }},
                                  {"radial_mm", [](const R& r) { return r.radial; }, Measure::displacement},
                                  {"axial_mm", [](const R& r) { return r.axial; }, Measure::displacement}};
  return columns;
}

const Columns<FlowRecord>& flow_columns() {
  using R = FlowRecord;
  static const Columns<R> columns{
      {"inlet_flow_mm3_per_ms", [](const R& r) { return r.inlet_flow; }, Measure::flow},
      {"outlet_flow_mm3_per_ms", [](const R& r) { return r.outlet_flow; }, Measure::flow},
      {"inlet_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.inlet_pressure; }, Measure::pressure},
      {"outlet_pressure_Pa", [](const R& r) { return pascal_per_kilopascal * r.outlet_pressure; }, Measure::pressure}};
  return columns;
}

/// This process's part of the pressures on the centre line.
template <int n>
std::vector<double> centre_line_part(const ObservationPoints& points, const std::vector<double>& fluid) {
  std::vector<double> pressure(points.centre_line.size(), 0.0);
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    const NodalSample& sample = points.centre_line[i];
    for (std::size_t a = 0; a < sample.nodes.size(); ++a)
      pressure[i] += sample.weights[a] * fluid[MixedLayout<n>::scalar(sample.nodes[a])];
  }
  return pressure;
}

template <int n>
class Observables : public Observer {
 public:
  explicit Observables(const RunView<n>& watched)
      : scene_(watched.scene), points_(watched.points), samples_(points_.requested, scene_) {}

  std::vector<ResultTable> tables() const override {
    std::vector<ResultTable> tables;
    if (!points_.centre_line.empty()) {
      tables.push_back(table_of(centreline_file, centreline_columns()));
      tables.back().places = points_.centre_z;
    }
    if (!points_.wall_line.empty()) {
      tables.push_back(table_of(wall_file, wall_columns()));
      tables.back().places = points_.wall_z;
    }
    if (scene_.fluid) tables.push_back(table_of(flow_file, flow_columns()));
    tables.insert(tables.end(), samples_.tables().begin(), samples_.tables().end());
    return tables;
  }

  std::vector<TableRows> rows_at(const State& level) const override {
    std::vector<double> pressure = centre_line_part<n>(points_, level.now.fluid), radial, axial;
    const FlowRecord flow = flow_of(level.now);
    add_wall(level.now.wall, radial, axial);
    PartialSums sums;
    for (auto* values : {&pressure, &radial, &axial}) sums.include(*values);
    auto samples = samples_.rows(level, sums);
    sums.add_up(scene_.processes());

    std::vector<TableRows> found;
    std::vector<CentrePoint> centre;
    for (std::size_t i = 0; i < pressure.size(); ++i) centre.push_back({points_.centre_z[i], pressure[i]});
    std::vector<WallPoint> wall;
    for (std::size_t i = 0; i < radial.size(); ++i) wall.push_back({points_.wall_z[i], radial[i], axial[i]});
    if (!centre.empty()) found.push_back(rows_of(centreline_file, {level.time}, centreline_columns(), centre));
    if (!wall.empty()) found.push_back(rows_of(wall_file, {level.time}, wall_columns(), wall));
    if (scene_.fluid) found.push_back(rows_of(flow_file, {level.time}, flow_columns(), {flow}));
    for (std::size_t i = 0; i < samples.size(); ++i)
      found.push_back({samples_.tables()[i].file, {level.time}, std::move(samples[i])});
    return found;
  }

 private:
  FlowRecord flow_of(const Solution& level) const {
    if (!scene_.fluid) return {};
    const auto *inlet = scene_.fluid->open_boundary(group::inlet), *outlet = scene_.fluid->open_boundary(group::outlet);
    const auto &mesh = level.mesh, &fluid = level.fluid;
    return {inlet ? -inlet->outflow(mesh, fluid) : 0.0, outlet ? outlet->outflow(mesh, fluid) : 0.0,
            inlet ? inlet->mean_pressure(mesh, fluid) : 0.0, outlet ? outlet->mean_pressure(mesh, fluid) : 0.0};
  }

  /// This process's part of the displacement of the inner wall, mm; nothing where it has no line.
  void add_wall(const std::vector<double>& wall, std::vector<double>& radial, std::vector<double>& axial) const {
    if (points_.wall_line.empty()) return;
    const AxisFrame frame(points_.axis);
    const int angles = points_.angles;
    radial.resize(points_.wall_z.size(), 0.0);
    axial.resize(points_.wall_z.size(), 0.0);
    for (std::size_t i = 0; i < points_.wall_line.size(); ++i) {
      const InnerWallSample& sample = points_.wall_line[i];
      for (std::size_t a = 0; a < sample.at.nodes.size(); ++a)
        for (int k = 0; k < n; ++k) {
          const double d = sample.at.weights[a] / angles * wall[MixedLayout<n>::vector(sample.at.nodes[a], k)];
          radial[i / angles] += d * sample.direction[scene_.axes[k]];
          axial[i / angles] += d * frame.along[scene_.axes[k]];
        }
    }
  }

  const Scene<n>& scene_;
  const ObservationPoints& points_;
  SampleTables<n> samples_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_observables(const RunView<n>& watched) {
  return std::make_unique<Observables<n>>(watched);
}

template <int n>
std::vector<double> centre_line_pressure(const ObservationPoints& points, const std::vector<double>& fluid,
                                         const Communicator& processes) {
  std::vector<double> pressure = centre_line_part<n>(points, fluid);
  processes.sum(pressure);
  return pressure;
}

#define FSI_INSTANTIATE(n)                                                                                   \
  template std::unique_ptr<Observer> make_observables(const RunView<n>&);                                    \
  template std::vector<double> centre_line_pressure<n>(const ObservationPoints&, const std::vector<double>&, \
                                                       const Communicator&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
