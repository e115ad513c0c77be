#include "observers/error_observer.hpp"

#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

template <int n>
class ErrorObserver : public Observer {
 public:
  ErrorObserver(DerivedQuantities<n>& derived, Profile& profile) : derived_(derived), profile_(profile) {}

  void look(const State& level) override {
    const auto measured = profile_.phase("error indicator");
    add(derived_.fluid_errors, level.time, level.now.fluid);
    add(derived_.wall_errors, level.time, level.now.wall);
  }
  void keep(RestartArchive& archive) override {
    PrefixedArchive of_fluid("fluid.", archive), of_wall("wall.", archive);
    if (derived_.fluid_errors.indicator) derived_.fluid_errors.mean->keep(of_fluid, ArrayKind::fluid_cells);
    if (derived_.wall_errors.indicator) derived_.wall_errors.mean->keep(of_wall, ArrayKind::wall_cells);
  }

 private:
  static void add(MediumErrors<n>& medium, double time, const std::vector<double>& field) {
    if (medium.indicator && medium.mean->wants(time)) medium.mean->add(time, medium.indicator->of_cells(field));
  }

  DerivedQuantities<n>& derived_;
  Profile& profile_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_error_observer(const RunView<n>& watched) {
  if (!watched.derived.means_errors()) return nullptr;
  return std::make_unique<ErrorObserver<n>>(watched.derived, watched.scene.profile);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_error_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
