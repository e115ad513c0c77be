#include "observers/wall_observer.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "fem/dimensions.hpp"
#include "time/time_text.hpp"

namespace fsi {

namespace {

// Linear elasticity neglects half of the square of grad d: at these limits 2.5 % of the strain, and a strain of 4.5 %.
constexpr double small_strain = 0.05, small_rotation = 0.3;  // -, radians
constexpr double degrees = 57.295779513082321;

/// A value with its time, ms, or share of the load.
struct ValueInTime {
  ValueAt at;
  double time = 0;
};

/// The extremes of a layer since the run started.
struct LayerRecord {
  ValueInTime least{{1}}, greatest{{1}}, strain, rotation;
  bool warned = false;
};

template <int n>
class WallObserver : public Observer {
 public:
  explicit WallObserver(const RunView<n>& watched)
      : messages_(watched.messages), scene_(watched.scene), layers_(scene_.layer_names.size()) {}

  void begin(const State& state) override {
    if (state.step > 0) note();  // of the run so far
  }
  std::vector<TableRows> after_step(const FinishedStep& step) override {
    bool news = false;
    for (std::size_t i = 0; i < layers_.size() && i < step.report.wall.size(); ++i)
      news = include(step.report.wall[i], step.state.time, i) || news;
    if (news) note();
    return {};
  }

  void end() override {
    for (std::size_t i = 0; i < layers_.size(); ++i)
      if (layers_[i].warned)
        messages_.warn(fmt::format("{}: in this run the largest strain is {}, the largest rotation {}", title(i),
                                   text_of_strain(layers_[i].strain), text_of_rotation(layers_[i].rotation)));
  }

  void keep(RestartArchive& archive) override {
    if (!archive.wants({"extremes"}))
      return archive.warn("the wall's extremes are those since the restart: the earlier run has left none");
    std::vector<double> numbers;
    for (const LayerRecord& layer : layers_)
      for (const auto& [at, time] : {layer.least, layer.greatest, layer.strain, layer.rotation})
        numbers.insert(numbers.end(), {at.value, at.where[0], at.where[1], at.where[2], time});
    archive.array("extremes", ArrayKind::alike, numbers, {numbers.size()});
    if (!archive.recalls()) return;
    auto next = numbers.begin();
    for (LayerRecord& layer : layers_)
      for (ValueInTime* extreme : {&layer.least, &layer.greatest, &layer.strain, &layer.rotation}) {
        *extreme = {{next[0], {next[1], next[2], next[3]}}, next[4]};
        next += 5;
      }
  }

 private:
  bool include(const LayerDeformation& now, double time, std::size_t number) {
    LayerRecord& layer = layers_[number];
    bool news = false;
    const auto take = [&](const ValueAt& value, ValueInTime& extreme, bool is_more) {
      if (!is_more) return;
      extreme = {value, time};
      news = true;
    };
    take(now.worst(), layer.least, now.worst().value < layer.least.at.value);
    take(now.greatest, layer.greatest, now.greatest.value > layer.greatest.at.value);
    take(now.strain, layer.strain, now.strain.value > layer.strain.at.value);
    take(now.rotation, layer.rotation, now.rotation.value > layer.rotation.at.value);
    const bool strained = layer.strain.at.value > small_strain, turned = layer.rotation.at.value > small_rotation;
    if (!layer.warned && (strained || turned)) {
      layer.warned = true;
      messages_.warn(
          fmt::format("{}: linear-elastic holds for small strains and rotations only, and here is {}: what comes of it "
                      "is no answer of "
                      "a wall; take material = \"saint-venant-kirchhoff\", or a hyperelastic one",
                      title(number),
                      strained ? "a strain of " + text_of_strain(layer.strain)
                               : "a rotation of " + text_of_rotation(layer.rotation)));
    }
    return news;
  }

  std::string title(std::size_t number) const { return "layer " + scene_.layer_names[number]; }

  std::string text_of_place(const ValueInTime& value) const {
    const Point& x = value.at.where;
    return fmt::format("near ({:.4g}, {:.4g}, {:.4g}) mm at {}", x[0], x[1], x[2],
                       time_text(value.time, scene_.is_static()));
  }
  std::string text_of_strain(const ValueInTime& value) const {
    return fmt::format("{:.3g} % {}", 100 * value.at.value, text_of_place(value));
  }
  std::string text_of_rotation(const ValueInTime& value) const {
    return fmt::format("{:.3g} degrees {}", degrees * value.at.value, text_of_place(value));
  }

  /// An entry of the summary.
  void note() const {
    nlohmann::json all;
    const auto json = [](const ValueInTime& value) {
      return nlohmann::json{{"value", value.at.value}, {"where_mm", value.at.where}, {"time_ms", value.time}};
    };
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      auto& layer = all[scene_.layer_names[i]];
      layer = {{"least_det_F", json(layers_[i].least)}, {"greatest_det_F", json(layers_[i].greatest)}};
      if (layers_[i].strain.at.value > 0) {
        layer["largest_strain"] = json(layers_[i].strain);
        layer["largest_rotation"] = json(layers_[i].rotation);
      }
    }
    messages_.note("wall_deformation", all);
  }

  Messages& messages_;
  const Scene<n>& scene_;
  std::vector<LayerRecord> layers_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_wall_observer(const RunView<n>& watched) {
  if (!watched.scene.wall) return nullptr;
  return std::make_unique<WallObserver<n>>(watched);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_wall_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
