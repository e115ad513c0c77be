#include "observers/network_observer.hpp"

#include <string>
#include <vector>

#include "fem/dimensions.hpp"
#include "io/column.hpp"

namespace fsi {

namespace {

template <int n>
class NetworkObserver : public Observer {
 public:
  explicit NetworkObserver(const Scene<n>& scene) : scene_(scene) {}

  std::vector<ResultTable> tables() const override {
    ResultTable table{network_file, "time_ms,element,flow_mm3_per_ms,first_pressure_Pa,second_pressure_Pa,volume_mm3"};
    for (const auto& element : network().elements()) table.names.push_back(element.name);
    table.measures = {Measure::flow, Measure::pressure, Measure::pressure, Measure::none};
    table.blanks = true;  // most elements store nothing
    return {table};
  }
  std::vector<TableRows> rows_at(const State& level) const override {
    const auto& joined = scene_.openings.joined();
    const Solution& now = level.now;
    const NetworkState state = joined.at_level(level.time, now.openings, now.mesh, now.fluid);
    std::vector<TableRow> rows;
    std::size_t place = joined.place();
    for (std::size_t e = 0; e < network().elements().size(); ++e) {
      const auto& element = network().elements()[e];
      const auto pascal = [&](int node) { return pascal_per_kilopascal * network().pressure(node, state); };
      rows.push_back({state.flows[e], pascal(element.from), pascal(element.to), std::nullopt});
      const auto keeps = element.law->keeps();
      if (keeps == NetworkElement::Keeps::volume) rows.back()[3] = now.openings[place];
      if (keeps != NetworkElement::Keeps::nothing) ++place;
    }
    return {{network_file, {level.time}, std::move(rows)}};
  }

 private:
  const Network& network() const { return scene_.openings.joined().network(); }

  const Scene<n>& scene_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_network_observer(const RunView<n>& watched) {
  if (watched.scene.openings.joined().empty()) return nullptr;
  return std::make_unique<NetworkObserver<n>>(watched.scene);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_network_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
